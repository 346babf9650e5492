#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "lsdem/calibration/calibration_files.hpp"
#include "lsdem/calibration/rocking_impact.hpp"
#include "lsdem/calibration/tilt_test.hpp"
#include "lsdem/calibration/wave_speed.hpp"

using namespace musim::lsdem;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

BlockSample preset(const char* name) { return make_sample(find_material_preset(name)); }

}  // namespace

// [Schroedinger14]: the arrivals ω0·t of half the velocity at the blocks 5 and 30 are 5.3070 and 30.6156.
TEST_CASE("the ideal chain shows the bias of both criteria") {
    // a line through all arrivals from 5 to 30, not through the two ends, which give 0.9878 and 1.0077: the arrivals n + 0.2 n^(1/3) bend,
    // so that the fit lies up to 1e-3 away
    CHECK(compute_front_factor({}) == doctest::Approx(0.9878).epsilon(1e-3));
    CHECK(compute_front_factor({.criterion = ArrivalCriterion::displacement}) == doctest::Approx(1.0077).epsilon(1e-3));
    CHECK_THROWS_AS(compute_front_factor({.layers = 10}), std::invalid_argument);
}

TEST_CASE("columns of the printed stiffness carry the wave speeds of wood and concrete, and not that of aluminium") {
    struct Case {
        const char* name;
        double normal, shear;
    };
    // oracles of the printed heights; the presets' blocks are 4.25 m over the scale, up to 0.15 % lower: c ∝ √H
    for (const Case& c : {Case{"wood", 2110.3, 1964.6}, Case{"concrete", 3546.5, 3461.0}, Case{"al_printed", 1514.8, 1469.6}}) {
        CAPTURE(std::string(c.name));
        const BlockSample sample = preset(c.name);
        for (const WaveKind kind : {WaveKind::normal, WaveKind::shear}) {
            const WaveSpeed speed = measure_wave_speed(sample, kind, {});
            CHECK(speed.effective() == doctest::Approx(kind == WaveKind::normal ? c.normal : c.shear).epsilon(2e-3));
            // joints closed by D are softer by P D/S at most, where depths end at their sides in a rim of width D: D is what the whole
            // column presses together, 38 weights, and of a normal wave its own V/ω0, V being 0.8 heights a second
            const double weights = 38.0 * sample.mass() * sample.gravity / sample.normal_stiffness;
            const double wave = kind == WaveKind::normal ? 0.8 * sample.size.z() / std::sqrt(sample.normal_stiffness / sample.mass()) : 0.0;
            const double slower = (weights + wave) * (1.0 / sample.size.x() + 1.0 / sample.size.y());
            const double over = speed.effective() / closed_form_speed(sample, kind) - 1.0;
            CAPTURE(slower);
            // the step (ω0·dt)²/24 = 2e-5, and the factor's 4e-6
            CHECK(over < 5e-5);
            CHECK(over > -slower - 5e-5);
            CHECK(slower < 4e-4);
        }
    }
    CHECK(closed_form_speed(preset("al_printed"), WaveKind::normal) < 0.3 * std::sqrt(69e9 / 2632.0));
    CHECK(closed_form_speed(preset("aluminium"), WaveKind::normal) > 0.93 * std::sqrt(69e9 / 2632.0));
}

TEST_CASE("the stiffness that is found for a speed gives that speed back") {
    BlockSample sample = preset("wood");
    const StiffnessSearch found = find_stiffness(sample, WaveKind::normal, 3000.0, {});
    // the effective speed is H·√(k/m) to 5e-5, see above
    CHECK(found.stiffness == doctest::Approx(found.closed_form).epsilon(1e-4));
    sample.normal_stiffness = found.stiffness;
    CHECK(measure_wave_speed(sample, WaveKind::normal, {}).effective() == doctest::Approx(3000.0).epsilon(1e-6));

    // the criterion's own speed lies 1.15 % lower, so that it needs 2.3 % more stiffness
    const StiffnessSearch raw = find_stiffness(preset("wood"), WaveKind::normal, 3000.0, {}, true);
    const double factor = compute_front_factor({});
    CHECK(raw.stiffness * factor * factor == doctest::Approx(raw.closed_form).epsilon(1e-4));
    CHECK_THROWS_AS(find_stiffness(preset("wood"), WaveKind::shear, -1.0, {}), std::invalid_argument);
}

TEST_CASE("the restitution of a contact slows the half-velocity front of the damped test") {
    const BlockSample sample = preset("wood");
    const WaveSpeed damped = measure_wave_speed(sample, WaveKind::normal, {.damped = true});
    CHECK(damped.speed > 0.9 * closed_form_speed(sample, WaveKind::normal));
    CHECK(damped.speed != measure_wave_speed(sample, WaveKind::normal, {}).speed);
}

TEST_CASE("the wave table has one column per layer") {
    const WaveHistory history = run_wave_test(preset("wood"), WaveKind::normal, {.layers = 20});
    const std::string csv = make_wave_csv(history);
    CHECK(csv.starts_with("time_s,base_m,layer1_m,"));
    CHECK(csv.substr(0, csv.find('\n')).ends_with("layer20_m"));
}

TEST_CASE("a lying block slips at the angle of friction, whatever it lies on and whichever way is down") {
    const BlockSample sample = preset("wood");
    const double resolution = 0.02 * kDegree;
    for (const TiltSupport support : {TiltSupport::ground, TiltSupport::block}) {
        const TiltResult r = run_tilt_test(sample, {support, TiltPose::lying, TiltSide::wide}, resolution);
        CHECK(r.event == TiltEvent::slips);
        // the interval is half as wide at least; a block within it may not have shown yet
        CHECK(std::abs(r.angle() - std::atan(0.63)) < 2.0 * resolution);
        CHECK(r.friction() == doctest::Approx(0.63).epsilon(2e-3));
    }
    BlockSample smooth = sample;
    smooth.ground_friction = 0.2;
    const TiltResult r = run_tilt_test(smooth, {TiltSupport::ground, TiltPose::lying, TiltSide::other}, resolution);
    CHECK(std::abs(r.angle() - std::atan(0.2)) < 2.0 * resolution);
    CHECK_THROWS_AS(run_tilt_test(sample, {}, 0.0), std::invalid_argument);
}

// [Housner63]
TEST_CASE("Housner's energy ratios of the block are the published ones") {
    CHECK(housner_ratio(preset("wood"), RockingSide::thin) == doctest::Approx(0.740749).epsilon(1e-6));
    CHECK(housner_ratio(preset("concrete"), RockingSide::wide) == doctest::Approx(0.293190).epsilon(1e-6));
    CHECK(find_published_ratio(22.0 * kDegree) == 0.6);
    CHECK_FALSE(find_published_ratio(15.0 * kDegree).has_value());
}

TEST_SUITE_BEGIN("slow");

// Tilt table: topples on the springs of its base, 0.28° below atan(b/H), or slips at atan μ, whichever comes first.
TEST_CASE("an upright block topples over its thin side and slips along its wide one") {
    const BlockSample sample = preset("wood");
    const double resolution = 0.01 * kDegree;
    for (const TiltSupport support : {TiltSupport::ground, TiltSupport::block}) {
        const TiltResult thin = run_tilt_test(sample, {support, TiltPose::upright, TiltSide::other}, resolution);
        CHECK(thin.event == TiltEvent::topples);
        // the bed's closed form leaves out terms a/b times what it takes off
        const double lost = thin.expected_fall - thin.expected_fall_on_springs;
        CHECK(lost > 0.25 * kDegree);
        CHECK(std::abs(thin.angle() - thin.expected_fall_on_springs) < 0.05 * lost + resolution);
        const TiltResult wide = run_tilt_test(sample, {support, TiltPose::upright, TiltSide::wide}, resolution);
        CHECK(wide.event == TiltEvent::slips);
        CHECK(std::abs(wide.angle() - wide.expected_slip) < 2.0 * resolution);
    }
}

// docs/validation/verification.md: r on the ground for e = 0.05, 0.3, 0.6, 0.9 with a twentieth of the critical step, from half the
// slenderness.
TEST_CASE("the energy kept at an impact is the one measured before") {
    struct Case {
        RockingSide side;
        double restitution, ratio;
    };
    BlockSample sample = preset("wood");
    sample.friction = sample.ground_friction = 2.0;
    for (const Case& c : {Case{RockingSide::thin, 0.05, 0.852}, Case{RockingSide::thin, 0.9, 0.941}, Case{RockingSide::wide, 0.3, 0.593},
                          Case{RockingSide::wide, 0.9, 0.835}}) {
        const RockingResult r =
            run_rocking_test(sample, {RockingSupport::ground, c.side, 0.5 * slenderness(sample, c.side), c.restitution, 0.05});
        CAPTURE(c.ratio);
        // three digits are printed; turning points between steps cost less
        CHECK(std::abs(r.first - c.ratio) < 2e-3);
    }
}

TEST_SUITE_END();

TEST_CASE("more restitution keeps more energy at an impact and a reachable ratio is found" * doctest::test_suite("slow")) {
    const BlockSample sample = preset("wood");
    RockingSweep sweep{
        .restitutions = {0.2, 0.8}, .angles = {8.0 * kDegree, 40.0 * kDegree}, .supports = {RockingSupport::two_blocks}, .safety = 0.8};
    sweep.threads = 1;
    const auto curves = sweep_rocking(sample, sweep);
    // 40° is beyond both sides' slenderness
    REQUIRE(curves.size() == 2);
    CHECK(curves[0].result[1].mean > curves[0].result[0].mean);
    CHECK(curves[0].result[0].mean > 0.0);
    CHECK(curves[0].result[1].mean < 1.0);

    const double target = 0.5 * (curves[0].result[0].mean + curves[0].result[1].mean);
    const RestitutionSearch found = find_restitution(sample, curves[0], target, sweep.safety);
    REQUIRE(found.restitution.has_value());
    CHECK(*found.restitution > 0.2);
    CHECK(*found.restitution < 0.8);
    CHECK(std::abs(found.reached - target) < 5e-3);
    CHECK_FALSE(find_restitution(sample, curves[0], 0.1, sweep.safety).restitution.has_value());
    CHECK_THROWS_AS(run_rocking_test(sample, {.start = 40.0 * kDegree}), std::invalid_argument);
}
