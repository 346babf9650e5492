#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "lsdem/motion/simulation.hpp"
#include "lsdem/time_step.hpp"
#include "tests/support/models.hpp"
#include "tests/support/motion.hpp"
#include "tests/support/relative.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

/// Motion of a column along one axis: vertical on its normal springs, or horizontal on its shear springs.
enum class Chain { normal, shear };

int axis_of(Chain chain) { return chain == Chain::normal ? 2 : 0; }

/// ω0 = sqrt(k/m) of the chain [1/s].
double chain_frequency(const Stone& stone, Chain chain) {
    return std::sqrt((chain == Chain::normal ? stone.normal_stiffness : stone.shear_stiffness) / stone.mass());
}

/// Elastic and without loss: no dashpot, no slip.
Stone lossless(Stone stone) {
    stone.restitution = 1.0;
    stone.friction = 1e6;
    return stone;
}

/// A column at rest for small motions along one axis. In shear gravity only keeps the joints closed: a thousandth of it makes the force
/// that drives the edges of two compressed faces apart, ½ K_n d² w, negligible against the springs.
Model make_chain(const Stone& stone, std::size_t count, Chain chain) {
    return make_resting_column(stone, count, true, chain == Chain::normal ? kGravity : 1e-3 * kGravity);
}

/// By how much later a wave reaches block `n` of a column, in units of 1/ω0: joints that bear d are softer by P d/A (`flat_stiffness`; on
/// the ground by half of that, left out).
double find_lateness(const Stone& stone, std::size_t count, std::size_t n, Chain chain) {
    if (chain == Chain::shear) return 0.0;
    const double around = 2.0 * (stone.size.x() + stone.size.y()),
                 joints = static_cast<double>(n * count) - 0.5 * static_cast<double>(n * (n - 1));
    return 0.5 * around / stone.face_area() * joints * stone.weight() / stone.normal_stiffness;
}

/// Circular frequency of mode `mode` (1 is the lowest) of a column, from its motion over some periods [1/s].
double measure_frequency(const Stone& given, std::size_t count, std::size_t mode, Chain chain, double step) {
    const Stone stone = lossless(given);
    Model model = make_chain(stone, count, chain);
    const double wave_number = static_cast<double>(2 * mode - 1) * kPi / static_cast<double>(2 * count + 1);
    const double omega = 2.0 * chain_frequency(stone, chain) * std::sin(0.5 * wave_number);
    // joints change by a fifth of the overlap of the top one at most: none opens
    const double speed = 0.2 * chain_frequency(stone, chain) * stone.weight() / stone.normal_stiffness;
    for (std::size_t i = 0; i < count; ++i)
        model.blocks[i].velocity[axis_of(chain)] = speed * std::sin(wave_number * static_cast<double>(i + 1));
    Simulation s(model, step);
    const auto probe = [&](const Simulation& now) { return now.velocity(count - 1)[axis_of(chain)]; };
    const double period = 2.0 * kPi / omega;
    const double first = find_crossing(s, period, probe);
    double last = first;
    for (int half = 0; half < 6; ++half) last = find_crossing(s, s.time() + period, probe);
    return 6.0 * kPi / (last - first);
}

/// Frequency by the leapfrog scheme: sin(ω' dt/2) = ω dt/2.
double leapfrog_frequency(double omega, double step) { return 2.0 / step * std::asin(0.5 * omega * step); }

}  // namespace

// [Brillouin53]: ω(q) = 2 ω0 |sin(qH/2)|.
TEST_CASE("the modes of a column follow the dispersion of a chain") {
    const std::size_t count = 12;
    for (const Chain chain : {Chain::normal, Chain::shear}) {
        for (const std::size_t mode : {1UL, 2UL, 5UL, 9UL, 12UL}) {
            CAPTURE(mode);
            const double step = 0.1 / chain_frequency(wood(), chain);
            const double measured = measure_frequency(wood(), count, mode, chain, step);
            const double wave_number = static_cast<double>(2 * mode - 1) * kPi / static_cast<double>(2 * count + 1);
            const double exact = 2.0 * chain_frequency(wood(), chain) * std::sin(0.5 * wave_number);
            // zero crossings of a sine are linear to (ω dt)³/48 of a step's phase, over 6 half periods: 1e-5; rounding is 1e-16 m in 1e-10
            // m
            CHECK(measured == relative(leapfrog_frequency(exact, step), 1e-5));
        }
    }
}

// [Brillouin53], fixed-free: ω_1 = 2 ω0 sin(π/(2(2n + 1))).
TEST_CASE("the lowest frequencies of a tower-high column are the published ones") {
    struct Case {
        Stone stone;
        Chain chain;
        double hertz;
    };
    const std::array<Case, 4> cases{{{wood(), Chain::normal, 344.45},
                                     {wood(), Chain::shear, 320.66},
                                     {concrete(), Chain::normal, 135.03},
                                     {concrete(), Chain::shear, 131.78}}};
    for (const Case& c : cases) {
        const double step = 0.2 / chain_frequency(c.stone, c.chain);
        const double measured = measure_frequency(c.stone, 38, 1, c.chain, step) / (2.0 * kPi);
        // five printed digits, from a mass of wood rounded up by 2e-5; the scheme's own shift, (ω dt)²/24 = 3e-6, is below them
        CHECK(measured == relative(c.hertz, 0.005 / c.hertz + 1e-5 + 5e-6));
    }
}

namespace {

/// Velocity histories of a column after a step V of the base velocity, over V; time in units of 1/ω0.
struct Front {
    double step = 0.0;                          ///< ω0·dt
    std::vector<std::vector<double>> velocity;  ///< [block][step]

    double at(std::size_t n, double time) const {
        const double place = time / step;
        const auto k = static_cast<std::size_t>(place);
        const double f = place - static_cast<double>(k);
        return (1.0 - f) * velocity[n - 1].at(k) + f * velocity[n - 1].at(k + 1);
    }
    double arrival(std::size_t n, double level) const {
        const std::vector<double>& v = velocity[n - 1];
        for (std::size_t k = 1; k < v.size(); ++k)
            if (v[k] >= level) return step * (static_cast<double>(k) - (v[k] - level) / (v[k] - v[k - 1]));
        return 0.0;
    }
    double peak(std::size_t n) const { return *std::max_element(velocity[n - 1].begin(), velocity[n - 1].end()); }
};

Front run_front(std::size_t count, Chain chain, double duration) {
    const Stone stone = lossless(wood());
    Model model = make_chain(stone, count, chain);
    const double omega0 = chain_frequency(stone, chain);
    // small enough for no joint to open: V/ω0 is a tenth of the least overlap
    const double speed = 0.1 * omega0 * stone.weight() / stone.normal_stiffness;
    model.ground.motion.shift[static_cast<std::size_t>(axis_of(chain))] = velocity_step(speed);
    Front front;
    front.step = 0.02;
    front.velocity.resize(count);
    Simulation s(model, front.step / omega0);
    for (std::size_t k = 0; front.step * static_cast<double>(k) < duration; ++k, s.advance())
        for (std::size_t i = 0; i < count; ++i) front.velocity[i].push_back(s.velocity(i)[axis_of(chain)] / speed);
    return front;
}

}  // namespace

// [Schroedinger14]: v_n(t)/V = 2n ∫ J_2n(u)/u du from 0 to 2ω0t, in a column too high for its top to matter.
TEST_CASE("a step of the base velocity travels up a column as Schroedinger's front") {
    constexpr std::array<std::size_t, 6> kBlocks{1, 5, 10, 20, 30, 37};
    constexpr std::array<double, 6> kAtArrival{0.4233, 0.3616, 0.3508, 0.3441, 0.3415, 0.3404};
    constexpr std::array<double, 6> kHalfTime{1.1075, 5.3070, 10.4092, 20.5316, 30.6156, 37.6632};
    for (const Chain chain : {Chain::normal, Chain::shear}) {
        const Front front = run_front(60, chain, 50.0);
        for (std::size_t i = 0; i < kBlocks.size(); ++i) {
            CAPTURE(kBlocks[i]);
            // printed to four decimals; the scheme runs ahead by (ω dt)²/24 = 7e-5 at the highest frequency, of up to 37 units of time
            CHECK(std::abs(front.at(kBlocks[i], static_cast<double>(kBlocks[i])) - kAtArrival[i]) < 5e-5 + 2e-4);
            CHECK(std::abs(front.arrival(kBlocks[i], 0.5) - kHalfTime[i] - find_lateness(wood(), 60, kBlocks[i], chain)) < 5e-5 + 2e-4);
        }
        const double speed = 25.0 / (front.arrival(30, 0.5) - front.arrival(5, 0.5));
        CHECK(std::abs(speed - 0.9878) < 5e-5 + 1e-5);
    }
}

TEST_CASE("the front overshoots and doubles at the free top of a column") {
    for (const Chain chain : {Chain::normal, Chain::shear}) {
        const Front front = run_front(38, chain, 44.0);
        // printed to four decimals; peaks are flat, so that a step next to them is off by (ω dt)²/8 = 2e-4 at most
        CHECK(std::abs(front.peak(38) - 2.4591) < 5e-5 + 2e-4);
        // 37.9628: the chain of 38 integrated by a fourth-order Runge-Kutta scheme, h = 0.02/ω0
        CHECK(std::abs(front.arrival(38, 0.5) - 37.9628 - find_lateness(wood(), 38, 38, chain)) < 5e-5 + 2e-4);
        const Front early = run_front(38, chain, 36.0);
        CHECK(std::abs(early.peak(10) - 1.2327) < 5e-5 + 2e-4);
        CHECK(std::abs(early.peak(30) - 1.2534) < 5e-5 + 2e-4);
    }
}

// Statics of a chain: the top sinks by (m g/k) n (n + 1)/2.
TEST_CASE("a column that is let go settles by the closed-form amount") {
    struct Case {
        Stone stone;
        double settlement, frequency;  ///< [m], the lowest [Hz]
    };
    for (Case c : {Case{wood(), 2.5831e-6, 344.45}, Case{concrete(), 16.807e-6, 135.03}}) {
        const std::size_t count = 38;
        c.stone.restitution = 0.15;
        Model model = make_model(c.stone);
        for (std::size_t i = 0; i < count; ++i)
            model.blocks.push_back(make_block(c.stone, {0.0, 0.0, (static_cast<double>(i) + 0.5) * c.stone.size.z()}));
        Simulation s(model, 0.8 * compute_critical_time_step(model));
        // ζ = 0.93: the lowest mode decays with ζ ω1/(ω0 sqrt 2) = 2.7 % of critical, by e^(-12) in 75 periods
        advance_to(s, 75.0 / c.frequency);
        const double sunk = model.blocks.back().position.z() - s.position(count - 1).z();
        // five printed digits
        CHECK(sunk == relative(c.settlement, 3e-5 + 1e-5));
    }
}
