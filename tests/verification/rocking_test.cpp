#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "lsdem/motion/simulation.hpp"
#include "lsdem/time_step.hpp"
#include "tests/support/elastic_rocking.hpp"
#include "tests/support/models.hpp"
#include "tests/support/motion.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/rocking.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

/// Wood that cannot slide under its rocking edge.
Stone rough_reference_wood() {
    Stone stone = reference_wood();
    stone.friction = 2.0;
    return stone;
}

struct QuarterPeriod {
    double amplitude, linearised, exact_thin, exact_wide;  ///< θ0/α, p T/4, exact over linearised
};
constexpr std::array<QuarterPeriod, 5> kQuarterPeriods{{{0.1, 0.467145, 1.006761, 1.024579},
                                                        {0.3, 0.895588, 1.004550, 1.016454},
                                                        {0.5, 1.316958, 1.002820, 1.010161},
                                                        {0.7, 1.873820, 1.001560, 1.005605},
                                                        {0.9, 2.993223, 1.000725, 1.002604}}};

double measure_quarter_period(const Stone& stone, double tilt) {
    const Model model = make_borne_tilted_block(stone, tilt);
    Simulation s(model, 0.5 * compute_critical_time_step(model));
    return find_crossing(s, 1.0, [](const Simulation& now) { return tilt_about_y(now); });
}

void check_quarter_period(const Stone& stone, const QuarterPeriod& expected, double exact_ratio) {
    const double tilt = expected.amplitude * RockingBlock(stone).slenderness();
    const double exact = expected.linearised * exact_ratio / RockingBlock(stone).frequency_parameter();
    const Stone firm_stone = stiffened(stone, 16.0);
    const double soft = measure_quarter_period(stone, tilt) / exact - 1.0, firm = measure_quarter_period(firm_stone, tilt) / exact - 1.0;
    const double soft_delay = ElasticRocking(stone).quarter_period_delay(tilt);
    const double firm_delay = ElasticRocking(firm_stone).quarter_period_delay(tilt);
    // the closed form of the elastic edge leaves out mostly that friction's spring gives; the table has six digits
    const double given = ElasticRocking(stone).friction_share();
    CHECK(std::abs(soft - soft_delay) < 2e-6 + given * soft_delay);
    CHECK(std::abs(firm - firm_delay) < 2e-6 + given * firm_delay);
    // the depth goes with the root of the stiffness; the next order is the square of the first
    CHECK(std::abs((4.0 * firm - soft) / 3.0) < 2e-6 + soft * soft);
}

}  // namespace

// [Housner63]: T/4 = acosh(1/(1 − θ0/α))/p, times the ratio of the exact pendulum to the linearised one.
TEST_CASE("a block tilted on its thin side falls to upright in the exact quarter period") {
    for (const QuarterPeriod& expected : kQuarterPeriods) check_quarter_period(rough_reference_wood(), expected, expected.exact_thin);
}

TEST_CASE("a block tilted on its wide side falls to upright in the exact quarter period") {
    for (const QuarterPeriod& expected : kQuarterPeriods)
        check_quarter_period(turned(rough_reference_wood()), expected, expected.exact_wide);
}

namespace {

struct Impact {
    double energy_ratio = 0.0;  ///< of the rocking energies, from the heights before and after
    double closure = 0.0;       ///< error of the energy balance over the energy before
};

/// Lets a block fall from half its slenderness, and follows it until its next highest tilt.
Impact measure_impact(Stone stone, double restitution, double fraction_of_limit) {
    stone.restitution = restitution;
    const RockingBlock rocking(stone);
    const double alpha = rocking.slenderness(), p = rocking.frequency_parameter();
    const Model model = make_tilted_block(stone, 0.5 * alpha);
    Simulation s(model, fraction_of_limit * compute_critical_time_step(model));
    const double start = s.energy().balance();
    find_crossing(s, 2.0 / p, [](const Simulation& now) { return tilt_about_y(now); });
    double farthest = 0.0;
    for (const double end = s.time() + 1.2 / p; s.time() < end; advance(s, 8)) farthest = std::min(farthest, tilt_about_y(s));

    const auto lift = [&](double theta) { return std::cos(alpha - theta) - std::cos(alpha); };
    const double before = stone.weight() * rocking.radius() * lift(0.5 * alpha);
    return {lift(-farthest) / lift(0.5 * alpha), (s.energy().balance() - start) / before};
}

/// Time steps against the frequency of a face contact, ω0·dt [-].
double contact_steps(const Stone& stone, double fraction_of_limit) {
    const Model model = make_resting_column(stone, 1);
    return fraction_of_limit * compute_critical_time_step(model) * std::sqrt(stone.normal_stiffness / stone.mass());
}

}  // namespace

// [Housner63]: r = (1 − 1.5 sin²α)² for an impact without bounce; a compliant contact does not have to reach it ([Harmon23, Appendix]).
TEST_CASE("an impact of a rocking block takes energy and books where it went" * doctest::test_suite("slow")) {
    struct Side {
        std::string name;
        Stone stone;
        double housner;
    };
    const std::array<Side, 2> sides{{{"thin", rough_reference_wood(), 0.740749}, {"wide", turned(rough_reference_wood()), 0.293190}}};
    for (const Side& side : sides) {
        for (const double restitution : {0.05, 0.3, 0.6, 0.9}) {
            CAPTURE(side.name);
            CAPTURE(restitution);
            const Impact impact = measure_impact(side.stone, restitution, 0.05);
            // an impact never gives energy, and an edge contact does not stop a block dead
            CHECK(impact.energy_ratio < 1.0);
            CHECK(impact.energy_ratio > 0.0);
            // a node that touches or leaves within a step is booked to ½ k_node (v dt)²: of 44 nodes, (ω0 dt)² of the energy
            const double steps = contact_steps(side.stone, 0.05);
            CHECK(std::abs(impact.closure) < steps * steps);
        }
    }
}

namespace {

/// Response of a block under a constant base acceleration.
struct Response {
    double slip = 0.0;  ///< of the leading bottom edge against the base, along x [m]
    double tilt = 0.0;  ///< [rad]
};

/// Time in which the acceleration comes up, far longer than the contacts ring, so that their overshoot does not start the motion [s].
constexpr double kRise = 2e-3;

/// Twofold time integral of max(0, a(t)/g − threshold) for an acceleration that rises linearly to A g, then holds [s²].
double integrate_excess(double acceleration_g, double threshold, double duration) {
    const double left = kRise * (1.0 - threshold / acceleration_g), after = duration - kRise;
    return (acceleration_g - threshold) * (left * left / 6.0 + 0.5 * left * after + 0.5 * after * after);
}

Response shake_from_rest(Stone stone, double friction, double acceleration_g, double duration) {
    stone.friction = friction;
    Model model = make_resting_column(stone, 1);
    const double a = acceleration_g * kGravity;
    model.ground.motion.shift[0] =
        sample_velocity(duration, 1200, [=](double t) { return t < kRise ? 0.5 * a * t * t / kRise : a * (t - 0.5 * kRise); });
    Simulation s(model, 0.5 * compute_critical_time_step(model));
    advance_to(s, duration);
    // the block leans back, against the motion of the base: on its edge at −x
    const Vector3 edge(-0.5 * stone.size.x(), 0.0, -0.5 * stone.size.z());
    const double now = (s.position(0) + s.orientation(0) * edge).x();
    return {now + 0.5 * stone.size.x() - s.base().displacement.x(), -tilt_about_y(s)};
}

}  // namespace

// [Shenton96, ShentonJones91]: which motion starts first at A g for a friction coefficient μ.
TEST_CASE("friction decides whether a shaken block slides or rocks or does both") {
    const Stone stone = reference_wood();
    const double duration = 14e-3;
    // slip g·∬(a/g − μ), from where the acceleration passes the threshold; tilt of a block on an elastic edge, whose arm grows as it lifts
    const auto base = [](double t) { return 0.511 * kGravity * std::min(1.0, t / kRise); };
    const double rocking_tilt =
        ElasticRocking(stone).shake(base, duration / 4000.0, duration, [&](double /*theta*/, double t) { return t >= duration; });
    const double sliding = kGravity * integrate_excess(0.511, 0.30, duration);

    const Response slides = shake_from_rest(stone, 0.30, 0.511, duration);
    const Response both = shake_from_rest(stone, 0.34, 0.511, duration);
    const Response rocks = shake_from_rest(stone, 0.40, 0.511, duration);
    // pure sliding: no tilt but that of springs near uplift. Until the block has leaned onto its edge, about 1/ω of its pitching,
    // friction lags: a velocity of μ g/ω, ω² = k_θ/I with k_θ = k_n b²/12 and I = m (b² + H²)/3
    const auto lag = [&](const Stone& s, double friction) {
        const double b = s.size.x(), h = s.size.z();
        return friction * kGravity * duration * std::sqrt(4.0 * s.mass() * (b * b + h * h) / (s.normal_stiffness * b * b));
    };
    CHECK(std::abs(-slides.slip - sliding) < lag(stone, 0.30));
    CHECK(std::abs(slides.tilt) < 1e-2 * rocking_tilt);
    // both at once: each well above the noise of the other regimes
    CHECK(-both.slip > 0.05 * sliding);
    CHECK(both.tilt > 0.05 * rocking_tilt);
    // pure rocking: the edge holds to its elastic offset, μ m g/k_edge; the tilt exceeds the estimate as the lever arms change with it
    CHECK(std::abs(rocks.slip) < 1e-3 * sliding);
    CHECK(rocks.tilt / rocking_tilt == relative(1.0, 0.05));

    // wide side, μ = 0.63 below 1/γ = 0.6635: it can only slide from rest
    const Response wide = shake_from_rest(turned(stone), 0.63, 0.8, duration);
    CHECK(std::abs(-wide.slip - kGravity * integrate_excess(0.8, 0.63, duration)) < lag(turned(stone), 0.63));
    CHECK(-wide.slip > 0.0);
    CHECK(std::abs(wide.tilt) < 1e-4);
    const Response rests = shake_from_rest(turned(stone), 0.63, 0.60, duration);
    CHECK(std::abs(rests.slip) < 1e-3 * sliding);
    CHECK(std::abs(rests.tilt) < 1e-4);
}
