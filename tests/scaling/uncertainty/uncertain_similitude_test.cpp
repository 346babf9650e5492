#include "scaling/uncertainty/uncertain_similitude.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "scaling/laws/law_similitude.hpp"
#include "scaling/laws/scale_law_catalogue.hpp"
#include "tests/scaling/expected.hpp"

// The reference case of the shared similitude.md, 5.3: 1:107 in wood, 5 % on each friction coefficient.
namespace musim::scaling::tests {

namespace {

UncertainScales make_wood() {
    UncertainScales scales;
    scales.length = parse_uncertain_ratio("1/107");
    scales.friction = parse_uncertain_ratio("(0.63+/-5%)/(0.59+/-5%)");
    return scales;
}

UncertainReport propagate_by(const char* law, const UncertainScales& scales, const std::optional<MonteCarloSettings>& monte_carlo = {}) {
    const auto give = [](const ScaleFactors& factors) {
        std::vector<GivenFactor> given;
        for (const ChosenScale& scale : kChosenScales) given.push_back({scale.quantity, factors.*scale.factor});
        return given;
    };
    const LawFormulas formulas(solve_law(*find_scale_law(law), give(scales.factors())));
    return propagate(
        scales,
        [&](const ScaleFactors& factors, const std::vector<GivenFactor>&) {
            return make_similitude(formulas, formulas.choose(give(factors)));
        },
        {}, monte_carlo);
}

template <class Named>
const Named& find(const std::vector<Named>& list, std::string_view name) {
    const auto found = std::find_if(list.begin(), list.end(), [&](const Named& entry) { return entry.name == name; });
    REQUIRE_MESSAGE(found != list.end(), std::string(name));
    return *found;
}

double relative_of(const std::vector<UncertainResult>& list, std::string_view name) { return find(list, name).first_order.relative; }

}  // namespace

TEST_CASE("five percent on each friction coefficient leave 7.1 % in the friction factor, 3.5 % in time and velocity") {
    const UncertainReport report = propagate_by("mu", make_wood());
    const double u = std::sqrt(2.0) * 0.05;
    CHECK_EXPECTED(100.0 * u, "7.1");
    CHECK_EXPECTED(relative_of(report.factors, "friction"), u);
    CHECK_EXPECTED(relative_of(report.factors, "acceleration"), u);
    CHECK_EXPECTED(relative_of(report.factors, "time"), 0.5 * u);
    CHECK_EXPECTED(relative_of(report.factors, "velocity"), 0.5 * u);
    CHECK_EXPECTED(100.0 * relative_of(report.factors, "time"), "3.5");
    CHECK(relative_of(report.factors, "length") == 0.0);
    CHECK(relative_of(report.factors, "mass") == 0.0);
    // λ_a² λ_t: 3/2 powers of friction
    CHECK_EXPECTED(relative_of(report.factors, "arias_intensity"), 1.5 * u);
    // λ_μ - 1 = 6.8 % is 0.9 standard uncertainties
    const FirstOrder& friction = find(report.factors, "friction").first_order;
    CHECK_EXPECTED((friction.value - 1.0) / friction.uncertainty(), "0.9");
}

TEST_CASE("groups the law keeps are certain by the true factors, and uncertain in a test shaken by the values") {
    const UncertainReport report = propagate_by("mu", make_wood());
    const double u = std::sqrt(2.0) * 0.05;
    for (const char* kept : {"mu^N", "t*sqrt(mu*g/l)", "a/(mu*g)"}) CHECK(relative_of(report.groups, kept) == 0.0);
    CHECK_EXPECTED(relative_of(report.groups, "mu"), u);
    CHECK_EXPECTED(relative_of(report.groups, "omega/p"), 0.5 * u);
    CHECK_EXPECTED(relative_of(report.shaken, "mu^N"), 0.5 * u);
    CHECK_EXPECTED(relative_of(report.shaken, "t*sqrt(mu*g/l)"), 0.5 * u);
    CHECK_EXPECTED(relative_of(report.shaken, "a/(mu*g)"), u);
    for (const UncertainResult& group : report.shaken) CHECK_EXPECTED(group.first_order.value, 1.0);

    // the Froude law asks nothing of friction: its factors are certain, and both views of the groups agree
    const UncertainReport froude = propagate_by("froude", make_wood());
    CHECK(relative_of(froude.factors, "time") == 0.0);
    for (const UncertainResult& group : froude.shaken) {
        CHECK_EXPECTED(group.first_order.value, find(froude.groups, group.name).first_order.value);
        CHECK_EXPECTED(group.first_order.relative, relative_of(froude.groups, group.name));
    }
}

TEST_CASE("the mu number of prototype and model have the uncertainty of speed, length, friction and gravity") {
    UncertainScales scales = make_wood();
    scales.length = parse_uncertain_ratio("1/107+/-0.4%");
    scales.gravity = parse_uncertain_ratio("1+/-0.2%");
    scales.height = parse_uncertain_quantity<Length>("161.5+/-0.3% m");
    scales.motion.pgv = parse_uncertain_quantity<Velocity>("42.4+/-1% cm/s");
    scales.motion.pga = parse_uncertain_quantity<Acceleration>("0.511+/-2% g");
    const UncertainReport report = propagate_by("mu", scales);

    const UncertainPair& number = find(report.structure, "mu^N");
    CHECK_EXPECTED(number.prototype.first_order.value, "0.01387054");
    CHECK_EXPECTED(number.model.first_order.value, "0.01387054");
    CHECK_EXPECTED(number.prototype.first_order.relative, std::sqrt(0.01 * 0.01 + (0.003 * 0.003 + 0.05 * 0.05) / 4.0));
    CHECK_EXPECTED(number.model.first_order.relative,
                   std::sqrt(0.01 * 0.01 + (0.003 * 0.003 + 0.004 * 0.004 + 0.05 * 0.05 + 0.002 * 0.002) / 4.0));
    const UncertainPair& demand = find(report.structure, "a/(mu*g)");
    CHECK_EXPECTED(demand.prototype.first_order.value, "0.8661017");
    CHECK_EXPECTED(demand.prototype.first_order.relative, std::hypot(0.02, 0.05));
    CHECK_EXPECTED(demand.model.first_order.relative, std::sqrt(0.02 * 0.02 + 0.05 * 0.05 + 0.002 * 0.002));
}

TEST_CASE("the model's friction enters its factor and its regime by one value") {
    UncertainScales scales = make_wood();
    scales.slenderness = {parse_uncertain("0.32+/-1%"), parse_uncertain("0.6635")};
    const UncertainReport report = propagate_by("mu", scales, MonteCarloSettings{.samples = 50'000, .seed = 9});

    // μ^M/tan α = λ_μ μ^P/tan α: the prototype's coefficient cancels
    const UncertainPair& thin = find(report.structure, "mu/tan(alpha) at 0.32");
    CHECK_EXPECTED(thin.prototype.first_order.relative, std::hypot(0.05, 0.01));
    CHECK_EXPECTED(thin.model.first_order.relative, std::hypot(0.05, 0.01));
    REQUIRE(report.inputs.size() == 3);
    CHECK(report.inputs[0].name == "friction_model");
    CHECK(thin.model.first_order.exponents == std::vector{1.0, 0.0, -1.0});
    CHECK(thin.prototype.first_order.exponents == std::vector{0.0, 1.0, -1.0});

    // Monte Carlo sees the same: without correlation the spread would be √3 times 5 %, not 5 %
    const UncertainPair& wide = find(report.structure, "mu/tan(alpha) at 0.6635");
    const double u = wide.model.first_order.uncertainty();
    CHECK(std::abs(wide.model.samples->standard_deviation - u) <= 5.0 * u / std::sqrt(2.0 * 50'000.0));
    // 0.949 is 1.07 of its 5 % below 1: rocking can start first with Φ(-1.07) = 14 %
    const double above = 0.5 * std::erfc((1.0 - 0.63 / 0.6635) / u / std::sqrt(2.0));
    CHECK(std::abs(wide.model.samples->share_above_one - above) <= 5.0 * std::sqrt(above * (1.0 - above) / 50'000.0));
}

TEST_CASE("measures of the motion carry their own uncertainty and that of their factor") {
    UncertainScales scales = make_wood();
    scales.motion.pga = parse_uncertain_quantity<Acceleration>("0.511 g");
    scales.motion.pgv = parse_uncertain_quantity<Velocity>("42.4+/-0.4 cm/s");
    scales.motion.pgd = parse_uncertain_quantity<Length>("0.2 m");
    scales.motion.arias = parse_uncertain_quantity<Velocity>("2 m/s");
    scales.motion.duration = parse_uncertain_quantity<Time>("40 s");
    scales.motion.time_step = parse_uncertain_quantity<Time>("5 ms");
    const UncertainReport report = propagate_by("mu", scales);
    const double u = std::sqrt(2.0) * 0.05;
    const auto model = [&](const char* name) { return find(report.measures, name).model.first_order; };
    CHECK_EXPECTED(model("pga").value / kStandardGravity.value(), "0.5456441");
    CHECK_EXPECTED(model("pga").relative, u);
    CHECK_EXPECTED(100.0 * model("pgv").value, "4.235632");
    CHECK_EXPECTED(model("pgv").relative, std::hypot(0.5 * u, 0.4 / 42.4));
    CHECK(model("pgd").relative == 0.0);
    CHECK_EXPECTED(model("arias").relative, 1.5 * u);
    CHECK_EXPECTED(model("duration").value, "3.742173");
    CHECK_EXPECTED(1e3 * model("time_step").value, "0.4677716");
    CHECK_EXPECTED(model("time_step").relative, 0.5 * u);
}

TEST_CASE("the prototype's friction may be given twice, but not differently") {
    UncertainScales scales = make_wood();
    scales.slenderness = {parse_uncertain("0.32")};
    for (const char* same : {"0.59", "0.59+/-5%"}) {
        scales.friction_prototype = parse_uncertain(same);
        CHECK(propagate_by("mu", scales).inputs.size() == 2);
    }
    for (const char* other : {"0.6", "0.59+/-4%"}) {
        scales.friction_prototype = parse_uncertain(other);
        CHECK_THROWS_AS(propagate_by("mu", scales), SimilitudeError);
    }
    // a ratio alone does not contain it: then it is an input of its own
    scales.friction = parse_uncertain_ratio("1.07+/-7%");
    CHECK(propagate_by("mu", scales).inputs.size() == 2);
    CHECK(propagate_by("mu", scales).inputs[1].name == "friction_prototype");
}

TEST_CASE("the exact law takes no uncertain friction factor") {
    UncertainScales scales = make_wood();
    scales.friction = parse_uncertain_ratio("1+/-5%");
    CHECK_THROWS_AS(propagate_by("exact", scales), SimilitudeError);
    scales.friction = {};
    scales.length = parse_uncertain_ratio("1/25+/-1%");
    CHECK_EXPECTED(relative_of(propagate_by("exact", scales).factors, "mass"), 0.03);
}

TEST_CASE("without uncertain inputs values come without uncertainty, and Monte Carlo is refused") {
    UncertainScales scales;
    scales.length = parse_uncertain_ratio("1/25");
    CHECK_FALSE(scales.is_uncertain());
    const UncertainReport report = propagate_by("mu", scales);
    CHECK(report.inputs.empty());
    CHECK(relative_of(report.factors, "time") == 0.0);
    CHECK_THROWS_AS(propagate_by("mu", scales, MonteCarloSettings{}), SimilitudeError);
}

}  // namespace musim::scaling::tests
