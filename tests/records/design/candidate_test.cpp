#include "records/design/candidate.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "tests/records/design/tower.hpp"
#include "tests/support/relative.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;

/// Ends are bisected to the last double; closed forms and factors are products and roots of a few more roundings.
constexpr double kRounding = 16.0 * std::numeric_limits<double>::epsilon();

/// λ_μ of wood.
constexpr double kWoodFriction = 0.63 / 0.59;

FeasibleRange only_range(const Setting& setting, const Material& material, const char* law = "mu") {
    const Candidate candidate = find_candidate(setting, material, by(law));
    REQUIRE_MESSAGE(candidate.ranges.size() == 1, candidate.problem);
    return candidate.ranges.front();
}

}  // namespace

TEST_CASE("displacement allows up to D/d, whatever the law") {
    records::TableAxis axis = free_axis();
    axis.displacement = 0.005 * si::meters;
    for (const char* law : {"mu", "froude", "cauchy"}) {
        const FeasibleRange range = only_range(make_setting(axis), wood(), law);
        CHECK(range.scales.largest == relative(0.005 / 0.2, kRounding));
        CHECK(range.scales.smallest == records::kSmallestScale);
        CHECK(range.binds_above == "displacement of axis x");
        CHECK(range.binds_below.empty());
    }
}

TEST_CASE("velocity allows up to (V/v)^2/(U G) by the mu law, (V/v)^2/G by Froude's") {
    records::TableAxis axis = free_axis();
    axis.velocity = 0.25 * si::meters_per_second;
    Setting setting = make_setting(axis);
    // the reference case of the shared similitude.md, 8.4, to its five digits
    CHECK(only_range(setting, wood()).scales.largest == relative(0.32558, 1e-5));
    setting.design.gravity = 4.0;
    const double ratio = (0.25 / 0.424) * (0.25 / 0.424);
    CHECK(only_range(setting, wood()).scales.largest == relative(ratio / (kWoodFriction * 4.0), kRounding));
    CHECK(only_range(setting, wood(), "froude").scales.largest == relative(ratio / 4.0, kRounding));
}

TEST_CASE("a payload allows up to the cube root of m/(R M)") {
    records::TableAxis axis = free_axis();
    axis.payload = 500.0 * si::kilograms;
    const double largest = std::cbrt(500.0 / (800.0 / 2320.0 * 2.701509e8));
    CHECK(only_range(make_setting(axis), wood()).scales.largest == relative(largest, kRounding));
}

TEST_CASE("the limits of hall, workshop and camera end in closed form") {
    Setting setting = make_setting(free_axis());
    setting.design.limits.hall_height = 3.0 * si::meters;
    CHECK(only_range(setting, wood()).scales.largest == relative(3.0 / 161.5, kRounding));
    CHECK(only_range(setting, wood()).binds_above == "hall height");

    Material material = wood();
    material.smallest_edge = 0.008 * si::meters;
    CHECK(only_range(setting, material).scales.smallest == relative(0.008 / 1.36, kRounding));
    CHECK(only_range(setting, material).binds_below == "smallest edge");

    setting.design.limits.deviation_ratio = 0.004;
    CHECK(only_range(setting, wood()).scales.smallest == relative(0.155e-3 / (4.25 * 0.004), kRounding));

    setting.design.limits = {};
    setting.design.limits.overlap_ratio = 0.01;
    material = wood();
    material.modulus = 3.56e9 * si::pascals;
    const double sinking = 800.0 * 9.80665 * 161.5 * 4.25 / 3.56e9;
    CHECK(only_range(setting, material).scales.largest == relative(std::sqrt(0.01 * 0.155e-3 / sinking), kRounding));

    setting.design.limits = {};
    setting.design.limits.camera_rate = 480.0 / si::seconds;
    setting.design.limits.pictures = 1000.0;
    // λ_t √(l/(μ g)) = 1000/480 s at the end, λ_t = √(λ_l/U)
    const double time = 1000.0 / 480.0, smallest = kWoodFriction * time * time * 0.59 * 9.80665 / 161.5;
    CHECK(only_range(setting, wood()).scales.smallest == relative(smallest, kRounding));
    // λ_t = λ_l √R of Cauchy's law
    const double cauchy = time * std::sqrt(0.59 * 9.80665 / 161.5) / std::sqrt(800.0 / 2320.0);
    CHECK(only_range(setting, wood(), "cauchy").scales.smallest == relative(cauchy, kRounding));
}

TEST_CASE("payload and bandwidth of the reference case exclude each other, and the pair is named with what would help") {
    records::TableAxis axis = free_axis();
    axis.velocity = 0.25 * si::meters_per_second;
    axis.payload = 500.0 * si::kilograms;
    axis.highest_frequency = 50.0 / si::seconds;
    const Candidate candidate = find_candidate(make_setting(axis), wood(), by("mu"));
    CHECK_FALSE(candidate.is_feasible());
    REQUIRE(candidate.conflict.has_value());
    CHECK(candidate.conflict->upper == "payload of axis x");
    CHECK(candidate.conflict->lower == "highest frequency of axis x");
    CHECK(candidate.conflict->at_most == relative(0.0175087, 1e-5));   // as printed there
    CHECK(candidate.conflict->at_least == relative(0.0427119, 1e-5));  // likewise
    CHECK(candidate.problem.find("payload of axis x allows up to 1/57.11, highest frequency of axis x asks for at least 1/23.41: "
                                 "raise payload of axis x to ") == 0);
    CHECK(candidate.problem.find("or raise highest frequency of axis x to 78.09 Hz") != std::string::npos);  // 10 Hz·√(U·57.11)

    axis.highest_frequency = 100.0 / si::seconds;
    const FeasibleRange range = only_range(make_setting(axis), wood());
    CHECK(1.0 / range.scales.smallest == relative(93.65, 1e-4));
    CHECK(1.0 / range.scales.largest == relative(57.11, 1e-4));
}

// the reference case of the shared similitude.md, 8.4, to its four digits
TEST_CASE("a wood model at 1:107 needs a table of 106.9 Hz") {
    records::TableAxis axis = free_axis();
    axis.highest_frequency = 106.9 / si::seconds;
    CHECK(only_range(make_setting(axis), wood()).scales.smallest <= 1.0 / 107.0);
    axis.highest_frequency = 106.8 / si::seconds;
    CHECK(only_range(make_setting(axis), wood()).scales.smallest > 1.0 / 107.0);
}

TEST_CASE("what was said to help does help") {
    records::TableAxis axis = free_axis();
    axis.displacement = 0.2 / 60.0 * si::meters;
    Setting setting = make_setting(axis);
    Material material = wood();
    material.smallest_edge = 1.36 / 50.0 * si::meters;
    const Candidate candidate = find_candidate(setting, material, by("mu"));
    CHECK(candidate.problem ==
          "displacement of axis x allows up to 1/60, smallest edge asks for at least 1/50: raise displacement of axis x to 4 mm, or lower "
          "smallest edge to 22.67 mm");
    material.smallest_edge = 0.02266 * si::meters;
    CHECK(find_candidate(setting, material, by("mu")).is_feasible());
}

TEST_CASE("a limit that no length scale meets is named alone, and a law that does not admit the material says so") {
    records::TableAxis axis = free_axis();
    axis.acceleration = {{0.0 * si::kilograms, 0.5 * scaling::kStandardGravity}};
    Setting setting = make_setting(axis);
    setting.design.length = 1.0 / 25.0;
    CHECK(find_candidate(setting, concrete(), by("mu")).problem ==
          "acceleration of axis x allows no length scale from 1/1.638e+04 to 1; for 1/25 raise acceleration of axis x to 0.511 g");
    const Candidate refused = find_candidate(make_setting(free_axis()), wood(), by("exact"));
    CHECK_FALSE(refused.is_feasible());
    CHECK(refused.problem.find("exact") != std::string::npos);
}

TEST_CASE("limits that only all together exclude everything are not blamed on a pair") {
    const std::vector<LimitRanges> limits{{"a", {{0.1, 0.2}, {0.4, 0.5}}}, {"b", {{0.25, 0.45}}}, {"c", {{0.1, 0.3}}}};
    CHECK(find_common(limits).empty());
    CHECK_FALSE(find_conflict(limits).has_value());
}

TEST_CASE("the end of a range binds where it is met with a share of 1") {
    records::TableAxis axis = free_axis();
    axis.payload = 500.0 * si::kilograms;
    const Candidate candidate = find_candidate(make_setting(axis), wood(), by("mu"));
    REQUIRE(candidate.ends.size() == 2);
    CHECK(candidate.ends[1].uses.at(0).used() <= 1.0);
    CHECK(candidate.ends[1].uses.at(0).used() == relative(1.0, kRounding));
}

TEST_CASE("materials rank by their distortions, aluminium is out for its change of regime") {
    Setting setting = make_setting(free_axis());
    setting.design.materials = {aluminium(), wood(), concrete()};
    for (const double length : {1.0 / 25.0, 1.0 / 107.0}) {
        setting.design.length = length;
        setting.design.groups = {"mu^N", "a/(mu*g)", "omega/p", "mu/tan(alpha)", "c_res"};
        const std::vector<Candidate> ranking = find_candidates(setting);
        REQUIRE(ranking.size() == 3);
        CHECK(ranking[0].material.name == "concrete");
        CHECK(ranking[0].ranked->measure <= 1e-12);  // the same μ and e: rounding of five groups
        CHECK(ranking[1].material.name == "wood");
        // μ^N and a/(μ g) are kept; ω/p goes by √U, μ/tan α by U, e by 0.6
        CHECK(ranking[1].ranked->measure == relative(1.5 * std::log(kWoodFriction) - std::log(0.6), 1e-12));
        CHECK_FALSE(ranking[1].changes_regime());
        CHECK(ranking[2].material.name == "aluminium");
        CHECK(ranking[2].is_feasible());
        CHECK(ranking[2].changes_regime());
    }
    // uneven blocks weigh more the smaller they are: at 1:107 concrete's 0.5 mm cost more than wood's friction and restitution
    setting.design.groups = default_groups();
    setting.design.length = 1.0 / 107.0;
    CHECK(find_candidates(setting)[0].material.name == "wood");
    setting.design.length = 1.0 / 25.0;
    CHECK(find_candidates(setting)[0].material.name == "concrete");
}

TEST_CASE("candidates that distort alike keep the order of the design, whatever rounding says") {
    Setting setting = make_setting(free_axis());
    setting.design.materials = {wood()};
    // U above 1: 1.5 ln U in a/(g tan α) and ω/p by the mu law, in a/(μ g) and μ^N by Froude's
    for (const auto& laws : {std::vector{by("mu"), by("froude")}, std::vector{by("froude"), by("mu")}}) {
        setting.design.laws = laws;
        const std::vector<Candidate> ranking = find_candidates(setting);
        CHECK(ranking[0].ranked->measure == relative(ranking[1].ranked->measure, 1e-12));
        CHECK(ranking[0].law == laws[0]);
    }
}

TEST_CASE("a candidate is ranked at the feasible length nearest to the one in mind, without one at the largest") {
    Setting setting = make_setting(free_axis());
    setting.design.limits.hall_height = 1.615 * si::meters;
    CHECK(find_candidate(setting, wood(), by("mu")).ranked->length == relative(0.01, kRounding));
    setting.design.length = 1.0 / 25.0;
    CHECK(find_candidate(setting, wood(), by("mu")).ranked->length == relative(0.01, kRounding));
    setting.design.length = 1.0 / 107.0;
    CHECK(find_candidate(setting, wood(), by("mu")).ranked->length == 1.0 / 107.0);
}

TEST_CASE("a motion and limits scaled by powers of two leave the same length scales to the last bit") {
    records::TableAxis axis = free_axis();
    axis.displacement = 0.03 * si::meters;
    axis.velocity = 0.07 * si::meters_per_second;
    Setting setting = make_setting(axis);
    setting.design.limits.hall_height = 1.7 * si::meters;
    const FeasibleRange before = only_range(setting, wood());
    setting.loads[0].prototype.displacement *= 1024.0;
    setting.loads[0].axis.displacement = *axis.displacement * 1024.0;
    setting.loads[0].prototype.velocity *= 32.0;
    setting.loads[0].axis.velocity = *axis.velocity * 32.0;
    setting.design.prototype.height *= 1024.0;
    setting.design.limits.hall_height = *setting.design.limits.hall_height * 1024.0;
    CHECK(only_range(setting, wood()).scales == before.scales);
}

}  // namespace musim::records
