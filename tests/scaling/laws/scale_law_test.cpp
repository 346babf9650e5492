#include "scaling/laws/scale_law.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <map>

#include "scaling/laws/law_similitude.hpp"
#include "scaling/laws/scale_law_catalogue.hpp"
#include "scaling/laws/scale_law_json.hpp"
#include "scaling/laws/scale_text.hpp"
#include "tests/scaling/expected.hpp"

namespace musim::scaling::tests {

namespace {

SolvedLaw solve(const std::string& law, const std::vector<GivenFactor>& given) { return solve_law(load_scale_law(law), given); }

double factor(const SolvedLaw& solved, const char* name) {
    const auto value = solved.factor(name);
    REQUIRE_MESSAGE(value.has_value(), name);
    return *value;
}

/// δ of a watched product.
double delta(const SolvedLaw& solved, std::string_view product) {
    for (std::size_t i = 0; i < solved.problem.watched.size(); ++i) {
        if (solved.problem.watched[i].text == product) return solved.solution.watched[i].value.value_or(0.0);
    }
    return 0.0;
}

/// Factors of the table of scale factors (docs/theory/similitude.md) as exponents of L, R, G, U.
using Column = std::map<std::string, std::map<std::string, Rational>>;

const Rational kHalf(1, 2);

/// The columns of laws in which one λ_a governs, from its exponents: exact (G), mu (U G), cauchy and centrifuge (1/L).
Column make_column(const std::map<std::string, Rational>& acceleration, const std::map<std::string, Rational>& gravity,
                   const std::map<std::string, Rational>& density) {
    const auto product = [&](Rational length, Rational mass, Rational by_acceleration, Rational by_gravity) {
        std::map<std::string, Rational> result{{"l", length}};
        const auto add = [&](const std::map<std::string, Rational>& factor, const Rational& power) {
            for (const auto& [name, exponent] : factor) result[name] = result[name] + exponent * power;
        };
        add(density, mass);
        add(acceleration, by_acceleration);
        add(gravity, by_gravity);
        std::erase_if(result, [](const auto& entry) { return entry.second == 0; });
        return result;
    };
    return {{"l", product(1, 0, 0, 0)},
            {"t", product(kHalf, 0, -kHalf, 0)},
            {"v", product(kHalf, 0, kHalf, 0)},
            {"a", product(0, 0, 1, 0)},
            {"a_v", product(0, 0, 0, 1)},
            {"f", product(-kHalf, 0, kHalf, 0)},
            {"alpha", product(-1, 0, 1, 0)},
            {"rho", product(0, 1, 0, 0)},
            {"m", product(3, 1, 0, 0)},
            {"J", product(5, 1, 0, 0)},
            {"F", product(3, 1, 1, 0)},
            {"F_v", product(3, 1, 0, 1)},
            {"M", product(4, 1, 1, 0)},
            {"sigma", product(1, 1, 1, 0)},
            {"sigma_v", product(1, 1, 0, 1)},
            {"k", product(2, 1, 1, 0)},
            {"k_v", product(2, 1, 0, 1)},
            {"k_A", product(0, 1, 1, 0)},
            {"c", product(Rational(5, 2), 1, kHalf, 0)},
            {"W", product(4, 1, 1, 0)},
            {"W_v", product(4, 1, 0, 1)},
            {"P", product(Rational(7, 2), 1, Rational(3, 2), 0)},
            {"p", product(Rational(7, 2), 1, kHalf, 0)},
            {"I_A", product(kHalf, 0, Rational(3, 2), -1)},
            {"theta", {}}};
}

void check_column(const SolvedLaw& solved, const Column& column) {
    for (const auto& row : column) {
        const std::string& name = row.first;
        const auto& expected = row.second;
        CAPTURE(name);
        const auto& exponents = solved.solution.quantities[find_quantity(solved.problem.quantities, name)].factor.exponents;
        for (std::size_t j = 0; j < exponents.size(); ++j) {
            const auto found = expected.find(solved.problem.quantities[j].name);
            CHECK(exponents[j] == (found == expected.end() ? Rational(0) : found->second));
        }
    }
}

}  // namespace

TEST_CASE("every shipped law is read, written, read again, and settles all it names from what it needs") {
    CHECK(scale_law_names().size() >= 15);
    for (const std::string& name : scale_law_names()) {
        CAPTURE(name);
        const ScaleLaw law = load_scale_law(name);
        CHECK(law.name == name);
        CHECK_FALSE(law.title.empty());
        CHECK_FALSE(law.description.empty());
        for (const LawQuantity& quantity : law.quantities) CHECK_MESSAGE(!quantity.meaning.empty(), quantity.quantity.name);
        const std::string written = write_scale_law(law);
        CHECK(write_scale_law(parse_scale_law(written, "copy")) == written);

        std::vector<GivenFactor> given;
        for (const LawChoice& choice : law.choices) {
            if (!choice.fallback) given.push_back({choice.name, 0.25});
        }
        const SolvedLaw solved = solve_law(law, given);
        CHECK(solved.solution.free_count == 0);
        CHECK(solved.overruled.empty());
        for (const ScaleFactor& held : solved.solution.held) CHECK(held.exponents == std::vector<Rational>(held.exponents.size()));
    }
}

TEST_CASE("the columns of the table of scale factors, as exponents") {
    const std::map<std::string, Rational> none;
    check_column(solve("exact", {{"l", 0.04}, {"rho", 0.9}, {"g", 2.0}}), make_column({{"g", 1}}, {{"g", 1}}, {{"rho", 1}}));
    check_column(solve("mu", {{"l", 0.04}, {"rho", 0.9}, {"g", 2.0}, {"mu", 0.8}}),
                 make_column({{"mu", 1}, {"g", 1}}, {{"g", 1}}, {{"rho", 1}}));
    check_column(solve("froude", {{"l", 0.04}, {"rho", 0.9}, {"g", 2.0}, {"mu", 0.8}}), make_column({{"g", 1}}, {{"g", 1}}, {{"rho", 1}}));

    // the same solid: λ_E and λ_ρ are 1, so that the columns are powers of L (and of G where weights or Arias intensity need it)
    const std::map<std::string, Rational> elastic{{"l", -1}, {"E", 1}, {"rho", -1}};
    // where gravity is neglected, nothing but its forces follows it: vertical shaking is scaled as horizontal shaking
    const auto shake_alike = [](Column column) {
        column["a_v"] = column["a"];
        return column;
    };
    check_column(solve("cauchy", {{"l", 0.04}, {"g", 2.0}}), shake_alike(make_column(elastic, {{"g", 1}}, {{"rho", 1}})));
    check_column(solve("centrifuge", {{"l", 0.04}}), make_column(elastic, elastic, {{"rho", 1}}));
    check_column(solve("true_replica", {{"l", 0.04}, {"rho", 0.9}}), make_column({{"g", 1}}, {{"g", 1}}, {{"rho", 1}}));
    check_column(solve("gravity_distorted", {{"l", 0.04}, {"a", 0.5}}), shake_alike(make_column({{"a", 1}}, {{"g", 1}}, {{"rho", 1}})));
}

TEST_CASE("centrifuge and Cauchy columns in numbers: powers of the length") {
    const double length = 1.0 / 16.0;
    for (const char* law : {"cauchy", "centrifuge"}) {
        CAPTURE(law);
        const SolvedLaw solved = solve(law, {{"l", length}});
        const std::map<std::string, double> powers{{"t", 1}, {"v", 0}, {"a", -1}, {"f", -1},    {"alpha", -2}, {"m", 3},
                                                   {"J", 5}, {"F", 2}, {"M", 3},  {"sigma", 0}, {"k", 1},      {"k_A", -1},
                                                   {"c", 2}, {"W", 3}, {"P", 2},  {"p", 3}};
        for (const auto& row : powers) CHECK_MESSAGE(factor(solved, row.first.c_str()) == std::pow(length, row.second), row.first);
    }
    CHECK(factor(solve("cauchy", {{"l", length}, {"g", 4.0}}), "I_A") == 1.0 / (length * 4.0));
    CHECK(factor(solve("centrifuge", {{"l", length}}), "I_A") == 1.0);
    CHECK(factor(solve("centrifuge", {{"l", length}}), "g") == 16.0);
}

// the kinematic and dynamic reference tables of reference_cases_test.cpp, through laws as data
TEST_CASE("factors of the papers' models through the laws as data") {
    const std::vector<GivenFactor> wood{{"l", 1.0 / 107.0}, {"mu", 0.63 / 0.59}, {"rho", 800.0 / 2320.0}};
    const SolvedLaw mu = solve("mu", wood);
    CHECK_EXPECTED(factor(mu, "t"), "0.09355432");
    CHECK_EXPECTED(1.0 / factor(mu, "t"), "10.68898");
    CHECK_EXPECTED(factor(mu, "v"), "0.09989698");
    CHECK_EXPECTED(factor(mu, "a"), "1.0677966");
    CHECK_EXPECTED(factor(mu, "m"), "2.81482e-7");
    CHECK_EXPECTED(factor(mu, "F"), "3.00566e-7");
    CHECK_EXPECTED(factor(mu, "F_v"), "2.81482e-7");
    CHECK_EXPECTED(factor(mu, "sigma_v"), "3.22269e-3");
    CHECK_EXPECTED(factor(mu, "W"), "2.80902e-9");
    CHECK_EXPECTED(factor(mu, "W_v"), "2.63067e-9");
    CHECK_EXPECTED(factor(mu, "J"), "2.45857e-11");
    CHECK_EXPECTED(factor(mu, "k"), "3.21605e-5");
    CHECK_EXPECTED(factor(mu, "c"), "3.00876e-6");

    const SolvedLaw froude = solve("froude", wood);
    CHECK_EXPECTED(factor(froude, "t"), "0.0966736");
    CHECK_EXPECTED(factor(froude, "a"), 1.0);
    CHECK_EXPECTED(factor(froude, "k"), "3.01186e-5");
    CHECK_EXPECTED(factor(froude, "c"), "2.91167e-6");
    CHECK_EXPECTED(0.8661017 * delta(froude, "a/(mu*g)"), "0.8111111");
    CHECK_EXPECTED(0.01387054 * delta(froude, "v/sqrt(mu*g*l)"), "0.01342298");

    const SolvedLaw aluminium = solve("mu", {{"l", 1.0 / 107.0}, {"mu", 0.18 / 0.59}});
    CHECK_EXPECTED(factor(aluminium, "t"), "0.1750241");
    CHECK_EXPECTED(factor(aluminium, "v"), "0.05339718");
    CHECK_EXPECTED(factor(aluminium, "a"), "0.3050847");
    CHECK_EXPECTED(delta(aluminium, "v/sqrt(g*l)"), "0.5523");

    const SolvedLaw concrete = solve("exact", {{"l", 1.0 / 25.0}});
    CHECK_EXPECTED(factor(concrete, "t"), 0.2);
    CHECK_EXPECTED(factor(concrete, "m"), 6.4e-5);
    CHECK_EXPECTED(factor(concrete, "W"), 2.56e-6);
    CHECK_EXPECTED(factor(concrete, "J"), 1.024e-7);
    CHECK_EXPECTED(factor(concrete, "k"), 1.6e-3);
    CHECK_EXPECTED(factor(concrete, "c"), 3.2e-4);

    const SolvedLaw centrifuge = solve("centrifuge", {{"l", 1.0 / 25.0}});
    CHECK_EXPECTED(factor(centrifuge, "t"), 0.04);
    CHECK_EXPECTED(factor(centrifuge, "v"), 1.0);
    CHECK_EXPECTED(factor(centrifuge, "a"), 25.0);
    CHECK_EXPECTED(factor(centrifuge, "F"), 1.6e-3);
    CHECK_EXPECTED(factor(centrifuge, "sigma"), 1.0);
    CHECK_EXPECTED(factor(centrifuge, "W"), 6.4e-5);
    CHECK_EXPECTED(factor(centrifuge, "k"), 0.04);
    CHECK_EXPECTED(factor(centrifuge, "c"), 1.6e-3);
}

// tower of 2.701509e8 kg, modulus 29.175 GPa of its concrete
TEST_CASE("true replica and artificial mass of the tower at 1:25") {
    const double length = 1.0 / 25.0;
    CHECK_EXPECTED(29.175 * factor(solve("true_replica", {{"l", length}}), "E"), "1.167");
    // the modulus given, the density follows in the law's default's place
    const SolvedLaw by_modulus = solve("true_replica", {{"l", length}, {"E", 1.0}});
    CHECK_EXPECTED(factor(by_modulus, "rho"), 25.0);
    REQUIRE(by_modulus.overruled.size() == 1);
    CHECK(by_modulus.problem.quantities[by_modulus.overruled[0]].name == "rho");

    const double tower = 2.701509e8;  // [kg]
    const ScaleLaw law = load_scale_law("artificial_mass");
    const SolvedLaw ideal = solve_law(law, {{"l", length}});
    CHECK_EXPECTED(factor(ideal, "rho"), 25.0);
    // 432,240 kg to its five digits
    CHECK_EXPECTED(factor(ideal, "m") * tower / 1e4, "43.224");
    CHECK_EXPECTED(*ideal.added(law.additions[0]) / factor(ideal, "m_s"), 24.0);

    // the real model weighs 17,343.6 kg; 414,896 kg were found from the rounded 432,240, hence half of its ten
    const SolvedLaw real = solve_law(law, {{"l", length}, {"m_s", 17343.6 / tower}});
    CHECK(std::abs(*real.added(law.additions[0]) * tower - 414896.0) < 5.0);
    // λ_E L²/G - R L³ in any gravity and solid
    const SolvedLaw other = solve_law(law, {{"l", length}, {"g", 2.0}, {"E", 0.5}, {"rho_s", 1.5}});
    CHECK(*other.added(law.additions[0]) == doctest::Approx(0.5 * length * length / 2.0 - 1.5 * length * length * length).epsilon(1e-14));
}

// docs/theory/dimensional_analysis.md, laws as data: heights by V, horizontal sizes by U V
TEST_CASE("the mu law with vertical distortion keeps sliding, uplift and regime, and rotates by the friction ratio") {
    const double friction = 0.18 / 0.59;
    const SolvedLaw solved = solve("mu_vertical_distortion", {{"H", 1.0 / 107.0}, {"mu", friction}});
    CHECK(factor(solved, "b") == doctest::Approx(friction / 107.0).epsilon(1e-15));
    CHECK(factor(solved, "tan_alpha") == friction);
    CHECK(factor(solved, "a") == friction);
    CHECK(factor(solved, "t") == doctest::Approx(std::sqrt(1.0 / 107.0)).epsilon(1e-15));
    CHECK(factor(solved, "u_v") == 1.0 / 107.0);
    CHECK(delta(solved, "mu/tan_alpha") == 1.0);
    CHECK(delta(solved, "t*sqrt(g/H)") == 1.0);
    CHECK(delta(solved, "theta") == friction);
    CHECK_THROWS_WITH_AS(make_similitude(solved), doctest::Contains("no length l"), SimilitudeError);
}

// docs/theory/dimensional_analysis.md, restoring forces: R_F^N with F_R = m g, μ m g, E l², k l, c_coh l², m g tan α
TEST_CASE("special restoring forces are the generic law with their force") {
    const double l = 0.25;
    const auto generic = [&](double force) { return solve("restoring_force", {{"l", l}, {"F_R", force}}); };
    const double mass = l * l * l;
    const auto agree = [&](const SolvedLaw& special, double force) {
        const SolvedLaw general = generic(force);
        for (const char* name : {"t", "v", "a", "F", "W"}) CHECK_MESSAGE(factor(special, name) == factor(general, name), name);
    };
    agree(solve("froude", {{"l", l}}), mass);
    agree(solve("mu", {{"l", l}, {"mu", 0.5}}), 0.5 * mass);
    agree(solve("cauchy", {{"l", l}, {"E", 4.0}}), 4.0 * l * l);
    agree(solve("restoring_spring", {{"l", l}, {"k_s", 2.0}}), 2.0 * l);
    agree(solve("restoring_cohesion", {{"l", l}, {"c_coh", 8.0}}), 8.0 * l * l);
    agree(solve("restoring_rocking", {{"l", l}, {"tan_alpha", 0.5}}), 0.5 * mass);
    const SolvedLaw mixed = solve("restoring_mixed", {{"l", l}, {"mu", 0.5}, {"rho", 2.0}});
    CHECK(factor(mixed, "c_coh") == 0.5 * 2.0 * l);
    // cohesion of one's own choice contradicts: one restoring force number is not enough
    CHECK_THROWS_WITH_AS(solve("restoring_mixed", {{"l", l}, {"mu", 0.5}, {"rho", 2.0}, {"g", 1.0}, {"c_coh", 1.0}}),
                         doctest::Contains("c_coh/(mu*rho*g*l)"), SimilitudeError);
}

TEST_CASE("a similitude has the factors of its law, to the bit at powers of two") {
    const std::map<std::string_view, const char*> names{{"length", "l"},
                                                        {"time", "t"},
                                                        {"velocity", "v"},
                                                        {"acceleration", "a"},
                                                        {"mass", "m"},
                                                        {"force", "F"},
                                                        {"stiffness", "k"},
                                                        {"damping", "c"},
                                                        {"friction", "mu"},
                                                        {"gravity", "g"},
                                                        {"density", "rho"},
                                                        {"frequency", "f"},
                                                        {"angular_acceleration", "alpha"},
                                                        {"inertia", "J"},
                                                        {"moment", "M"},
                                                        {"stress", "sigma"},
                                                        {"stiffness_per_area", "k_A"},
                                                        {"energy", "W"},
                                                        {"power", "P"},
                                                        {"momentum", "p"},
                                                        {"acceleration_vertical", "a_v"},
                                                        {"force_vertical", "F_v"},
                                                        {"stress_vertical", "sigma_v"},
                                                        {"stiffness_static", "k_v"},
                                                        {"energy_potential", "W_v"},
                                                        {"arias_intensity", "I_A"}};
    struct Case {
        const char* law;
        ScaleFactors chosen;
        double tolerance;
    };
    // up to some thirty roundings of 1e-16 on either side
    const Case cases[] = {{"mu", {.length = 1.0 / 107.0, .friction = 0.63 / 0.59, .gravity = 1.7, .density = 0.345}, 1e-14},
                          {"froude", {.length = 1.0 / 25.0, .friction = 0.3, .gravity = 1.7, .density = 0.345}, 1e-14},
                          {"cauchy", {.length = 1.0 / 25.0, .friction = 0.3, .gravity = 1.7, .density = 0.345}, 1e-14},
                          {"exact", {.length = 1.0 / 25.0, .friction = 1.0, .gravity = 1.7, .density = 0.345}, 1e-14},
                          {"mu", {.length = 1.0 / 16.0, .friction = 0.25, .gravity = 4.0, .density = 0.5}, 0.0},
                          {"froude", {.length = 1.0 / 16.0, .friction = 0.25, .gravity = 4.0, .density = 0.5}, 0.0},
                          {"cauchy", {.length = 1.0 / 16.0, .friction = 0.25, .gravity = 4.0, .density = 0.25}, 0.0},
                          {"exact", {.length = 1.0 / 16.0, .friction = 1.0, .gravity = 4.0, .density = 0.5}, 0.0}};
    for (const Case& each : cases) {
        CAPTURE(each.law);
        std::vector<GivenFactor> given{{"l", each.chosen.length}, {"g", each.chosen.gravity}, {"rho", each.chosen.density}};
        if (each.chosen.friction != 1.0) given.push_back({"mu", each.chosen.friction});
        const SolvedLaw solved = solve(each.law, given);
        const Similitude similitude = make_similitude(solved);
        CHECK(similitude.law_name() == each.law);
        std::size_t compared = 0;
        for (const NamedFactor& named : similitude.factors()) {
            const auto found = names.find(named.name);
            if (found == names.end()) continue;
            CAPTURE(named.name);
            CHECK(std::abs(factor(solved, found->second) / named.value - 1.0) <= each.tolerance);
            ++compared;
        }
        CHECK(compared == names.size());
    }
}

TEST_CASE("factors that contradict a law are named, with the products and the ways out") {
    CHECK_THROWS_WITH_AS(solve("mu", {{"l", 0.25}, {"t", 1.0}, {"mu", 0.5}, {"g", 1.0}}),
                         doctest::Contains("law mu: l = 0.25, t = 1, mu = 0.5, g = 1 cannot be where v/sqrt(mu*g*l) is held and v*t/l"),
                         SimilitudeError);
    CHECK_THROWS_WITH_AS(solve("mu", {{"l", 0.25}, {"t", 1.0}, {"mu", 0.5}, {"g", 1.0}}),
                         doctest::Contains("release one of l, t, mu, g, watch v/sqrt(mu*g*l) instead, or choose another law"),
                         SimilitudeError);
    CHECK_THROWS_WITH_AS(solve("exact", {{"l", 0.25}, {"mu", 0.5}}),
                         doctest::Contains("release mu, watch mu instead, or choose another law"), SimilitudeError);
    // by definition alone there is nothing to watch
    CHECK_THROWS_WITH_AS(solve("mechanics", {{"l", 0.25}, {"t", 1.0}, {"v", 1.0}}), doctest::Contains("release one of l, t, v"),
                         SimilitudeError);
    CHECK_THROWS_WITH_AS(solve("mu", {{"rho", 0.5}}), doctest::Contains("law mu: the factor of l (length) is missing"), SimilitudeError);
    CHECK_THROWS_WITH_AS(solve("mu", {{"l", 0.5}, {"l", 0.5}}), doctest::Contains("l is given twice"), PiError);
    CHECK_THROWS_WITH_AS(solve("mu", {{"x", 0.5}}), doctest::Contains("\"x\" is no quantity"), PiError);
    CHECK_THROWS_WITH_AS(solve("mu_vertical_distortion", {{"l", 0.5}}),
                         doctest::Contains("\"l\" is no quantity of law mu_vertical_distortion; take one of H, b, mu, g,"), PiError);
    // what settles a factor will do in its place
    CHECK(factor(solve("froude", {{"v", 0.25}}), "l") == 0.0625);
}

TEST_CASE("a law file is refused with file and key") {
    const auto refusal = [](const std::string& rest) {
        try {
            parse_scale_law(R"({"schema": "musim-law/1", "name": "n", "title": "t")" + rest + "}", "my.json");
        } catch (const PiError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    const std::string quantities =
        R"(, "quantities": [{"name": "l", "unit": "m"}, {"name": "v", "unit": "m/s"}, {"name": "g", "unit": "gn"}])";
    CHECK(refusal(quantities + R"-(, "held": ["v/sqrt(g*l)"])-").empty());
    CHECK(refusal("") == "my.json: no quantities; list those that the problem depends on");
    CHECK(refusal(quantities + R"(, "helt": [])").find("my.json: unknown key \"helt\"; did you mean \"held\"?") == 0);
    CHECK(refusal(quantities + R"(, "held": ["v/l"])").find("my.json: \"v/l\" is not dimensionless: it is a frequency") == 0);
    CHECK(refusal(quantities + R"(, "held": [3])").find("my.json: /held: 3 is no text") == 0);
    CHECK(refusal(quantities + R"(, "held": "v")").find("my.json: \"held\" is no list") == 0);
    CHECK(refusal(quantities + R"(, "watched": ["v/x"])").find("\"x\" is no quantity") != std::string::npos);
    CHECK(refusal(quantities + R"(, "chosen": [{"name": "x"}])").find("\"x\" is no quantity") != std::string::npos);
    CHECK(refusal(quantities + R"(, "chosen": [{"name": "l"}, {"name": "l"}])").find("chosen twice") != std::string::npos);
    CHECK(refusal(quantities + R"(, "chosen": [{"name": "l", "default": 0}])").find("must be positive") != std::string::npos);
    CHECK(refusal(quantities + R"(, "chosen": [{"name": "l", "default": "1/0"}])").find("my.json: /chosen/0: ") == 0);
    CHECK(refusal(quantities + R"(, "chosen": [{"name": "l", "value": 1}])").find("unknown key \"value\"") != std::string::npos);
    CHECK(refusal(quantities + R"(, "additions": [{"name": "d", "total": "l", "own": "v"}])").find("differ in dimension") !=
          std::string::npos);
    CHECK(refusal(quantities + R"(, "extends": "frode")").find("my.json: /extends: there is no law \"frode\"") == 0);
    CHECK(refusal(R"(, "quantities": [{"name": "l", "unit": "m"}, {"name": "l", "unit": "m"}])")
              .find("/quantities/1: \"l\" is there twice") != std::string::npos);
    CHECK(refusal(R"(, "quantities": [{"name": "l", "unit": "m", "value": 3}])").find("unknown key \"value\"") != std::string::npos);
    CHECK_THROWS_WITH_AS(parse_scale_law("{}", "my.json"), "my.json: is no law; add \"schema\": \"musim-law/1\"", PiError);
    CHECK_THROWS_WITH_AS(parse_scale_law("{", "my.json"), doctest::Contains("my.json: parse error"), PiError);
    CHECK_THROWS_WITH_AS(load_scale_law("nonsense"), doctest::Contains("there is no law \"nonsense\"; choose one of artificial_mass"),
                         PiError);
}

TEST_CASE("a law extends another one and replaces its quantities by name") {
    const ScaleLaw law = parse_scale_law(R"-({"schema": "musim-law/1", "name": "mine", "title": "t", "extends": "mechanics",
        "quantities": [{"name": "l", "unit": "mm", "meaning": "block height"}, {"name": "E", "unit": "GPa"}],
        "chosen": [{"name": "l"}], "held": ["E/(rho*g*l)"]})-",
                                         "mine.json");
    CHECK(law.quantities.front().meaning == "block height");
    CHECK(law.quantities.back().quantity.name == "E");
    CHECK(law.choices.size() == 1);
    CHECK(law.definitions == load_scale_law("mechanics").definitions);
    const SolvedLaw solved = solve_law(law, {{"l", 0.5}});
    CHECK(solved.solution.free_count == 4);
    CHECK_THROWS_WITH_AS(make_similitude(solved), doctest::Contains("t is open"), SimilitudeError);
}

}  // namespace musim::scaling::tests
