#include "scaling/uncertainty/uncertain_law.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "scaling/laws/law_similitude.hpp"
#include "scaling/laws/scale_law_catalogue.hpp"
#include "scaling/uncertainty/uncertain_similitude.hpp"
#include "tests/scaling/expected.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/trials.hpp"

namespace musim::scaling::tests {

namespace {

std::vector<UncertainFactor> make_factors(const std::vector<std::pair<const char*, const char*>>& texts) {
    std::vector<UncertainFactor> factors;
    factors.reserve(texts.size());
    for (const auto& [name, text] : texts) factors.push_back({name, parse_uncertain_ratio(text)});
    return factors;
}

/// A law solved and propagated; values are texts such as "29.2+/-1 GPa".
struct LawCase {
    SolvedLaw solved;
    UncertainLawReport report;

    const UncertainResult& factor(const char* name) const {
        const auto& result = report.factors[find_quantity(solved.problem.quantities, name)];
        REQUIRE_MESSAGE(result.has_value(), name);
        return *result;
    }
    double relative(const char* name) const { return factor(name).first_order.relative; }

    const UncertainResult& product(const std::vector<ScaleProduct>& products, const std::vector<std::optional<UncertainResult>>& results,
                                   std::string_view text) const {
        const auto found = std::find_if(products.begin(), products.end(), [&](const ScaleProduct& each) { return each.text == text; });
        REQUIRE_MESSAGE(found != products.end(), std::string(text));
        return *results[static_cast<std::size_t>(found - products.begin())];
    }
    double held(std::string_view text) const { return product(solved.problem.held, report.held, text).first_order.relative; }
    double watched(std::string_view text) const { return product(solved.problem.watched, report.watched, text).first_order.relative; }
    double shaken(std::string_view text) const {
        const auto found = std::find_if(report.shaken.begin(), report.shaken.end(), [&](const auto& each) { return each.name == text; });
        REQUIRE_MESSAGE(found != report.shaken.end(), std::string(text));
        return found->first_order.relative;
    }
};

LawCase propagate_case(const std::string& name, const std::vector<std::pair<const char*, const char*>>& factors,
                       const std::vector<std::pair<const char*, const char*>>& values = {},
                       const std::optional<MonteCarloSettings>& monte_carlo = {}) {
    ScaleLaw law = load_scale_law(name);
    const std::vector<PiQuantity> quantities = quantities_of(law);
    std::vector<UncertainPrototype> prototype;
    for (const auto& [quantity, text] : values) {
        PiQuantity& given = law.quantities[find_quantity(quantities, quantity)].quantity;
        prototype.push_back({quantity, parse_uncertain_value(text, given)});
        given.value = prototype.back().value.value;
    }
    const std::vector<UncertainFactor> given = make_factors(factors);
    SolvedLaw solved = solve_law(law, values_of(given));
    UncertainLawReport report = propagate(solved, given, prototype, monte_carlo);
    return {std::move(solved), std::move(report)};
}

const char* const kWoodRatio = "(0.63+/-5%)/(0.59+/-5%)";

}  // namespace

TEST_CASE("laws as data propagate what the laws of the code do, to first order and as shaken") {
    UncertainScales scales;
    scales.length = parse_uncertain_ratio("1/107+/-0.4%");
    scales.friction = parse_uncertain_ratio(kWoodRatio);
    scales.gravity = parse_uncertain_ratio("1+/-0.2%");
    scales.density = parse_uncertain_ratio("(800+/-1%)/(2320+/-2%)");
    const std::pair<const char*, const char*> names[] = {
        {"length", "l"},     {"time", "t"},     {"velocity", "v"},         {"acceleration", "a"},
        {"mass", "m"},       {"force", "F"},    {"inertia", "J"},          {"stiffness", "k"},
        {"damping", "c"},    {"energy", "W"},   {"force_vertical", "F_v"}, {"power", "P"},
        {"stress", "sigma"}, {"momentum", "p"}, {"moment", "M"},           {"arias_intensity", "I_A"}};
    for (const char* law : {"mu", "froude", "cauchy"}) {
        CAPTURE(law);
        const UncertainReport code = propagate(
            scales,
            [law](const ScaleFactors& factors, const std::vector<GivenFactor>& /*others*/) { return make_similitude(law, factors); }, {},
            {});
        const LawCase data =
            propagate_case(law, {{"l", "1/107+/-0.4%"}, {"mu", kWoodRatio}, {"g", "1+/-0.2%"}, {"rho", "(800+/-1%)/(2320+/-2%)"}});
        REQUIRE(data.report.inputs.size() == code.inputs.size());
        for (const auto& name : names) {
            const char* const key = name.first;
            const char* const quantity = name.second;
            CAPTURE(key);
            const auto found = std::find_if(code.factors.begin(), code.factors.end(), [&](const auto& each) { return each.name == key; });
            REQUIRE(found != code.factors.end());
            CHECK_EXPECTED(data.factor(quantity).first_order.value, found->first_order.value);
            CHECK(data.relative(quantity) == doctest::Approx(found->first_order.relative).epsilon(1e-12));
        }
    }
    const LawCase mu = propagate_case("mu", {{"l", "1/107+/-0.4%"}, {"mu", kWoodRatio}, {"g", "1+/-0.2%"}});
    CHECK(mu.held("v/sqrt(mu*g*l)") == 0.0);
    // u(v/sqrt(mu g l))² = (u(l)² + u(mu)² + u(g)²)/4, a/(mu g): u(mu)² + u(g)²
    CHECK_EXPECTED(mu.shaken("v/sqrt(mu*g*l)"), 0.5 * std::hypot(0.004, std::sqrt(2.0) * 0.05, 0.002));
    CHECK_EXPECTED(mu.shaken("a/(mu*g)"), std::hypot(std::sqrt(2.0) * 0.05, 0.002));
    CHECK_EXPECTED(mu.watched("v/sqrt(g*l)"), 0.5 * std::sqrt(2.0) * 0.05);
}

TEST_CASE("solved factors of any law have the uncertainty of the chosen ones, by the powers they have in it") {
    // E = rho g l
    const LawCase replica = propagate_case("true_replica", {{"l", "1/25+/-0.4%"}, {"rho", "(2310+/-1%)/(2320+/-2%)"}});
    CHECK_EXPECTED(replica.relative("E"), std::hypot(0.004, 0.01, 0.02));
    CHECK_EXPECTED(replica.relative("t"), 0.5 * 0.004);
    CHECK(replica.held("E/(rho*g*l)") == 0.0);
    CHECK(replica.factor("E").first_order.exponents == std::vector{1.0, 1.0, -1.0});
    // g = E/(rho l)
    const LawCase centrifuge = propagate_case("centrifuge", {{"l", "1/25"}, {"E", "1+/-3%"}});
    CHECK_EXPECTED(centrifuge.relative("g"), 0.03);
    CHECK_EXPECTED(centrifuge.relative("v"), 0.5 * 0.03);
    // a lumped force: v = sqrt(l F_R/m)
    const LawCase force = propagate_case("restoring_force", {{"l", "1/25+/-1%"}, {"F_R", "1e-4+/-2%"}, {"rho", "1+/-3%"}});
    CHECK_EXPECTED(force.relative("a"), std::hypot(0.03, 0.02, 0.03));
    // shaken by values: v is certain, l, F_R and m = rho l³ are not
    CHECK_EXPECTED(force.shaken("v/sqrt(l*F_R/m)"), 0.5 * std::hypot(2.0 * 0.01, 0.02, 0.03));
    // widths follow friction; a/(mu g) is shaken by a value
    const LawCase tall = propagate_case("mu_vertical_distortion", {{"H", "1/25"}, {"mu", kWoodRatio}});
    CHECK_EXPECTED(tall.relative("b"), std::sqrt(2.0) * 0.05);
    CHECK(tall.watched("mu/tan_alpha") == 0.0);
    CHECK_EXPECTED(tall.shaken("a/(mu*g)"), std::sqrt(2.0) * 0.05);
}

TEST_CASE("powers of any denominator are found to rounding") {
    ScaleLaw law;
    law.name = "sevenths";
    for (const auto& [name, unit] : {std::pair("x", "m"), std::pair("y", "m"), std::pair("z", "m^5")}) {
        law.quantities.push_back({make_pi_quantity(name, unit), unit, ""});
    }
    law.choices = {{"x", {}}, {"z", {}}};
    law.held = {"y^7*x^3/z^2"};
    const std::vector<UncertainFactor> given = make_factors({{"x", "1/2+/-1%"}, {"z", "3+/-2%"}});
    const UncertainLawReport report = propagate(solve_law(law, values_of(given)), given, {}, {});
    // some ten roundings of 1e-16 over twice the logarithm of the move, 2e-3
    CHECK(report.factors[1]->first_order.relative == lsdem::tests::relative(std::hypot(3.0 / 7.0 * 0.01, 2.0 / 7.0 * 0.02), 1e-12));
}

TEST_CASE("values of the prototype are carried to the model with both uncertainties") {
    const LawCase replica = propagate_case("true_replica", {{"l", "1/25+/-0.4%"}}, {{"E", "29.2+/-5% GPa"}, {"v", "42.4 cm/s"}});
    REQUIRE(replica.report.values.size() == 2);
    const UncertainPair& velocity = replica.report.values[0];
    CHECK(velocity.name == "v");
    CHECK_EXPECTED(velocity.model.first_order.value, 0.0848);
    CHECK_EXPECTED(velocity.model.first_order.relative, 0.002);
    CHECK(velocity.prototype.first_order.relative == 0.0);
    const UncertainPair& modulus = replica.report.values[1];
    CHECK_EXPECTED(modulus.model.first_order.value, 1.168e9);
    CHECK_EXPECTED(modulus.model.first_order.uncertainty(), 1.168e9 * std::hypot(0.05, 0.004));
}

TEST_CASE("the prototype's value and the lower one of its fraction are one input") {
    const LawCase wood = propagate_case("mu", {{"l", "1/107"}, {"mu", kWoodRatio}}, {{"mu", "0.59+/-5%"}});
    CHECK(wood.report.inputs.size() == 2);
    CHECK_EXPECTED(wood.report.values[0].prototype.first_order.relative, 0.05);
    // 0.59 · 0.63/0.59: the model's own 5 %, not sqrt(3) of them
    CHECK_EXPECTED(wood.report.values[0].model.first_order.relative, 0.05);
    const auto message = [](const char* value) {
        return musim::tests::message_of<std::runtime_error>([&] {
            propagate_case("mu", {{"l", "1/107"}, {"mu", kWoodRatio}}, {{"mu", value}});
        });
    };
    CHECK(message("0.6").find("mu of the prototype is 0.6") != std::string::npos);
    CHECK(message("0.59+/-2%").find("leave one out") != std::string::npos);
    CHECK(message("0.59").empty());
}

TEST_CASE("an addition is a difference: its uncertainty is that of both sides, with what they share") {
    // (λ_E L²/g − L³) M: ∂/∂ln L = 2 L² − 3 L³, ∂/∂ln E = L²
    const MonteCarloSettings settings{.samples = musim::tests::trials(100'000), .seed = 3};
    const LawCase added = propagate_case("artificial_mass", {{"l", "1/25+/-0.4%"}, {"E", "1+/-1%"}}, {{"m_s", "270151+/-1% t"}}, settings);
    const double l = 1.0 / 25.0;
    const UncertainAddition& addition = *added.report.additions[0];
    CHECK_EXPECTED(addition.factor.value, l * l - l * l * l);
    CHECK_EXPECTED(addition.factor.uncertainty, std::hypot((2.0 * l * l - 3.0 * l * l * l) * 0.004, l * l * 0.01));
    REQUIRE(addition.model.has_value());
    CHECK_EXPECTED(addition.model->value, 270151e3 * (l * l - l * l * l));
    CHECK_EXPECTED(addition.model->uncertainty, 270151e3 * std::hypot(addition.factor.uncertainty, (l * l - l * l * l) * 0.01));
    // 5 standard deviations u/√(2 n) of sampling, and some relative u of second order
    const double share = addition.model->samples->standard_deviation / addition.model->uncertainty;
    CHECK(std::abs(share - 1.0) <= 5.0 / std::sqrt(2.0 * static_cast<double>(settings.samples)) + 0.02);

    // nothing to add, and less than nothing
    const LawCase none = propagate_case("artificial_mass", {{"l", "1"}, {"E", "1+/-1%"}});
    CHECK(none.report.additions[0]->factor.value == 0.0);
    CHECK_EXPECTED(none.report.additions[0]->factor.uncertainty, 0.01);
    const LawCase less = propagate_case("artificial_mass", {{"l", "1"}, {"E", "1/2+/-1%"}});
    CHECK_EXPECTED(less.report.additions[0]->factor.value, -0.5);
    CHECK_EXPECTED(less.report.additions[0]->factor.uncertainty, 0.005);
}

TEST_CASE("samples of solved factors agree with first order and depend on the seed alone") {
    constexpr std::size_t kSamples = musim::tests::trials(20'000);
    const auto run = [](std::uint64_t seed, int threads) {
        return propagate_case("true_replica", {{"l", "1/25+/-0.4%"}, {"rho", "1+/-1%"}}, {},
                              MonteCarloSettings{.samples = kSamples, .seed = seed, .threads = threads});
    };
    const LawCase one = run(7, 1), two = run(7, 2), other = run(8, 1);
    const SampleSummary& modulus = *one.factor("E").samples;
    CHECK(modulus.mean == two.factor("E").samples->mean);
    CHECK(modulus.upper == two.factor("E").samples->upper);
    CHECK(modulus.mean != other.factor("E").samples->mean);
    // 5 standard deviations of sampling: u/√n of the mean, u/√(2 n) of u; second order is some u² = 1e-4 of either
    const double u = one.factor("E").first_order.uncertainty();
    CHECK(std::abs(modulus.mean - 0.04) <= 5.0 * u / std::sqrt(double{kSamples}) + 0.02 * u);
    CHECK(std::abs(modulus.standard_deviation - u) <= 5.0 * u / std::sqrt(2.0 * kSamples) + 0.02 * u);
    CHECK(std::abs(modulus.lower - (0.04 - 1.96 * u)) <= 0.15 * u);
    // a certain one has no scatter at all
    CHECK(one.factor("g").samples->lower == 1.0);
    CHECK(one.factor("g").samples->upper == 1.0);
}

TEST_CASE("a held product that nothing is left to keep cannot rest on an uncertain factor") {
    const std::string message = musim::tests::message_of<std::runtime_error>([] {
        propagate_case("exact", {{"l", "1/25"}, {"mu", "1+/-5%"}});
    });
    CHECK(message.find("law exact: the factor of mu is uncertain, where mu is held") != std::string::npos);
    CHECK(message.find("watch mu instead") != std::string::npos);
    CHECK(musim::tests::message_of<std::runtime_error>([] {
              propagate_case("exact", {{"l", "1/25"}, {"mu", "1"}, {"rho", "1+/-1%"}});
          }).empty());
    CHECK(musim::tests::message_of<std::runtime_error>([] {
              propagate_case("true_replica", {{"l", "1/25"}}, {}, MonteCarloSettings{});
          }).find("nothing is uncertain") != std::string::npos);
}

}  // namespace musim::scaling::tests
