#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>

#include "lsdem/patches.hpp"
#include "lsdem/study/accuracy_cases.hpp"
#include "lsdem/study/accuracy_plot.hpp"
#include "lsdem/study/accuracy_sweep.hpp"
#include "lsdem/study/accuracy_tower.hpp"
#include "tests/support/relative.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::study;
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
    MESSAGE(name << ": error " << coarse << " at " << safety << " of the critical step, " << fine << " at half of it");
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

TEST_CASE("a patch is as stiff as the continuous face for any number of nodes from three on") {
    for (const PatchSpacing spacing : {PatchSpacing::even, PatchSpacing::lobatto}) {
        for (const int nodes : {12, 44, 176}) {
            CAPTURE(nodes);
            const AccuracySetting setting{.nodes_per_face = nodes, .spacing = spacing};
            // the transient is left at e^-20 = 2e-9 of the tilt, a few times that with its sway
            CHECK(run("lean", setting).error < 2e-8);
            // the transient is left at e^-25; the sum of 20 heights rounds to 1e-16 m in 7e-7 m
            CHECK(run("settle", setting).error < 1e-8);
        }
    }
}

// Trapezoidal rule: k_θ too large by 1 + 2/(n − 1)² for n nodes across.
TEST_CASE("the rocking stiffness of the leader's nodes converges with the square of their spacing") {
    struct Density {
        int nodes, across;
    };
    for (const Density d : {Density{12, 3}, Density{44, 4}, Density{176, 11}}) {
        REQUIRE(make_node_lattice({1.36, 2.82, 4.25}, d.nodes).nx == d.across);
        const double stiffer = 1.0 + 2.0 / ((d.across - 1) * (d.across - 1));
        const double error = run("lean", {.nodes_per_face = d.nodes, .faces = FaceContact::nodes}).error;
        // the lean of the weight changes with the tilt too: 5e-6 of it
        CHECK(error == relative(1.0 - 1.0 / stiffer, 1e-4));
    }
}

TEST_CASE("a block rocks about its own edge on a larger block where that edge is, whatever the nodes") {
    const double alpha = std::atan2(kThin, kHigh), tilt = 0.5 * alpha, gravity = 9.81;
    const auto fall = [&](double arm) {
        const double radius = std::hypot(arm, 0.5 * kHigh), inertia = (kThin * kThin + kHigh * kHigh) / 12.0;
        return compute_quarter_period(std::atan2(2.0 * arm, kHigh), std::sqrt(gravity * radius / (inertia + radius * radius)), tilt);
    };
    for (const int nodes : {12, 44}) {
        CAPTURE(nodes);
        const AccuracyOutcome patch = run("rock_own_edge", {.nodes_per_face = nodes});
        const AccuracyOutcome leader = run("rock_own_edge", {.nodes_per_face = nodes, .faces = FaceContact::nodes});
        MESSAGE(nodes << " nodes: quarter period off by " << patch.error << " with patches, " << leader.error
                      << " with the leader's nodes; " << patch.seconds << " s, " << leader.seconds << " s");
        // the edge of a patch lies inside the follower's by 1/512 of the spacing: the pivot moves by that, and until the patch touches the
        // block falls freely, with nothing that turns it
        const int across = make_node_lattice({1.36, 2.82, 4.25}, nodes).nx;
        const double inside = kThin / (across - 1) / 512.0, free_fall = std::sqrt(2.0 * inside * std::sin(tilt) / gravity);
        const double moved = std::abs(fall(0.5 * kThin - inside) / fall(0.5 * kThin) - 1.0);
        CHECK(patch.error < moved + free_fall / fall(0.5 * kThin));
        // the last covered cell of the leader acts at its middle, at a quarter of the spacing past a node 3/8 of it inside the edge,
        // against 1/512: 192 times as far; a third of it is asked for, since the free fall adds to the patch's error
        CHECK(leader.error > 64.0 * patch.error);
    }
    // the edge of the block below carries nodes in both layouts; its rocking shows only how far an edge sinks, 2 m g/k_edge at most, of the
    // width: below 1e-5 for any density here
    for (const FaceContact faces : {FaceContact::patch, FaceContact::nodes}) CHECK(run("rock_other_edge", {.faces = faces}).error < 1e-5);
}

// [AbramowitzStegun64, 25.4.32]: exact for polynomials of degree 2n − 3.
TEST_CASE("Gauss-Lobatto places integrate polynomials of degree 2n - 3 exactly and crowd towards the edges") {
    for (int count = 2; count <= 60; ++count) {
        CAPTURE(count);
        const PatchLattice lattice = make_patch_lattice(count, 2, PatchSpacing::lobatto);
        REQUIRE(lattice.size() == static_cast<std::size_t>(2 * count));
        CHECK(lattice.s.front() == -1.0);
        CHECK(lattice.s[static_cast<std::size_t>(count - 1)] == 1.0);
        for (int degree = 0; degree <= 2 * count - 3; degree += 2) {
            double sum = 0.0;
            for (std::size_t i = 0; i < lattice.size(); ++i) sum += lattice.w[i] * std::pow(lattice.s[i], degree);
            // the mean of s^d over [−1, 1]; sums of 120 numbers below one
            CHECK(std::abs(sum - 1.0 / (degree + 1)) < 1e-14);
        }
        const auto gap = [&](std::size_t i) { return lattice.s[i + 1] - lattice.s[i]; };
        for (std::size_t i = 0; i + 2 < static_cast<std::size_t>(count) && lattice.s[i + 1] < 0.0; ++i) CHECK(gap(i) < gap(i + 1));
    }
}

TEST_CASE("a shaken wall comes closer to the converged one with more nodes, even or edge-refined") {
    const MiniTower wall({}, {}, 6);
    const TopMotion converged = wall.run({.safety = 0.4, .nodes_per_face = 440, .spacing = PatchSpacing::lobatto});
    const double even = compare_tops(wall.run({.nodes_per_face = 48, .spacing = PatchSpacing::even}), converged);
    const double refined = compare_tops(wall.run({.nodes_per_face = 48, .spacing = PatchSpacing::lobatto}), converged);
    const double coarse = compare_tops(wall.run({.nodes_per_face = 12, .spacing = PatchSpacing::lobatto}), converged);
    // the spacing is halved, and the law of the part of a patch that lifts is of first order in it at least
    MESSAGE("top of a low wall: off by " << even << " with 48 even nodes, " << refined << " with refined ones, " << coarse << " with 12");
    CHECK(even < 0.5 * coarse);
    CHECK(refined < 0.5 * coarse);
    CHECK(compare_tops(converged, converged) == 0.0);
    CHECK(compare_peaks(converged, converged) == 0.0);
    CHECK(std::isinf(compare_tops(TopMotion{}, converged)));
    CHECK(std::isinf(compare_peaks(TopMotion{}, converged)));
}

namespace {

AccuracyRow make_row(double error, double seconds, const std::string& family = "patch") {
    return {.name = "made", .family = family, .label = "x", .setting = {}, .outcome = {error, 10, 20, seconds}};
}

}  // namespace

TEST_CASE("a setting is on the Pareto front when no other is both faster and closer") {
    const double never = std::numeric_limits<double>::infinity();
    AccuracyPanel panel{"made",
                        "Made",
                        {make_row(1e-1, 1.0), make_row(1e-2, 2.0), make_row(1e-2, 3.0), make_row(2e-2, 2.5), make_row(1e-3, 9.0),
                         make_row(never, 0.1), make_row(0.0, 0.1, "shadow"), make_row(1e-1, 1.0)}};
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
        CHECK(std::count(line.begin(), line.end(), ',') == 14);
        ++lines;
    }
    CHECK(lines == 4);
    CHECK(make_accuracy_csv(sweep).find("made,patch,x,0.8,44,even,patch,leader,0,inf,") != std::string::npos);
    const std::string svg = make_accuracy_svg(sweep);
    CHECK(svg.find("First problem") != std::string::npos);
    CHECK(svg.find("Second problem") != std::string::npos);
    // no number that a viewer could not place
    for (const char* bad : {"nan", "inf"}) CHECK(svg.find(bad) == std::string::npos);
}
