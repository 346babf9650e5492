#include "scaling/uncertainty/uncertain_regimes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <span>
#include <string>

#include "scaling/laws/law_similitude.hpp"
#include "scaling/laws/scale_law_catalogue.hpp"
#include "scaling/uncertainty/uncertain_reading.hpp"
#include "tests/scaling/expected.hpp"
#include "tests/scaling/paper_towers.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/trials.hpp"

namespace musim::scaling::tests {

using lsdem::tests::relative;

namespace {

/// Exponents are exact but for rounding, variances add by two roundings each.
constexpr double kFormulaRounding = 1e-12;

/// Properties as a file would say them: a value to take for each place.
using Say = std::function<PairProperties(UncertainReading&)>;

struct Reported {
    RegimeReport report;
    UncertainRegimes uncertain;

    const UncertainComparison& group(std::string_view name, std::optional<Direction> direction = {}) const {
        const auto found = std::find_if(report.groups.begin(), report.groups.end(),
                                        [&](const auto& each) { return each.name == name && each.direction == direction; });
        REQUIRE_MESSAGE(found != report.groups.end(), name);
        return uncertain.groups[static_cast<std::size_t>(found - report.groups.begin())];
    }
    double share_elsewhere(std::string_view topic, std::optional<Direction> direction = {}) const {
        return uncertain.samples->shares_elsewhere[static_cast<std::size_t>(&regime(topic, direction) - report.regimes.data())];
    }
    const RegimeStatement& regime(std::string_view topic, std::optional<Direction> direction = {}) const {
        const auto found = std::find_if(report.regimes.begin(), report.regimes.end(),
                                        [&](const auto& each) { return each.topic == topic && each.direction == direction; });
        REQUIRE_MESSAGE(found != report.regimes.end(), topic);
        return *found;
    }
};

Reported report(const Say& say, const std::optional<MonteCarloSettings>& monte_carlo = {}) {
    constexpr double length = 1.0 / 107.0;
    const auto give = [](const ScaleFactors& factors) {
        return std::vector<GivenFactor>{{"l", factors.length}, {"mu", factors.friction}, {"g", factors.gravity}, {"rho", factors.density}};
    };
    const LawFormulas formulas(solve_law(*find_scale_law("mu"), give({.length = length})));
    const KeptNumbers kept = find_kept_numbers(formulas.solved());
    const auto read = [&](UncertainReading& reading) {
        const PairProperties properties = say(reading);
        return PropertiesAndLaw{properties, make_similitude(formulas, formulas.choose(give(make_scale_factors(properties, length))))};
    };
    UncertainReading reading("f.json");
    PropertiesAndLaw properties = read(reading);
    const auto shake = [&](PropertiesAndLaw one) {
        if (one.properties.motion && !one.properties.model_motion) {
            one.properties.model_motion = to_model(*one.properties.motion, properties.similitude);
        }
        return one;
    };
    std::vector<MovedProperties> moved;
    for (const auto& each : read_moved(reading, read)) moved.push_back({shake(each.below), shake(each.above)});
    properties = shake(properties);
    RegimeReport report = make_regime_report(properties.properties, properties.similitude, kept);
    UncertainRegimes uncertain = propagate(report, properties, kept, reading.inputs(), moved);
    if (monte_carlo) {
        const auto draw = [&](std::span<const double> values) { return shake(read_drawn(reading, values, read)); };
        add_samples(uncertain, report, properties, kept, draw, *monte_carlo);
    }
    return {report, uncertain};
}

/// The concrete tower and a wooden model under the Ridgecrest motion, friction and peak known to some share.
Say towers(double friction, double peak) {
    return [=](UncertainReading& reading) {
        PairProperties properties{.prototype = concrete_prototype(), .model = wood_1_107(), .motion = ridgecrest()};
        properties.prototype.friction = reading.take("prototype: friction", {0.59, 0.59 * friction});
        properties.model.friction = reading.take("model: friction", {0.63, 0.63 * friction});
        const double a = properties.motion->acceleration.value();
        properties.motion->acceleration = Acceleration::from_value(reading.take("motion: acceleration", {a, a * peak}));
        return properties;
    };
}

}  // namespace

TEST_CASE("groups of a test as it is shaken have the uncertainties of their closed forms") {
    const Reported given = report(towers(0.05, 0.02));
    CHECK(given.uncertain.inputs.size() == 3);
    // prototype and model: u(a/(μ g))² = u(a)² + u(μ)²; of their ratio the peak cancels, as the model is shaken by the prototype's
    CHECK(given.group("a/(mu*g)").prototype.relative == relative(std::hypot(0.02, 0.05), kFormulaRounding));
    CHECK(given.group("a/(mu*g)").model.relative == relative(std::hypot(0.02, 0.05), kFormulaRounding));
    CHECK(given.group("a/(mu*g)").factor.relative == relative(std::hypot(0.05, 0.05), kFormulaRounding));
    CHECK(given.group("mu^N").model.relative == relative(0.025, kFormulaRounding));
    CHECK(given.group("a/g").factor.relative == 0.0);  // shaken with a value of λ_μ
    CHECK(given.group("mu/tan(alpha)", Direction::thin).model.relative == relative(0.05, kFormulaRounding));
    CHECK(given.group("e_r", Direction::thin).model.relative == 0.0);
    // factors are those to aim at
    for (const UncertainResult& factor : given.uncertain.factors) {
        if (factor.name == "time") CHECK(factor.first_order.relative == relative(0.5 * std::hypot(0.05, 0.05), kFormulaRounding));
        if (factor.name == "mass") CHECK(factor.first_order.relative == 0.0);
    }
}

TEST_CASE("an uncertain block moves restitution by its slope, of either sign") {
    const Reported given = report([](UncertainReading& reading) {
        PairProperties properties{.prototype = concrete_prototype(), .model = wood_1_107()};
        const double b = properties.model.block[0].value();
        properties.model.block[0] = Length::from_value(reading.take("model: block b", {b, 0.01 * b}));
        return properties;
    });
    // e_r = 1 − 1.5 sin²α with tan α = b/H: ∂e_r/∂ln b = −3 sin²α cos²α
    const StructureProperties model = wood_1_107();
    const double slenderness = (model.block[0] / model.block[2]).value(), cosine2 = 1.0 / (1.0 + slenderness * slenderness);
    const double expected = 0.01 * 3.0 * (1.0 - cosine2) * cosine2;
    CHECK(given.group("e_r", Direction::thin).model.uncertainty() == relative(expected, 1e-5));  // h² = 1e-6 of the difference
    CHECK(given.group("e_r", Direction::thin).prototype.relative == 0.0);
}

TEST_CASE("a regime says when its limit lies within the uncertainty, and only then") {
    // μ/tan α of wood, wide: 0.951, which is 1 at +5.1 %; 95 % reach 1.96 u
    const Reported vague = report(towers(0.05, 0.0)), sharp = report(towers(0.02, 0.0));
    const RegimeStatement& open = vague.regime("sliding or rocking first", Direction::wide);
    CHECK(open.is_open);
    CHECK(open.severity == Severity::warning);
    CHECK(open.statement.find("; not sure: mu/tan(alpha) of the model is 0.95") != std::string::npos);
    CHECK_FALSE(sharp.regime("sliding or rocking first", Direction::wide).is_open);
    CHECK_FALSE(sharp.regime("sliding or rocking first", Direction::wide).severity.has_value());
    CHECK_FALSE(vague.regime("sliding or rocking first", Direction::thin).is_open);  // 1.84 and 1.97
    // a/(μ g) = 0.866 in both: 1 at +14 %, within 1.96 hypot(5 %, 6 %) = 15 %
    const Reported shaken = report(towers(0.05, 0.06));
    CHECK(shaken.regime("sliding").is_open);
    CHECK_FALSE(vague.regime("sliding").is_open);
    // wide: blocks at rest under 0.77 and 0.82 of what they bear, so that sliding or rocking is no question yet
    CHECK_FALSE(vague.regime("first motion", Direction::wide).is_open);
    const Reported strong = report(towers(0.05, 0.12));
    CHECK(strong.regime("first motion", Direction::wide).is_open);
    CHECK(strong.regime("first motion", Direction::wide).statement.find("the peak of the model is") != std::string::npos);
}

TEST_CASE("contacts and the table's band have limits of their own") {
    const auto properties = [](double deviation, double highest) {
        return [=](UncertainReading& reading) {
            PairProperties pair{.prototype = concrete_prototype(), .model = wood_1_107(), .motion = ridgecrest()};
            // δ_w/σ_H of the prototype is 0.043, its limit 0.1
            pair.prototype.height_deviation = Length::from_value(reading.take("s", {12.5e-3, 12.5e-3 * deviation}));
            pair.motion->highest_frequency = Frequency::from_value(8.0);
            pair.table = Bandwidth{.highest = Frequency::from_value(reading.take("table", {90.0, 90.0 * highest}))};
            return pair;
        };
    };
    // the model's 8 Hz are 85.5 Hz: 0.95 of the table's
    const Reported vague = report(properties(0.6, 0.04)), sharp = report(properties(0.1, 0.01));
    CHECK(vague.regime("contacts").is_open);
    CHECK(vague.regime("table").is_open);
    CHECK(vague.regime("table").statement.find("highest frequency of the model is 0.95") != std::string::npos);
    CHECK_FALSE(sharp.regime("contacts").is_open);
    CHECK_FALSE(sharp.regime("table").is_open);
}

TEST_CASE("samples of properties have the distribution of their closed forms") {
    const MonteCarloSettings settings{.samples = musim::tests::trials(20'000), .seed = 5, .distribution = Distribution::lognormal};
    const Reported given = report(towers(0.2, 0.1), settings);
    REQUIRE(given.group("a/(mu*g)").samples.has_value());
    const SampleSummary& demand = given.group("a/(mu*g)").samples->model;
    // logarithms of a and μ are normal, with variances ln(1 + r²) and medians value/√(1 + r²): so is that of a/(μ g)
    const double median = given.group("a/(mu*g)").model.value * std::sqrt((1.0 + 0.2 * 0.2) / (1.0 + 0.1 * 0.1));
    const double sigma = std::sqrt(std::log1p(0.2 * 0.2) + std::log1p(0.1 * 0.1));
    // standard errors of quantiles p: √(p (1 − p)/N) over the density there, four of them
    const double root = std::sqrt(static_cast<double>(settings.samples));
    CHECK(std::abs(std::log(demand.median / median)) < 4.0 * sigma * std::sqrt(0.5 * std::numbers::pi) / root);
    const double tail = 4.0 * sigma * std::sqrt(0.025 * 0.975) / (0.05845 * root);  // normal density at 1.95996
    CHECK(std::abs(std::log(demand.lower / median) + 1.959964 * sigma) < tail);
    CHECK(std::abs(std::log(demand.upper / median) - 1.959964 * sigma) < tail);
    // the peak cancels of model/prototype
    const SampleSummary& factor = given.group("a/(mu*g)").samples->factor;
    const double sigma_factor = std::sqrt(2.0 * std::log1p(0.2 * 0.2));
    CHECK(std::abs(std::log(factor.upper / factor.lower) / (2.0 * 1.959964 * sigma_factor) - 1.0) < 8.0 * 2.67 / (3.92 * root));
    CHECK(given.uncertain.samples->draws.rejected == 0);
    CHECK(given.uncertain.factors.front().samples.has_value());
}

TEST_CASE("the share of samples in another regime is that of the normal distribution") {
    const MonteCarloSettings settings{.samples = musim::tests::trials(20'000), .seed = 11};
    const Reported given = report(towers(0.05, 0.0), settings);
    // μ/tan α is normal, 0.889 and 0.951 times 1 ± 5 %: the chance that either is above 1
    const auto above = [](double ratio) { return 0.5 * std::erfc((1.0 / ratio - 1.0) / (0.05 * std::numbers::sqrt2)); };
    const UncertainComparison& group = given.group("mu/tan(alpha)", Direction::wide);
    const double expected = 1.0 - (1.0 - above(group.prototype.value)) * (1.0 - above(group.model.value));
    const double error = std::sqrt(expected * (1.0 - expected) / static_cast<double>(settings.samples));
    CHECK(expected > 0.1);
    CHECK(std::abs(given.share_elsewhere("sliding or rocking first", Direction::wide) - expected) < 4.0 * error);
    CHECK(given.share_elsewhere("sliding or rocking first", Direction::thin) == 0.0);  // 1.84 is 9 u away
}

TEST_CASE("samples of properties are the same bits for one seed, whatever the threads") {
    const auto draw = [](std::uint64_t seed, int threads) {
        return report(towers(0.05, 0.02), MonteCarloSettings{.samples = 3'000, .seed = seed, .threads = threads});
    };
    const Reported one = draw(3, 1), three = draw(3, 3), other = draw(4, 3);
    for (std::size_t i = 0; i < one.uncertain.groups.size(); ++i) {
        const ComparisonSamples &a = *one.uncertain.groups[i].samples, &b = *three.uncertain.groups[i].samples;
        CHECK(a.model.mean == b.model.mean);
        CHECK(a.factor.upper == b.factor.upper);
    }
    CHECK(one.uncertain.samples->shares_elsewhere == three.uncertain.samples->shares_elsewhere);
    CHECK(one.group("mu^N").samples->model.mean != other.group("mu^N").samples->model.mean);
}

}  // namespace musim::scaling::tests
