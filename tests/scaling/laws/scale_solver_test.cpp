#include "scaling/laws/scale_solver.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include "scaling/laws/scale_text.hpp"
#include "scaling/pi/pi_express.hpp"
#include "scaling/pi/pi_groups.hpp"
#include "tests/scaling/pi_problems.hpp"
#include "tests/scaling/random_problem.hpp"

namespace musim::scaling::tests {

namespace {

/// A problem from names and units, factors by name, products as text.
ScaleProblem make_scales(std::initializer_list<std::pair<const char*, const char*>> names_and_units,
                         const std::map<std::string, double>& chosen, const Texts& held, const Texts& watched = {}) {
    ScaleProblem problem{.quantities = make_problem(names_and_units), .chosen = {}, .held = {}, .watched = {}};
    for (const PiQuantity& quantity : problem.quantities) {
        const auto found = chosen.find(quantity.name);
        problem.chosen.push_back(found == chosen.end() ? std::nullopt : std::optional(found->second));
    }
    for (const std::string& text : held) problem.held.push_back(parse_scale_product(text, problem.quantities));
    for (const std::string& text : watched) problem.watched.push_back(parse_scale_product(text, problem.quantities));
    return problem;
}

/// Motion under gravity and friction.
ScaleProblem make_motion(const std::map<std::string, double>& chosen, const Texts& held, const Texts& watched = {}) {
    return make_scales({{"l", "m"}, {"mu", "1"}, {"g", "gn"}, {"v", "m/s"}, {"t", "s"}, {"a", "gn"}}, chosen, held, watched);
}

std::string formula(const ScaleProblem& problem, const ScaleSolution& solution, const char* name) {
    return format_factor(solution.quantities[find_quantity(problem.quantities, name)].factor.exponents, problem.quantities);
}

const QuantityScale& scale_of(const ScaleProblem& problem, const ScaleSolution& solution, const char* name) {
    return solution.quantities[find_quantity(problem.quantities, name)];
}

const Texts kMuLaw{"v*t/l", "a*t^2/l", "v/sqrt(mu*g*l)"};

}  // namespace

// docs/theory/similitude.md, Pi theorem for sliding blocks: λ_t = √(λ_l/(λ_μ λ_g)), λ_v = √(λ_l λ_μ λ_g), λ_a = λ_μ λ_g
TEST_CASE("the mu law follows from its mu number, as formulas in the chosen factors") {
    const ScaleProblem problem = make_motion({{"l", 1.0 / 107.0}, {"mu", 0.63 / 0.59}, {"g", 1.0}}, kMuLaw, {"v/sqrt(g*l)", "a/g"});
    const ScaleSolution solution = solve_scales(problem);
    CHECK(formula(problem, solution, "t") == "sqrt(l/(mu*g))");
    CHECK(formula(problem, solution, "v") == "sqrt(l*mu*g)");
    CHECK(formula(problem, solution, "a") == "mu*g");
    CHECK(solution.free_count == 0);
    CHECK(solution.open.empty());
    CHECK(solution.conflicts.empty());
    // two or three roundings and a correctly rounded root
    CHECK(*scale_of(problem, solution, "t").factor.value == doctest::Approx(std::sqrt(0.59 / (107.0 * 0.63))).epsilon(1e-15));
    CHECK(*solution.watched[0].value == doctest::Approx(std::sqrt(0.63 / 0.59)).epsilon(1e-15));
    CHECK(format_factor(solution.watched[1].exponents, problem.quantities) == "mu");
}

TEST_CASE("formulas put halves under one root, above or below, and other powers as they are") {
    const auto quantities = make_problem({{"l", "1"}, {"g", "1"}, {"mu", "1"}});
    const Rational half(1, 2);
    const auto text = [&](const std::vector<Rational>& exponents) { return format_factor(exponents, quantities); };
    CHECK(text({0, 0, 0}) == "1");
    CHECK(text({2, -1, 0}) == "l^2/g");
    CHECK(text({Rational(5, 2), half, 0}) == "l^2*sqrt(l*g)");
    CHECK(text({1, -half, Rational(-3, 2)}) == "l/(mu*sqrt(g*mu))");
    CHECK(text({half, -half, -1}) == "sqrt(l/g)/mu");
    CHECK(text({0, -half, 0}) == "1/sqrt(g)");
    CHECK(text({Rational(1, 3), -half, 0}) == "l^(1/3)/g^(1/2)");
    CHECK(format_factor({half, -1, -half}, quantities, PiNotation::latex) ==
          "\\frac{\\sqrt{\\frac{\\lambda_{l}}{\\lambda_{\\mu}}}}{\\lambda_{g}}");
    // what is written is read back as the same product
    for (const std::vector<Rational>& exponents :
         {std::vector<Rational>{Rational(5, 2), -half, 1}, {-half, -1, -half}, {3, Rational(2, 3), -2}}) {
        CHECK(parse_group(text(exponents), quantities) == exponents);
    }
}

TEST_CASE("any three of a problem's factors will do, and the rest follows") {
    const ScaleProblem problem = make_motion({{"t", 0.5}, {"v", 8.0}, {"mu", 2.0}}, kMuLaw);
    const ScaleSolution solution = solve_scales(problem);
    CHECK(*scale_of(problem, solution, "l").factor.value == 4.0);
    CHECK(*scale_of(problem, solution, "a").factor.value == 16.0);
    CHECK(*scale_of(problem, solution, "g").factor.value == 8.0);
}

TEST_CASE("what is not chosen is free, first quantities first, or needs what is") {
    const ScaleProblem problem = make_motion({{"l", 0.25}}, kMuLaw, {"a/g"});
    const ScaleSolution solution = solve_scales(problem);
    CHECK(solution.free_count == 2);
    CHECK(scale_of(problem, solution, "mu").state == ScaleState::free);
    CHECK(scale_of(problem, solution, "g").state == ScaleState::free);
    CHECK(scale_of(problem, solution, "v").state == ScaleState::needs);
    CHECK(scale_of(problem, solution, "v").factor.needs == std::vector<std::size_t>{1, 2});
    CHECK_FALSE(scale_of(problem, solution, "v").factor.value.has_value());
    CHECK(solution.open == std::vector<std::size_t>{1, 2, 3, 4, 5});
    CHECK(solution.watched[0].needs == std::vector<std::size_t>{1});
    CHECK(formula(problem, solution, "v") == "sqrt(l*mu*g)");
}

TEST_CASE("a product that the chosen factors contradict is named with those that leave no way out, and its delta") {
    // a t²/l asks for a = 1, the mu number with v t/l for a = μ g = 1/4
    const ScaleProblem problem = make_motion({{"l", 0.25}, {"t", 0.5}, {"mu", 0.25}, {"g", 1.0}}, {"v*t/l", "a*t^2/l", "v/sqrt(mu*g*l)"});
    const ScaleSolution solution = solve_scales(problem);
    REQUIRE(solution.conflicts.size() == 1);
    CHECK(solution.conflicts[0].held == 2);
    CHECK(solution.conflicts[0].with == std::vector<std::size_t>{0});
    CHECK(solution.conflicts[0].chosen == std::vector<std::size_t>{0, 1, 2, 4});
    CHECK(*solution.held[2].value == 2.0);
    CHECK(format_factor(solution.held[2].exponents, problem.quantities) == "sqrt(l/(mu*g))/t");
    CHECK(*solution.held[0].value == 1.0);

    // the same products with factors that fit are kept
    const ScaleProblem fits = make_motion({{"l", 0.25}, {"t", 0.5}, {"mu", 0.25}, {"g", 4.0}}, {"v*t/l", "a*t^2/l", "v/sqrt(mu*g*l)"});
    CHECK(solve_scales(fits).conflicts.empty());
    // and so are factors that fit up to rounding: 1/25 and 25 are inverse on paper
    CHECK(solve_scales(make_motion({{"l", 1.0 / 25.0}, {"g", 25.0}, {"v", 1.0}}, {"v/sqrt(g*l)"})).conflicts.empty());
}

TEST_CASE("a product of chosen factors alone is in conflict by itself") {
    const ScaleSolution solution = solve_scales(make_motion({{"mu", 0.5}}, {"mu"}));
    REQUIRE(solution.conflicts.size() == 1);
    CHECK(solution.conflicts[0].with.empty());
    CHECK(solution.conflicts[0].chosen == std::vector<std::size_t>{1});
}

TEST_CASE("powers of two stay exact at every whole power and at every root that has one") {
    for (int n = -40; n <= 40; ++n) {
        for (const int degree : {1, 2, 3, 4, 5, 6, 7}) {
            const ScaleProblem problem =
                make_scales({{"x", "1"}, {"y", "1"}}, {{"x", std::ldexp(1.0, n * degree)}}, {"y^" + std::to_string(degree) + "/x"});
            CHECK(*scale_of(problem, solve_scales(problem), "y").factor.value == std::ldexp(1.0, n));
        }
    }
    // 3^7 is a whole seventh power, too
    const ScaleProblem seventh = make_scales({{"x", "1"}, {"y", "1"}}, {{"x", 2187.0}}, {"y^7/x"});
    CHECK(*scale_of(seventh, solve_scales(seventh), "y").factor.value == 3.0);
}

TEST_CASE("a factor that cannot be is refused by name") {
    for (const double factor : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
        CHECK_THROWS_WITH_AS(solve_scales(make_motion({{"l", factor}}, {})), doctest::Contains("l is chosen as"), SimilitudeError);
    }
    CHECK_THROWS_WITH_AS(solve_scales(make_scales({{"x", "1"}, {"y", "1"}}, {{"x", 1e300}}, {"y/x^2"})),
                         doctest::Contains("the factor of y leaves the range of doubles"), SimilitudeError);
}

TEST_CASE("a product that is not dimensionless is refused with its dimension") {
    const auto quantities = make_problem({{"v", "m/s"}, {"l", "m"}, {"rho", "kg/m^3"}, {"E", "GPa"}});
    const auto refusal = [&](const char* text) { return pi_error([&] { parse_scale_product(text, quantities); }); };
    CHECK(refusal("v/l") == "\"v/l\" is not dimensionless: it is a frequency; correct the product or the units of its quantities");
    CHECK(refusal("rho*v").find("it is in kg m^-2 s^-1") != std::string::npos);
    CHECK(refusal("v/sqrt(E/rho)").empty());
    CHECK(refusal("v/sqrt(E/rh)").find("did you mean \"rho\"?") != std::string::npos);
}

TEST_CASE("units of quantities do not matter, only their dimensions") {
    const std::map<std::string, double> chosen{{"l", 1.0 / 107.0}, {"E", 0.3}, {"rho", 0.7}};
    const Texts held{"v/sqrt(E/rho)", "v*t/l"};
    const ScaleProblem si = make_scales({{"l", "m"}, {"E", "Pa"}, {"rho", "kg/m^3"}, {"v", "m/s"}, {"t", "s"}}, chosen, held);
    const ScaleProblem other = make_scales({{"l", "mm"}, {"E", "GPa"}, {"rho", "t/mm^3"}, {"v", "cm/s"}, {"t", "ms"}}, chosen, held);
    const ScaleSolution a = solve_scales(si);
    const ScaleSolution b = solve_scales(other);
    for (std::size_t j = 0; j < si.quantities.size(); ++j) {
        CHECK(a.quantities[j].factor.exponents == b.quantities[j].factor.exponents);
        CHECK(*a.quantities[j].factor.value == *b.quantities[j].factor.value);
    }
}

namespace {

constexpr int kProblems = 200;

/// Rank modulo a prime: another elimination than the one under test. Exponents of the problems are small, minors far below the prime's
/// multiples that could make it fail by chance.
std::size_t rank_modulo(const std::vector<std::vector<Rational>>& rows, const std::vector<bool>& counts) {
    constexpr std::int64_t kPrime = 1'000'000'007;
    const auto inverse = [&](std::int64_t x) {
        std::int64_t result = 1;
        for (std::int64_t n = kPrime - 2; n > 0; n /= 2) {
            if (n % 2 == 1) result = result * x % kPrime;
            x = x * x % kPrime;
        }
        return result;
    };
    std::vector<std::vector<std::int64_t>> matrix;
    for (const auto& row : rows) {
        matrix.emplace_back();
        for (std::size_t j = 0; j < row.size(); ++j) {
            const std::int64_t numerator = (row[j].numerator() % kPrime + kPrime) % kPrime;
            if (counts[j]) matrix.back().push_back(numerator * inverse(row[j].denominator()) % kPrime);
        }
    }
    std::size_t rank = 0;
    for (std::size_t column = 0; !matrix.empty() && column < matrix[0].size(); ++column) {
        std::size_t pivot = rank;
        while (pivot < matrix.size() && matrix[pivot][column] == 0) ++pivot;
        if (pivot == matrix.size()) continue;
        std::swap(matrix[rank], matrix[pivot]);
        const std::int64_t scale = inverse(matrix[rank][column]);
        for (std::size_t i = rank + 1; i < matrix.size(); ++i) {
            const std::int64_t share = matrix[i][column] * scale % kPrime;
            for (std::size_t j = 0; j < matrix[i].size(); ++j) {
                matrix[i][j] = ((matrix[i][j] - share * matrix[rank][j]) % kPrime + kPrime) % kPrime;
            }
        }
        if (++rank == matrix.size()) break;
    }
    return rank;
}

/// Groups of a random problem in random powers, some held, some watched, and some factors chosen: near 1, as exponents may be large.
ScaleProblem make_random_scales(std::mt19937_64& random) {
    const auto up_to = [&](std::uint64_t n) { return static_cast<std::int64_t>(random() % (n + 1)); };
    ScaleProblem problem{.quantities = make_random_problem(random, 2 + random() % 9), .chosen = {}, .held = {}, .watched = {}};
    const PiBasis basis = find_pi_basis(problem.quantities);
    for (std::int64_t i = up_to(5); i >= 0; --i) {
        ScaleProduct product{.text = "product", .exponents = std::vector<Rational>(problem.quantities.size())};
        for (const PiGroup& group : basis.groups) {
            const Rational power(up_to(4) - 2, 1 + up_to(2));
            for (std::size_t j = 0; j < group.size(); ++j) product.exponents[j] = product.exponents[j] + power * group[j];
        }
        (up_to(3) == 0 ? problem.watched : problem.held).push_back(product);
    }
    for (std::size_t j = 0; j < problem.quantities.size(); ++j) {
        problem.chosen.push_back(up_to(2) == 0 ? std::optional(1.0 + static_cast<double>(up_to(100)) / 65536.0) : std::nullopt);
    }
    return problem;
}

template <class Check>
void for_random_scales(const Check& check) {
    std::mt19937_64 random(20240602);
    for (int i = 0; i < kProblems; ++i) {
        CAPTURE(i);
        check(make_random_scales(random), random);
    }
}

bool is_in_conflict(const ScaleSolution& solution, std::size_t held) {
    return std::any_of(solution.conflicts.begin(), solution.conflicts.end(), [&](const auto& conflict) { return conflict.held == held; });
}

/// log₂ of a product with the given factors.
double log_of(const std::vector<Rational>& exponents, const std::vector<double>& logs) {
    double sum = 0.0;
    for (std::size_t j = 0; j < exponents.size(); ++j) {
        sum += static_cast<double>(exponents[j].numerator()) / static_cast<double>(exponents[j].denominator()) * logs[j];
    }
    return sum;
}

}  // namespace

TEST_CASE("random problems: what is held has delta 1 in its exponents, free factors are unknowns less the rank") {
    for_random_scales([](const ScaleProblem& problem, std::mt19937_64&) {
        const ScaleSolution solution = solve_scales(problem);
        std::vector<std::vector<Rational>> rows;
        for (const ScaleProduct& product : problem.held) rows.push_back(product.exponents);
        std::vector<bool> unknown;
        for (const auto& chosen : problem.chosen) unknown.push_back(!chosen);
        const auto unknowns = static_cast<std::size_t>(std::count(unknown.begin(), unknown.end(), true));
        CHECK(solution.free_count == unknowns - rank_modulo(rows, unknown));

        const std::vector<Rational> one(problem.quantities.size());
        std::size_t settled = 0;
        for (std::size_t i = 0; i < problem.held.size(); ++i) {
            if (solution.held[i].exponents == one) ++settled;
            CHECK((is_in_conflict(solution, i) || std::abs(*solution.held[i].value - 1.0) <= 1e-12));
        }
        CHECK(settled >= rank_modulo(rows, unknown));

        // δ of every product is that of the factors themselves, whatever the free ones are
        std::vector<double> free_logs;
        for (std::size_t j = 0; j < problem.quantities.size(); ++j) {
            free_logs.push_back(problem.chosen[j] ? std::log2(*problem.chosen[j]) : 0.25 * static_cast<double>(j) - 1.0);
        }
        std::vector<double> logs;
        for (const QuantityScale& scale : solution.quantities) logs.push_back(log_of(scale.factor.exponents, free_logs));
        // sums of at most eleven terms of size 100 or less, each right to some 1e-16 of itself
        for (std::size_t i = 0; i < problem.watched.size(); ++i) {
            CHECK(std::abs(log_of(problem.watched[i].exponents, logs) - log_of(solution.watched[i].exponents, free_logs)) < 1e-10);
        }
        for (std::size_t i = 0; i < problem.held.size(); ++i) {
            const double delta = log_of(problem.held[i].exponents, logs);
            CHECK(std::abs(delta - std::log2(*solution.held[i].value)) < 1e-10);
        }
    });
}

TEST_CASE("random problems: the order of the quantities changes nothing that is settled") {
    for_random_scales([](const ScaleProblem& problem, std::mt19937_64& random) {
        const std::size_t count = problem.quantities.size();
        std::vector<std::size_t> order(count);
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::shuffle(order.begin(), order.end(), random);
        const auto reorder = [&](const auto& list) {
            auto result = list;
            for (std::size_t j = 0; j < count; ++j) result[j] = list[order[j]];
            return result;
        };
        ScaleProblem shuffled = problem;
        shuffled.quantities = reorder(problem.quantities);
        shuffled.chosen = reorder(problem.chosen);
        for (ScaleProduct& product : shuffled.held) product.exponents = reorder(product.exponents);
        for (ScaleProduct& product : shuffled.watched) product.exponents = reorder(product.exponents);

        const ScaleSolution a = solve_scales(problem);
        const ScaleSolution b = solve_scales(shuffled);
        CHECK(a.free_count == b.free_count);
        CHECK(a.open.size() == b.open.size());
        REQUIRE(a.conflicts.size() == b.conflicts.size());
        for (std::size_t k = 0; k < a.conflicts.size(); ++k) {
            CHECK(a.conflicts[k].held == b.conflicts[k].held);
            CHECK(a.conflicts[k].with == b.conflicts[k].with);
        }
        for (std::size_t i = 0; i < problem.held.size(); ++i) CHECK(reorder(a.held[i].exponents) == b.held[i].exponents);
        for (std::size_t j = 0; j < count; ++j) {
            const QuantityScale& before = a.quantities[order[j]];
            const QuantityScale& after = b.quantities[j];
            CHECK(before.factor.value.has_value() == after.factor.value.has_value());
            if (before.factor.value) CHECK(reorder(before.factor.exponents) == after.factor.exponents);
        }
        for (std::size_t i = 0; i < problem.watched.size(); ++i) {
            CHECK(a.watched[i].value.has_value() == b.watched[i].value.has_value());
            if (a.watched[i].value) CHECK(reorder(a.watched[i].exponents) == b.watched[i].exponents);
        }
    });
}

}  // namespace musim::scaling::tests
