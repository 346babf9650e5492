#include "scaling/structures/regime_report.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "scaling/laws/law_similitude.hpp"
#include "scaling/laws/scale_law_catalogue.hpp"
#include "scaling/structures/group_values.hpp"
#include "tests/scaling/expected.hpp"
#include "tests/scaling/paper_towers.hpp"

namespace musim::scaling::tests {

namespace {

/// The concrete prototype under the Ridgecrest motion, and a model.
PairProperties make_pair(const StructureProperties& model) {
    return {.prototype = concrete_prototype(), .model = model, .motion = ridgecrest()};
}

/// Aluminium and wood in blocks of exactly 1:107.
StructureProperties at_1_107(StructureProperties model) {
    for (std::size_t i = 0; i < 3; ++i) model.block[i] = concrete_prototype().block[i] / 107.0;
    return model;
}

KeptNumbers find_kept(const char* law) { return find_kept_numbers(solve_law(*find_scale_law(law), {{"l", 1.0 / 107.0}})); }

RegimeReport report(const PairProperties& properties, const char* law, double length = 1.0 / 107.0) {
    return make_regime_report(properties, make_similitude(law, make_scale_factors(properties, length)), find_kept(law));
}

const GroupComparison& find_group(const RegimeReport& report, std::string_view name, std::optional<Direction> direction = {}) {
    const auto found = std::find_if(report.groups.begin(), report.groups.end(),
                                    [&](const auto& group) { return group.name == name && group.direction == direction; });
    REQUIRE_MESSAGE(found != report.groups.end(), name);
    return *found;
}

const RegimeStatement* find_regime(const RegimeReport& report, std::string_view topic, std::optional<Direction> direction = {}) {
    const auto found = std::find_if(report.regimes.begin(), report.regimes.end(),
                                    [&](const auto& each) { return each.topic == topic && each.direction == direction; });
    return found == report.regimes.end() ? nullptr : &*found;
}

struct Row {
    std::string name;
    std::optional<Direction> direction;
    Expected froude_aluminium, froude_wood, mu_aluminium, mu_wood;
};

}  // namespace

TEST_CASE("factors of the report's groups agree with the reference table of unequal friction") {
    const std::vector<Row> rows = {
        {"mu^N", {}, "1.8105", "0.9677", 1.0, 1.0},
        {"T_p*sqrt(mu*g/l)", {}, "0.5523", "1.0333", 1.0, 1.0},
        {"a/(mu*g)", {}, "3.2778", "0.9365", 1.0, 1.0},
        {"a/g", {}, 1.0, 1.0, "0.3051", "1.0678"},
        {"a/(g*tan(alpha))", Direction::thin, 1.0, 1.0, "0.3051", "1.0678"},
        {"a/(g*tan(alpha))", Direction::wide, 1.0, 1.0, "0.3051", "1.0678"},
        {"omega/p", Direction::thin, 1.0, 1.0, "0.5523", "1.0333"},
        {"Fr^N", {}, 1.0, 1.0, "0.5523", "1.0333"},
        {"mu/tan(alpha)", Direction::thin, "0.3051", "1.0678", "0.3051", "1.0678"},
        {"mu", {}, "0.3051", "1.0678", "0.3051", "1.0678"},
    };
    const PairProperties aluminium = make_pair(at_1_107(aluminium_1_107())), wood = make_pair(at_1_107(wood_1_107()));
    for (const Row& row : rows) {
        CAPTURE(row.name);
        CHECK_EXPECTED(find_group(report(aluminium, "froude"), row.name, row.direction).factor(), row.froude_aluminium);
        CHECK_EXPECTED(find_group(report(wood, "froude"), row.name, row.direction).factor(), row.froude_wood);
        CHECK_EXPECTED(find_group(report(aluminium, "mu"), row.name, row.direction).factor(), row.mu_aluminium);
        CHECK_EXPECTED(find_group(report(wood, "mu"), row.name, row.direction).factor(), row.mu_wood);
    }
}

TEST_CASE("values of prototype and models agree with the reference cases") {
    const RegimeReport wood = report(make_pair(wood_1_107()), "mu");
    CHECK_EXPECTED(find_group(wood, "mu^N").prototype, "0.01387054");
    CHECK_EXPECTED(find_group(wood, "a/(mu*g)").prototype, "0.8661017");
    CHECK_EXPECTED(find_group(wood, "Fr^N").prototype, "0.01065416");
    CHECK_EXPECTED(find_group(wood, "mu/tan(alpha)", Direction::thin).prototype, "1.844");
    CHECK_EXPECTED(find_group(wood, "mu/tan(alpha)", Direction::wide).prototype, "0.889");
    CHECK_EXPECTED(find_group(wood, "kappa_n").model / 1e6, "2.416");
    CHECK_EXPECTED(find_group(wood, "delta_w/sigma_H").model * 1e4, "8.5");
    CHECK_EXPECTED(find_group(wood, "sigma_H/H").model * 100.0, "0.390");
    CHECK_EXPECTED(find_group(wood, "e_r", Direction::wide).prototype, "0.5415");  // √0.2932
    // ω/p at T = 0.5 s: 4π over 1.8156 1/s, printed to five digits
    CHECK(find_group(wood, "omega/p", Direction::thin).prototype == doctest::Approx(4.0 * std::numbers::pi / 1.8156).epsilon(3e-5));
    // measured blocks stand for 1:106.84, not 1:107
    CHECK_EXPECTED(107.0 / find_group(wood, "H/(lambda_l*H_prototype)").factor(), "106.84");
    CHECK(find_group(wood, "H/(lambda_l*H_prototype)").severity == Severity::note);
}

TEST_CASE("the same solid at 1:25 keeps all but contact rigidity and structural speed") {
    const StructureProperties model = concrete_1_25();
    const RegimeReport same = report(make_pair(model), "froude", 1.0 / 25.0);
    CHECK_EXPECTED(find_group(same, "S_e^N").factor(), 5.0);
    CHECK_EXPECTED(find_group(same, "kappa_n").factor(), 25.0);
    for (const GroupComparison& group : same.groups) {
        const bool is_elastic = group.name == "S_e^N" || group.name == "kappa_n" || group.name == "C^N" || group.name == "delta_w/sigma_H";
        CAPTURE(group.name);
        CHECK(group.severity.has_value() == is_elastic);
        CHECK(group.effect.empty() != is_elastic);
        CHECK_FALSE(group.sources.empty());
    }
    CHECK(find_group(same, "S_e^N").severity == Severity::warning);
    for (const RegimeStatement& regime : same.regimes) CHECK_FALSE(regime.severity.has_value());
}

TEST_CASE("a harder contact is a note while the overlap is small in both, a warning otherwise or when it is not known") {
    // base overlap over σ_H: prototype 38 m g/(k_n σ_H) = 0.043, model 25 times less
    PairProperties properties = make_pair(concrete_1_25());
    const RegimeReport rigid = report(properties, "froude", 1.0 / 25.0);
    CHECK_EXPECTED(find_group(rigid, "delta_w/sigma_H").prototype, "0.043");
    CHECK(find_group(rigid, "kappa_n").severity == Severity::note);
    CHECK(find_group(rigid, "delta_w/sigma_H").severity == Severity::note);
    CHECK(find_group(rigid, "C^N").severity == Severity::note);
    CHECK(find_regime(rigid, "contacts")->statement.find("rigid: heights decide who carries in both") != std::string::npos);

    properties.prototype.height_deviation = 1e-3 * si::meters;  // 0.54
    const RegimeReport soft = report(properties, "froude", 1.0 / 25.0);
    CHECK(find_group(soft, "kappa_n").severity == Severity::warning);
    CHECK(find_regime(soft, "contacts")->severity == Severity::warning);

    properties.prototype.height_deviation.reset();
    const RegimeReport unknown = report(properties, "froude", 1.0 / 25.0);
    CHECK(find_group(unknown, "kappa_n").severity == Severity::warning);
    CHECK(find_group(unknown, "kappa_n").effect.find("without sigma_H") != std::string::npos);
    CHECK(find_regime(unknown, "contacts") == nullptr);
    const auto not_given =
        std::find_if(unknown.untold.begin(), unknown.untold.end(), [](const auto& each) { return each.name == "sigma_H/H"; });
    REQUIRE(not_given != unknown.untold.end());
    CHECK(not_given->missing == "prototype");
}

TEST_CASE("aluminium slides where concrete rocks: errors in the thin direction, whatever the input") {
    const PairProperties properties = make_pair(at_1_107(aluminium_1_107()));
    for (const char* law : {"mu", "froude"}) {
        const RegimeReport aluminium = report(properties, law);
        CHECK(find_group(aluminium, "mu/tan(alpha)", Direction::thin).severity == Severity::error);
        CHECK(find_group(aluminium, "mu/tan(alpha)", Direction::wide).severity == Severity::warning);
        CHECK(find_regime(aluminium, "sliding or rocking first", Direction::thin)->severity == Severity::error);
        CHECK_FALSE(find_regime(aluminium, "sliding or rocking first", Direction::wide)->severity.has_value());
        CHECK(find_regime(aluminium, "first motion", Direction::thin)->severity == Severity::error);
    }
    // PGA/(g tan α) = 1.597: lifted; by the mu law 0.487
    const RegimeReport by_mu = report(properties, "mu"), by_froude = report(properties, "froude");
    CHECK(find_regime(by_mu, "uplift", Direction::thin)->severity == Severity::error);
    CHECK(find_regime(by_mu, "uplift", Direction::thin)->statement ==
          "a/(g*tan(alpha)) goes from 1.597 (the peak lifts a block) to 0.4872 (the peak lifts no block); the motion of law froude keeps "
          "this "
          "group, with equal friction that of law mu does too");
    CHECK_FALSE(find_regime(by_froude, "uplift", Direction::thin)->severity.has_value());
    CHECK(find_regime(by_mu, "first motion", Direction::thin)->statement ==
          "under the peak a single block rocks in the prototype, rests in the model");
    // PGA/(μ g) = 0.866, by Froude's law 2.84
    CHECK_FALSE(find_regime(by_mu, "sliding")->severity.has_value());
    CHECK(find_regime(by_froude, "sliding")->severity == Severity::error);
    CHECK(find_regime(by_froude, "first motion", Direction::thin)->statement ==
          "under the peak a single block rocks in the prototype, slides in the model");

    // wood stays on its side everywhere
    for (const RegimeStatement& regime : report(make_pair(wood_1_107()), "mu").regimes) CHECK(regime.severity != Severity::error);
}

TEST_CASE("a group that sits on its border is not carried over it by rounding") {
    PairProperties properties = make_pair(at_1_107(wood_1_107()));
    properties.model.friction = properties.prototype.friction;
    properties.motion->acceleration = properties.prototype.friction * properties.prototype.gravity;
    properties.model_motion = properties.motion;
    properties.model_motion->acceleration *= 1.0 + 1e-15;
    CHECK_FALSE(find_regime(report(properties, "mu"), "sliding")->severity.has_value());
    properties.model_motion->acceleration *= 1.0 + 1e-9;
    CHECK(find_regime(report(properties, "mu"), "sliding")->severity == Severity::error);
}

TEST_CASE("each law asks for its own groups") {
    const PairProperties properties = make_pair(at_1_107(aluminium_1_107()));
    const auto is_required = [&](const char* law, std::string_view name, std::optional<Direction> direction = {}) {
        return find_group(report(properties, law), name, direction).is_required;
    };
    for (const char* law : {"mu", "froude", "cauchy"}) CHECK(is_required(law, "b/H"));
    CHECK(is_required("mu", "mu^N"));
    CHECK_FALSE(is_required("mu", "mu"));
    CHECK_FALSE(is_required("mu", "a/(g*tan(alpha))", Direction::thin));
    CHECK(is_required("froude", "a/(g*tan(alpha))", Direction::thin));
    CHECK(is_required("froude", "mu"));
    CHECK_FALSE(is_required("froude", "S_e^N"));
    CHECK(is_required("cauchy", "C^N"));
    CHECK_FALSE(is_required("cauchy", "a/g"));

    PairProperties twin = properties;
    twin.model.friction = twin.prototype.friction;
    for (const GroupComparison& group : report(twin, "exact").groups) CHECK(group.is_required);
}

TEST_CASE("what the table gave the model counts, where it is given") {
    PairProperties properties = make_pair(at_1_107(wood_1_107()));
    const Similitude similitude = make_similitude("mu", make_scale_factors(properties, 1.0 / 107.0));
    properties.model_motion = to_model(*properties.motion, similitude);
    properties.model_motion->acceleration *= 0.8;
    const RegimeReport weak = make_regime_report(properties, similitude, find_kept("mu"));
    CHECK_EXPECTED(find_group(weak, "a/(mu*g)").factor(), 0.8);
    CHECK(find_group(weak, "a/(mu*g)").severity == Severity::warning);
    CHECK(find_group(weak, "a/(mu*g)").is_required);
    CHECK_EXPECTED(find_group(weak, "mu^N").factor(), 1.0);
}

TEST_CASE("a table is held against the frequencies of the model's motion") {
    PairProperties properties = make_pair(at_1_107(wood_1_107()));
    properties.motion->highest_frequency = 10.0 / si::seconds;
    const double predominant = 2.0 * 10.68898;  // 1/λ_t of the mu law, wood
    properties.table = Bandwidth{.highest = 5.01 * predominant / si::seconds};
    CHECK_FALSE(find_regime(report(properties, "mu"), "table")->severity.has_value());
    properties.table = Bandwidth{.highest = 4.99 * predominant / si::seconds};
    CHECK(find_regime(report(properties, "mu"), "table")->severity == Severity::warning);
    properties.table = Bandwidth{.highest = 0.99 * predominant / si::seconds};
    CHECK(find_regime(report(properties, "mu"), "table")->severity == Severity::error);
    properties.table = Bandwidth{.lowest = 1.01 * predominant / si::seconds};
    CHECK(find_regime(report(properties, "mu"), "table")->severity == Severity::error);
    properties.table = Bandwidth{};
    CHECK(find_regime(report(properties, "mu"), "table") == nullptr);
}

TEST_CASE("zero is a value: gaps that close and vertical shaking that is left out are distortions") {
    PairProperties properties = make_pair(at_1_107(wood_1_107()));
    properties.prototype.gap = 0.05 * si::meters;
    properties.model.gap = 0.0 * si::meters;
    properties.motion->vertical_acceleration = 0.0 * si::meters_per_second_squared;
    properties.prototype.edge_radius = 0.0 * si::meters;
    properties.model.edge_radius = 1e-3 * si::meters;
    const RegimeReport zeros = report(properties, "mu");
    CHECK(find_group(zeros, "gap/H").factor() == 0.0);
    CHECK(find_group(zeros, "gap/H").severity == Severity::warning);
    CHECK(find_group(zeros, "a_vertical/g").factor() == 1.0);
    CHECK_FALSE(find_group(zeros, "a_vertical/g").severity.has_value());
    CHECK(std::isinf(find_group(zeros, "edge_radius/H").factor()));
    CHECK(find_group(zeros, "edge_radius/H").severity == Severity::warning);
}

TEST_CASE("without a motion what it would decide is left out") {
    PairProperties properties = make_pair(at_1_107(wood_1_107()));
    properties.motion.reset();
    const RegimeReport still = report(properties, "mu");
    CHECK(find_regime(still, "first motion", Direction::thin) == nullptr);
    CHECK(find_regime(still, "uplift", Direction::thin) == nullptr);
    CHECK(find_regime(still, "sliding or rocking first", Direction::thin) != nullptr);
    for (const GroupComparison& group : still.groups) CHECK(group.kind != GroupClass::loading);
}

TEST_CASE("every group has a meaning with a source, and every known factor too") {
    MotionProperties motion = ridgecrest();
    for (const GroupValue& value : find_group_values(wood_1_107(), &motion, 1.0 * si::meters)) {
        const GroupMeaning& meaning = find_group_meaning(value.name);
        CHECK_FALSE(meaning.list_sources().empty());
        CHECK(meaning.if_larger != meaning.if_smaller);
    }
    const ModelProperties all{.friction_prototype = 0.59,
                              .slenderness = {0.32},
                              .normal_stiffness = 1.0,
                              .shear_stiffness = 1.0,
                              .restitution = 1.0,
                              .height_deviation = 1.0};
    for (const NamedFactor& factor : group_factors(make_similitude("mu", {.length = 0.5}), all))
        CHECK_NOTHROW(find_group_meaning(factor.name));
    CHECK_THROWS_AS(find_group_meaning("no such group"), std::out_of_range);
}

TEST_CASE("factors of the report are those of find_distortions where both give them") {
    for (const char* law : {"mu", "froude"}) {
        const PairProperties properties = make_pair(at_1_107(aluminium_1_107()));
        const Similitude similitude = make_similitude(law, make_scale_factors(properties, 1.0 / 107.0));
        const RegimeReport full = make_regime_report(properties, similitude, find_kept(law));
        for (const NamedFactor& factor : group_factors(similitude, make_model_properties(properties))) {
            for (const GroupComparison& group : full.groups) {
                // sizes of 1:107 rounded to doubles, roots of products of them: far below 1e-12
                if (group.name == factor.name) CHECK(group.factor() == doctest::Approx(factor.value).epsilon(1e-12));
            }
        }
    }
}

TEST_CASE("properties that cannot be are refused with their owner") {
    const auto message = [](auto spoil) {
        PairProperties properties = make_pair(wood_1_107());
        spoil(properties);
        try {
            report(properties, "mu");
        } catch (const SimilitudeError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK(message([](PairProperties& properties) { properties.model.normal_stiffness = Stiffness::from_value(0.0); }) ==
          "properties: the normal stiffness of the model is 0 (must be positive and finite); correct it");
    CHECK(message([](PairProperties& properties) { properties.prototype.layers = 0; }) ==
          "properties: the number of layers of the prototype is 0 (must be positive and finite); correct it");
    CHECK(message([](PairProperties& properties) { properties.model.gap = -1.0 * si::meters; }) ==
          "properties: the gap of the model is -1 (must be finite and not below 0); correct it");
    CHECK(message([](PairProperties& properties) { properties.motion->velocity = Velocity::from_value(std::nan("")); }) ==
          "properties: the velocity of the prototype's motion is nan (must be positive and finite); correct it");
    CHECK(message([](PairProperties& properties) { properties.table = Bandwidth{.highest = 0.0 / si::seconds}; }) ==
          "properties: the highest frequency of the table is 0 (must be positive and finite); correct it");
    CHECK(message([](PairProperties&) {}).empty());
}

}  // namespace musim::scaling::tests
