#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>

#include "tests/benches/accuracy_cases.hpp"
#include "tests/benches/accuracy_plot.hpp"
#include "tests/benches/accuracy_sweep.hpp"
#include "tests/benches/accuracy_tower.hpp"
#include "tests/support/relative.hpp"

using namespace musim::lsdem;
using musim::lsdem::tests::relative;

namespace {

AccuracyOutcome run(const std::string& name, const AccuracySetting& setting) {
    for (const AccuracyCase& problem : make_closed_form_cases())
        if (problem.name == name) return problem.run(setting);
    FAIL("no case ", name);
    return {};
}

/// log2 of the ratio of the errors at two time steps, the second half of the first.
double observe_order(const std::string& name, double safety) {
    const double coarse = run(name, {.safety = safety}).error, fine = run(name, {.safety = 0.5 * safety}).error;
    return std::log2(coarse / fine);
}

/// The papers' wood block at 1:107: thin side and height [m].
constexpr double kThin = 1.36 / 107.0, kHigh = 4.25 / 107.0;

}  // namespace

// [Housner63], [Schroedinger14], [Newmark65]: printed values.
TEST_CASE("the closed forms give the published numbers") {
    // θ0/α = 0.5, thin side: p T/4 = 1.316958·1.002820, six digits each
    const double alpha = std::atan2(kThin, kHigh);
    CHECK(compute_quarter_period(alpha, 1.0, 0.5 * alpha) == relative(1.316958 * 1.002820, 1e-6));
    // v_n/V at n/ω0, four digits
    CHECK(std::abs(compute_front(1, 1.0) - 0.4233) < 5e-5);
    CHECK(std::abs(compute_front(10, 10.0) - 0.3508) < 5e-5);
    CHECK(std::abs(compute_front(30, 30.0) - 0.3415) < 5e-5);
    // rigid springs: 7.201786 mm for 1 g, 50 ms, μ = 0.63; the delay of the springs, of order 1/ω, changes it by 1e-7
    CHECK(compute_pulse_slip(9.81, 0.05, 0.63 * 9.81, 1e9) == relative(7.201786e-3, 1e-6));
}

TEST_CASE("smooth stuck motion converges with the square of the time step") {
    // at a fifth of the limit the fourth-order term is (ω dt)² = 4 % of the second-order one
    CHECK(observe_order("wave", 0.2) == relative(2.0, 0.05));
}

TEST_CASE("an impact converges with the time step, as its dashpot lags by half of one") {
    // the second-order term is at most ω dt of the first-order one: ω dt < 0.1 at a tenth of the limit
    CHECK(observe_order("bounce", 0.1) == relative(1.0, 0.1));
}

TEST_CASE("the slip of a sliding block is off by the step in which the friction spring gives way") {
    // the acceleration turns within a step from its slope Aω sin φ, 1 − cos φ = μ, to zero: an impulse of slope·dt²/8 at most, which acts
    // on the slip for the rest of the pulse and, as a longer stop, v/(μg) times as long again
    constexpr double kAcceleration = 9.81, kDuration = 0.05, kFriction = 0.63;
    const double area_ratio = kHigh / kThin, mass = 800.0 * kThin * kHigh * 2.82 / 107.0;
    const double omega = std::sqrt(26e6 * area_ratio / mass), slope = kAcceleration * omega * std::sin(std::acos(1.0 - kFriction));
    for (const double safety : {0.8, 0.4, 0.2}) {
        const AccuracyOutcome outcome = run("slide", {.safety = safety});
        const double end = 1.1 * kDuration / kFriction, step = end / static_cast<double>(outcome.steps);
        const double bound = slope * step * step / 8.0 * (kDuration / kFriction) / 7.201786e-3;
        CAPTURE(safety);
        CHECK(outcome.error < bound);
        // the bound says something
        CHECK(bound < 2e-5);
    }
}

TEST_CASE("boxes that overlap lean and settle as on the continuous face, but for the rims where depths end at their sides") {
    // points of a face nearer to a side of the other body than to its face are less deep: a rim of width D that bears half of its load. Of
    // flush blocks both faces have one, of a block on the ground the ground's alone
    const double wide = 2.82 / 107.0, sunk = 800.0 * kThin * wide * kHigh * 9.81 / 30e6;
    // column of 20, joint i closed by i·sunk: force K(S D − P D²/2), on the ground P/4; P/(2S) = 1/b + 1/w
    const double settled = sunk * (1.0 / kThin + 1.0 / wide) * (2870.0 - 0.5 * 400.0) / 210.0;
    // moment of the rim, K/2 ∮ x D²/2, against K φ w b³/12; friction acts in the middle of the overlap, nearer to the weight by D/2
    const double leant = sunk * (3.0 / kThin + 1.0 / wide - 1.0 / kHigh);
    const double settle = run("settle", {}).error, lean = run("lean", {}).error;
    INFO("column sinks by " << settle << " more, of it rims " << settled << "; leaning " << lean << ", of it rims " << leant);
    CHECK(settle == relative(settled, 1e-2));
    CHECK(lean == relative(leant, 1e-2));
    // the number of nodes is nothing to it
    CHECK(run("lean", {.nodes_per_face = 12}).error == lean);
}

// Trapezoidal rule: k_θ too large by 1 + 2/(n − 1)² for n nodes across.
TEST_CASE("the rocking stiffness of the leader's nodes converges with the square of their spacing") {
    struct Density {
        int nodes, across;
    };
    for (const Density d : {Density{12, 3}, Density{44, 4}, Density{176, 11}}) {
        REQUIRE(make_node_lattice({1.36, 2.82, 4.25}, d.nodes).nx == d.across);
        const double stiffer = 1.0 + 2.0 / ((d.across - 1) * (d.across - 1));
        const double error = run("lean", {.faces = FaceContact::nodes, .nodes_per_face = d.nodes}).error;
        // the lean of the weight changes with the tilt too: 5e-6 of it
        CHECK(error == relative(1.0 - 1.0 / stiffer, 1e-4));
    }
}

namespace {

/// Quarter period of a block that rocks about a pivot `arm` from its middle and whose edge sinks in as far as it must to bear the weight:
/// a wedge of length L, K w L² tan θ/2 = m g, whose load acts a third of L inside. Runge-Kutta steps, as θ̈ = −p² (sin(α − θ) − L/(3R)).
double compute_soft_quarter_period(double arm) {
    const double wide = 2.82 / 107.0, gravity = 9.81, mass = 800.0 * kThin * wide * kHigh, stiffness = 30e6 / (kThin * wide);
    const double radius = std::hypot(arm, 0.5 * kHigh), inertia = (kThin * kThin + kHigh * kHigh) / 12.0;
    const double alpha = std::atan2(2.0 * arm, kHigh), p2 = gravity * radius / (inertia + radius * radius);
    const auto acceleration = [&](double tilt) {
        const double inside = std::sqrt(2.0 * mass * gravity / (stiffness * wide * std::tan(std::max(tilt, 1e-9)))) / 3.0;
        return -p2 * (std::sin(alpha - tilt) - inside / radius);
    };
    double tilt = 0.5 * alpha, rate = 0.0, time = 0.0;
    constexpr double kStep = 1e-6;
    while (true) {
        const double k1 = acceleration(tilt), k2 = acceleration(tilt + 0.5 * kStep * rate + 0.125 * kStep * kStep * k1);
        const double k4 = acceleration(tilt + kStep * rate + 0.5 * kStep * kStep * k2);
        const double next = tilt + kStep * rate + kStep * kStep / 6.0 * (k1 + 2.0 * k2);
        if (next <= 0.0) return time + kStep * tilt / (tilt - next);
        rate += kStep / 6.0 * (k1 + 4.0 * k2 + k4);
        tilt = next;
        time += kStep;
    }
}

double rigid_quarter_period(double arm) {
    const double radius = std::hypot(arm, 0.5 * kHigh), inertia = (kThin * kThin + kHigh * kHigh) / 12.0;
    const double alpha = std::atan2(2.0 * arm, kHigh);
    return compute_quarter_period(alpha, std::sqrt(9.81 * radius / (inertia + radius * radius)), 0.5 * alpha);
}

}  // namespace

TEST_CASE("a block rocks about its own edge, or that of another block, where that edge is") {
    const double own = compute_soft_quarter_period(0.5 * kThin) / rigid_quarter_period(0.5 * kThin) - 1.0;
    const double other = compute_soft_quarter_period(0.3 * kThin) / rigid_quarter_period(0.3 * kThin) - 1.0;
    const double on_ground = run("rock_ground", {}).error, on_block = run("rock_own_edge", {}).error;
    const double about_other = run("rock_other_edge", {}).error;
    INFO("quarter period off by " << on_ground << " on the ground, " << on_block << " on a block, where the edge sinks in by " << own
                                  << "; " << about_other << " about the edge of another block, " << other);
    // the edge sinks in, which moves the pivot. The block begins above where it will bear its weight: it takes some of the fall into its
    // turning and rings on its edge, as its dashpot and the spring of friction let it; that is a part of the sink
    CHECK(on_ground == relative(own, 0.15));
    CHECK(about_other == relative(other, 0.15));
    CHECK(own < 2e-3);
    CHECK(other < 3e-3);
    // ground or block, wherever on it
    CHECK(on_block == relative(on_ground, 1e-2));
    // the leader's nodes: the last covered cell acts at its middle, at a quarter of the spacing past a node 3/8 of it inside the edge. With
    // 4 nodes across that is an eighth of the width, 200 times what the edge sinks in by; a third of it is asked for
    for (const int nodes : {12, 44}) {
        CHECK(run("rock_own_edge", {.faces = FaceContact::nodes, .nodes_per_face = nodes}).error > 64.0 * on_block);
    }
}

TEST_CASE("a shaken wall comes closer to the converged one with shorter steps and by nodes with more of them" *
          doctest::test_suite("slow")) {
    const MiniTower wall({}, {}, 3);
    const TopMotion converged = wall.run({.safety = 0.1});
    const double coarse = compare_tops(wall.run({.safety = 0.8}), converged), fine = compare_tops(wall.run({.safety = 0.2}), converged);
    const double few = compare_tops(wall.run({.faces = FaceContact::nodes, .nodes_per_face = 12}), converged);
    const double many = compare_tops(wall.run({.faces = FaceContact::nodes, .nodes_per_face = 176}), converged);
    INFO("top of a low wall: off by " << coarse << " at 0.8 of the critical step, " << fine << " at 0.2; by nodes " << few << " with 12, "
                                      << many << " with 176");
    // of first order in the step a seventh, (0.2 − 0.1)/(0.8 − 0.1); half is asked for, since joints open and close between steps
    CHECK(fine < 0.5 * coarse);
    // 11 nodes across in place of 3, a fifth of the spacing, in which the part of a face that lifts is of first order at least
    CHECK(many < 0.5 * few);
    CHECK(compare_tops(converged, converged) == 0.0);
    CHECK(compare_peaks(converged, converged) == 0.0);
    CHECK(std::isinf(compare_tops(TopMotion{}, converged)));
    CHECK(std::isinf(compare_peaks(TopMotion{}, converged)));
}

namespace {

AccuracyRow make_row(double error, double seconds, const std::string& family = "step") {
    return {.name = "made", .family = family, .label = "x", .setting = {}, .outcome = {error, 10, 20, seconds}};
}

}  // namespace

TEST_CASE("a setting is on the Pareto front when no other is both faster and closer") {
    const double never = std::numeric_limits<double>::infinity();
    AccuracyPanel panel{"made",
                        "Made",
                        {make_row(1e-1, 1.0), make_row(1e-2, 2.0), make_row(1e-2, 3.0), make_row(2e-2, 2.5), make_row(1e-3, 9.0),
                         make_row(never, 0.1), make_row(0.0, 0.1, "copy"), make_row(1e-1, 1.0)}};
    mark_pareto(panel);
    const std::array<bool, 8> expected{true, true, false, false, true, false, false, true};
    for (std::size_t r = 0; r < expected.size(); ++r) CHECK_MESSAGE(panel.rows[r].pareto == expected[r], r);
}

TEST_CASE("the table of a sweep has a line per row, and the plot a panel per problem") {
    const AccuracySweep sweep{"made",
                              {{"one", "First problem", {make_row(1e-2, 2.0), make_row(std::numeric_limits<double>::infinity(), 1.0)}},
                               {"two", "Second problem", {make_row(0.0, 2.0, "grid")}}}};
    std::istringstream csv(make_accuracy_csv(sweep));
    std::string line;
    int lines = 0;
    while (std::getline(csv, line)) {
        CHECK(std::count(line.begin(), line.end(), ',') == 13);
        ++lines;
    }
    CHECK(lines == 4);
    CHECK(make_accuracy_csv(sweep).find("made,step,x,0.8,0,overlap,none,0,inf,") != std::string::npos);
    const std::string svg = make_accuracy_svg(sweep);
    CHECK(svg.find("First problem") != std::string::npos);
    CHECK(svg.find("Second problem") != std::string::npos);
    // no number that a viewer could not place
    for (const char* bad : {"nan", "inf"}) CHECK(svg.find(bad) == std::string::npos);
}
