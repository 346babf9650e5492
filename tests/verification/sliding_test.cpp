#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "lsdem/motion/simulation.hpp"
#include "lsdem/time_step.hpp"
#include "tests/support/faces.hpp"
#include "tests/support/models.hpp"
#include "tests/support/motion.hpp"
#include "tests/support/relative.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

/// A block on its largest face has 3.1 times the stiffness the limit of an upright stack counts on, without a neighbor above it.
double lying_time_step(const Model& model) { return 0.25 * compute_critical_time_step(model); }

double lying_shear_stiffness(const Stone& stone) { return stone.shear_stiffness / stone.face_area() * stone.size.y() * stone.size.z(); }

/// Displacement against the base along x since the start [m].
double relative_x(const Simulation& s) { return s.position(0).x() - s.model().blocks[0].position.x() - s.base().displacement.x(); }

}  // namespace

// Elementary statics: a block sticks for tan θ < μ.
TEST_CASE("a block on an incline below the friction angle stays where it is") {
    const Stone stone = reference_wood();
    Model model = make_lying_block(stone);
    const double angle = 32.0 * kPi / 180.0;
    model.gravity = tilted_gravity(angle);
    Simulation s(model, lying_time_step(model));
    advance_to(s, 0.1);

    // load that comes on suddenly carries the spring twice its static offset m g sin θ/k_s; where the Coulomb limit cuts that short, the
    // block slips until the surplus is spent: δ ≤ offset·sin θ/(2(μ cos θ − sin θ)), and pitching of the block adds its height over its
    // length times as much
    const double offset = stone.weight() * std::sin(angle) / lying_shear_stiffness(stone);
    const double surplus = 0.5 * std::sin(angle) / (stone.friction * std::cos(angle) - std::sin(angle));
    const double bound = offset * (2.0 + surplus) * (1.0 + stone.size.x() / stone.size.z());
    CHECK(relative_x(s) > 0.0);
    CHECK(relative_x(s) < bound);

    // from then on it rings in place
    const double before = relative_x(s);
    advance_to(s, 0.4);
    CHECK(std::abs(relative_x(s) - before) < 2.0 * offset * (1.0 + stone.size.x() / stone.size.z()));
}

// Elementary statics: two springs in series, δ = F/K_s + F (h/2)²/(K_n l²/12): shear of the face, and pitching on it under the force's
// moment F h/2, l the length of the face downhill, h the height. Load that comes on suddenly swings between nothing and twice that, which
// friction bears as long as 2 tan θ < μ.
TEST_CASE("a block on a gentle incline swings about the offset of its springs, to twice as far") {
    const Stone stone = reference_wood();
    Model model = make_lying_block(stone);
    const double angle = 15.0 * kPi / 180.0;
    model.gravity = tilted_gravity(angle);
    Simulation s(model, lying_time_step(model));
    const double force = stone.weight() * std::sin(angle), height = stone.size.x(), length = stone.size.z();
    const double normal_stiffness = lying_shear_stiffness(stone) * stone.normal_stiffness / stone.shear_stiffness;
    const double offset =
        force / lying_shear_stiffness(stone) + force * 0.25 * height * height / (normal_stiffness * length * length / 12.0);
    double sum = 0.0, farthest = 0.0;
    int samples = 0;
    while (s.time() < 0.05) {
        advance(s, 4);
        sum += relative_x(s);
        farthest = std::max(farthest, relative_x(s));
        ++samples;
    }
    // the mean of some hundred swings, one of which may be cut off
    CHECK(sum / samples == relative(offset, 0.02));
    // shear and pitching swing with periods of their own, whose peaks rarely meet
    CHECK(farthest > 1.5 * offset);
    CHECK(farthest < 2.01 * offset);
    CHECK(s.energy().friction_loss < 1e-9 * force * offset);
}

// Elementary dynamics: a = g (sin θ − μ cos θ).
TEST_CASE("a block on a steep incline slides with g times sine less friction") {
    struct Case {
        double degrees, acceleration;
    };
    for (const Case c : {Case{33.0, 0.159673}, Case{40.0, 1.571362}}) {
        CAPTURE(c.degrees);
        const Stone stone = reference_wood();
        Model model = make_lying_block(stone);
        model.gravity = tilted_gravity(c.degrees * kPi / 180.0);
        Simulation s(model, lying_time_step(model));

        // the first instants load the springs; then the velocity grows evenly
        advance_to(s, 0.05);
        const double v0 = s.velocity(0).x(), t0 = s.time();
        advance_to(s, 0.25);
        const double measured = (s.velocity(0).x() - v0) / (s.time() - t0);

        // the printed number is rounded to 5e-7; what is left of the vertical ringing after 50 ms changes friction by less than 1e-6
        CHECK(std::abs(measured - c.acceleration) < 5e-7 + 1e-6 * kGravity);
    }
}

// Elementary dynamics: distance v0²/(2μg), time v0/(μg).
TEST_CASE("a sliding block stops after the Coulomb distance") {
    const Stone stone = reference_wood();
    Model model = make_lying_block(stone);
    model.blocks[0].velocity.x() = 0.5;
    Simulation s(model, lying_time_step(model));
    const double stopped = find_crossing(s, 0.2, [](const Simulation& now) { return now.velocity(0).x(); });

    // friction acts fully after a slip of μN/k_s, which the block crosses in less than one step at 0.5 m/s: one step's error in time
    CHECK(std::abs(stopped - 80.9022e-3) < 5e-8 + 1.0 * s.time_step());
    CHECK(std::abs(relative_x(s) - 20.2256e-3) < 5e-8 + 0.5 * s.time_step());
}

// [Newmark65]: slip d = (A T²/2)(A/(μg) − 1), ends at A T/(μg).
TEST_CASE("a rectangular base pulse moves a block by the slip of Newmark") {
    struct Case {
        double amplitude_g, duration, slip, end;
    };
    for (const Case c :
         {Case{1.0, 0.05, 7.201786e-3, 79.3651e-3}, Case{0.9, 0.10, 18.919286e-3, 142.8571e-3}, Case{2.0, 0.02, 8.533143e-3, 63.4921e-3}}) {
        CAPTURE(c.amplitude_g);
        const double amplitude = c.amplitude_g * kGravity;
        Model model = make_lying_block(reference_wood());
        model.ground.motion.shift[0] = constant_acceleration(amplitude, c.duration);
        Simulation s(model, lying_time_step(model));
        advance(s, 100);
        const double end = find_crossing(s, 0.3, [](const Simulation& now) { return now.velocity(0).x() - now.base().velocity.x(); });
        advance_to(s, c.end + 0.02);

        // the sudden start rings in shear until the springs slip: friction comes late by a quarter of that period, worth A·T of slip per
        // second of delay
        const double delay = 0.5 * std::acos(-1.0) * std::sqrt(reference_wood().mass() / reference_wood().shear_stiffness);
        CHECK(std::abs(-relative_x(s) - c.slip) < 5e-10 + amplitude * c.duration * delay);
        CHECK(std::abs(-relative_x(s) - c.slip) < 1e-3 * c.slip);
        CHECK(std::abs(end - c.end) < 5e-8 + amplitude / (0.63 * kGravity) * delay);
    }
}

// [Newmark65], half-sine: slip from t1 = asin(μg/A)/ω on.
TEST_CASE("a half-sine base pulse moves a block by the closed-form slip") {
    struct Case {
        double amplitude_g, duration, slip, end;
    };
    for (const Case c : {Case{1.0, 0.05, 1.677192e-3, 55.72883e-3}, Case{1.5, 0.10, 30.468528e-3, 158.36456e-3}}) {
        CAPTURE(c.amplitude_g);
        const double amplitude = c.amplitude_g * kGravity;
        Model model = make_lying_block(reference_wood());
        model.ground.motion.shift[0] = half_sine(amplitude, c.duration);
        Simulation s(model, lying_time_step(model));
        advance_to(s, 0.5 * c.duration);
        const double end = find_crossing(s, 0.3, [](const Simulation& now) { return now.velocity(0).x() - now.base().velocity.x(); });
        advance_to(s, c.end + 0.02);

        // slip begins where the springs are loaded: within a few steps of t1 and of the end, while the relative velocity is near zero;
        // the rest is the elastic offset, twice 2 μN/k_s
        const double step = s.time_step();
        const Stone stone = reference_wood();
        const double elastic = 4.0 * stone.friction * stone.weight() / lying_shear_stiffness(stone);
        CHECK(std::abs(-relative_x(s) - c.slip) < 5e-10 + elastic + 2e-4 * c.slip);
        CHECK(std::abs(end - c.end) < 5e-9 + 10.0 * step);
    }
}

// [DenHartog31, WestermoUdwadia83]: steady sliding under a = A sin ωt; D = (2A/ω²) sqrt(1 − (πη/2)²) without stops.
TEST_CASE("harmonic base motion slides a block by the peak-to-peak slip of the steady state" * doctest::test_suite("slow")) {
    struct Case {
        double friction, amplitude_g, frequency, slip;
    };
    for (const Case c : {Case{0.30, 1.0, 5.0, 17.53358e-3}, Case{0.63, 1.0, 5.0, 6.653241e-3}, Case{0.63, 1.0, 1.0, 166.3310e-3},
                         Case{0.18, 0.33, 5.0, 3.388111e-3}}) {
        CAPTURE(c.friction);
        CAPTURE(c.frequency);
        Stone stone = reference_wood();
        stone.friction = c.friction;
        Model model = make_lying_block(stone);
        const double omega = 2.0 * kPi * c.frequency, amplitude = c.amplitude_g * kGravity, period = 1.0 / c.frequency;
        const int cycles = c.friction == 0.30 ? 12 : 2;
        // 1000 samples a cycle: chords of the velocity are short by (ω dt)²/12 = 3e-6
        model.ground.motion.shift[0] = sample_velocity(cycles * period, static_cast<std::size_t>(cycles) * 1000,
                                                       [=](double t) { return -amplitude / omega * std::cos(omega * t); });
        Simulation s(model, lying_time_step(model));
        advance_to(s, (cycles - 1) * period);
        const double loss_before = s.energy().friction_loss;
        double low = relative_x(s), high = low;
        while (s.time() < cycles * period) {
            advance(s, 16);
            low = std::min(low, relative_x(s));
            high = std::max(high, relative_x(s));
        }
        const double slip = high - low, loss = s.energy().friction_loss - loss_before;
        const double expected_loss = 2.0 * c.friction * stone.weight() * c.slip;

        // the slip is second order in the errors of its turning points; 2e-4 covers the chords and one step of delay at each turn,
        // ω dt = 3e-4 at most
        CHECK(slip == relative(c.slip, 2e-4));
        CHECK(loss == relative(expected_loss, 5e-4));
    }
}

// Torque of uniform friction on a spinning face: μ m g r̄, r̄ the mean distance from its middle, 7.749613 mm for the wood block, which from
// 10 rad/s stops in 14.8962 ms after 4.26746°. The time goes with the rate and the angle with its square; from 2 rad/s the block stops
// before the flutter of an upright block that slides on all of its face (see docs/theory/surface_nodes.md) has grown from rounding.
TEST_CASE("a block that spins on the ground stops after the closed-form time and angle") {
    const Stone stone = reference_wood();
    CHECK(mean_distance(stone.size.x(), stone.size.y()) == relative(7.749613e-3, 1e-7));
    for (const double twist : {0.0, 0.3, 0.25 * kPi, 1.2}) {
        CAPTURE(twist);
        Model model = make_resting_column(stone, 1);
        model.blocks[0].orientation = Quaternion(Eigen::AngleAxisd(twist, Vector3::UnitZ()));
        constexpr double kRate = 2.0, kTime = 14.8962e-3 * kRate / 10.0, kAngle = 4.26746 * (kRate / 10.0) * (kRate / 10.0);
        model.blocks[0].angular_velocity.z() = kRate;
        Simulation s(model, 0.1 * compute_critical_time_step(model));
        const double stopped = find_crossing(s, 0.1, [](const Simulation& now) { return now.angular_velocity(0).z(); });
        const Quaternion q = s.orientation(0);
        const double angle = (2.0 * std::atan2(q.z(), q.w()) - twist) * 180.0 / kPi;
        // Friction acts in full after a turn of μ m g r̄/(k_s J/A): with α of the stop, and I/m = J/A, of α m/k_s, which takes so long at
        // the rate of the start; a step beside. The angle goes with the square of the time.
        const double loading = kRate / kTime * stone.mass() / stone.shear_stiffness / kRate;
        const double times = (loading + s.time_step()) / kTime;
        CHECK(stopped == relative(kTime, times));
        CHECK(angle == relative(kAngle, 2.0 * times));
    }
}
