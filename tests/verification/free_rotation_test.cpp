#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "lsdem/motion/simulation.hpp"
#include "tests/support/models.hpp"
#include "tests/support/motion.hpp"
#include "tests/support/relative.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

/// One start of a free rotation; rates about the axes of the least, middle and largest moment, which are z, y, x of the block.
struct FreeRotation {
    std::array<double, 3> rate;  ///< [rad/s]
    double twice_energy;         ///< 2T [J]
    double momentum_squared;     ///< |L|² [J²·s²]
    double period;               ///< of the rates [s]
};
constexpr std::array<FreeRotation, 3> kFreeRotations{{{{0.1, 5.0, 0.1}, 41.513389, 68.889040, 8.808919},
                                                      {{1.0, 2.0, 3.0}, 26.965375, 53.979315, 2.851165},
                                                      {{3.0, 1.0, 0.5}, 9.552819, 9.933322, 3.688922}}};

/// The prototype block with unit mass, alone in space.
Model make_free_block(const FreeRotation& start) {
    Model model = make_model(reference_wood(1.0));
    model.gravity.setZero();
    model.ground.present = false;
    Block block = make_block(reference_wood(1.0), Vector3::Zero());
    block.mass = 1.0;
    block.angular_velocity = {start.rate[2], start.rate[1], start.rate[0]};
    model.blocks.push_back(block);
    return model;
}

Vector3 body_rate(const Simulation& s) { return s.orientation(0).conjugate() * s.angular_velocity(0); }

Vector3 momentum(const Simulation& s) { return s.orientation(0) * s.model().shapes[0].inertia_over_mass.cwiseProduct(body_rate(s)); }

double twice_energy(const Simulation& s) { return body_rate(s).dot(s.model().shapes[0].inertia_over_mass.cwiseProduct(body_rate(s))); }

/// Time between every second zero of the middle rate [s].
double measure_period(const FreeRotation& start, double step) {
    Simulation s(make_free_block(start), step);
    const auto middle = [](const Simulation& now) { return body_rate(now).y(); };
    const double first = find_crossing(s, 3.0 * start.period, middle);
    find_crossing(s, s.time() + start.period, middle);
    return find_crossing(s, s.time() + start.period, middle) - first;
}

}  // namespace

// [LandauLifshitz], § 37.
TEST_CASE("a free block keeps its angular momentum exactly and its energy within bounds") {
    for (const FreeRotation& start : kFreeRotations) {
        const double step = start.period / 1000.0;
        Simulation s(make_free_block(start), step);
        const Vector3 momentum_start = momentum(s);
        CHECK(momentum_start.squaredNorm() == relative(start.momentum_squared, 1e-7));
        CHECK(twice_energy(s) == relative(start.twice_energy, 1e-7));
        double early = 0.0, late = 0.0, drift = 0.0;
        for (int n = 0; n < 50000; ++n) {
            s.advance();
            const double error = std::abs(twice_energy(s) / start.twice_energy - 1.0);
            (n < 10000 ? early : late) = std::max(n < 10000 ? early : late, error);
            drift = std::max(drift, (momentum(s) - momentum_start).norm() / momentum_start.norm());
        }
        // the momentum is a stored number that nothing touches: the quaternion's rounding is all
        CHECK(drift < 1e-14);
        // (ω dt)² of a turn in each step
        const double turn = step * std::sqrt(start.twice_energy / 0.8168333);
        CHECK(early < turn * turn);
        // 50 periods: bounded, no drift
        CHECK(late < 1.05 * early + 1e-7);
    }
}

TEST_CASE("the rates of a free block have the period of the elliptic functions to second order") {
    for (const FreeRotation& start : kFreeRotations) {
        const double coarse = measure_period(start, start.period / 250.0), fine = measure_period(start, start.period / 1000.0);
        // (ω dt)², and a quarter of the step makes a sixteenth of it; near the separatrix the period has a logarithm of it beside
        const double turn = start.period / 1000.0 * std::sqrt(start.twice_energy / 0.8168333);
        CHECK(std::abs(fine / start.period - 1.0) < turn * turn);
        CHECK((coarse - start.period) / (fine - start.period) == relative(16.0, 0.15));
    }
}
