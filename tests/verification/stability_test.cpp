#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>

#include "lsdem/motion/simulation.hpp"
#include "lsdem/time_step.hpp"
#include "tests/support/models.hpp"
#include "tests/support/motion.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

/// A tilt table in the frame of the table: the horizontal acceleration of the base rises to g·tan(angle) in `rise` [s], then holds. Returns
/// whether the column has started to turn over or to slide by the end: moved
/// by more than a quarter of its base, in proportion to the height.
bool gives_way(const Stone& stone, std::size_t count, double angle, double rise, double hold) {
    Model model = make_resting_column(stone, count);
    const double a = kGravity * std::tan(angle);
    model.ground.motion.shift[0] =
        sample_velocity(rise + hold, 4000, [=](double t) { return t < rise ? 0.5 * a * t * t / rise : a * (t - 0.5 * rise); });
    Simulation s(model, 0.8 * compute_critical_time_step(model));
    while (s.time() < rise + hold) {
        advance(s, 64);
        for (std::size_t i = 0; i < count; ++i) {
            const double moved = s.position(i).x() - s.base().displacement.x() - model.blocks[i].position.x();
            const double level = (static_cast<double>(i) + 1.0) / static_cast<double>(count);
            if (std::abs(moved) > 0.25 * stone.size.x() * level) return true;
        }
    }
    return false;
}

/// Brackets the angle at which a column gives way: it stands at 1 − margin of `degrees`, and does not at 1 + margin.
void check_tilt(const Stone& stone, std::size_t count, double degrees, double margin, double rise, double hold) {
    CAPTURE(count);
    const double angle = degrees * kPi / 180.0;
    CHECK_FALSE(gives_way(stone, count, (1.0 - margin) * angle, rise, hold));
    CHECK(gives_way(stone, count, (1.0 + margin) * angle, rise, hold));
}

}  // namespace

// Statics: a dry column of n equal blocks turns over as one at atan(B/(nH)), or slides at atan μ, whichever is less.
TEST_CASE("a tilted column stands below its overturning angle and gives way above it" * doctest::test_suite("slow")) {
    // Near the limit the base joint leans by the kernel angle over the square of what is missing to the limit, 5e-7 n/m² rad with a margin
    // m, at the stiffness of wood; a hundred times that stiffness keeps it below a tenth of m B/(nH) for m = 3 %, n up to 5. Above the
    // limit the column needs acosh(1 + 1/(4 m))/p to lean by a quarter of the balancing angle.
    const Stone thin = stiffened(reference_wood(), 30.0);
    check_tilt(thin, 1, 17.7447, 0.03, 0.02, 0.25);
    check_tilt(thin, 2, 9.0903, 0.03, 0.03, 0.35);
    const Stone wide = turned(thin);
    check_tilt(wide, 1, 32.2109, 0.02, 0.02, 0.4);
    check_tilt(wide, 2, 18.3540, 0.03, 0.03, 0.35);
}

TEST_SUITE("slow") {
    TEST_CASE("a tall tilted column stands below its overturning angle and gives way above it") {
        const Stone thin = stiffened(reference_wood(), 100.0), wide = turned(thin);
        check_tilt(thin, 5, 3.6619, 0.05, 0.08, 0.4);
        check_tilt(wide, 5, 7.5593, 0.05, 0.08, 0.4);
        check_tilt(thin, 10, 1.8328, 0.06, 0.08, 0.5);
        check_tilt(wide, 10, 3.7962, 0.06, 0.08, 0.5);
        // with a margin of 10 %, at 38 blocks, 5e-7 n/(30 m²) rad are a thirteenth of m B/(nH), or less
        const Stone thirty = stiffened(reference_wood(), 30.0);
        check_tilt(thirty, 38, 0.48248, 0.1, 0.1, 0.8);
        check_tilt(turned(thirty), 38, 1.00036, 0.1, 0.1, 0.8);
    }
}

namespace {

/// Stacks `count` blocks on a fixed one, each reaching beyond the one below by `factor` times the harmonic overhang L/(2i), i from the top.
bool overhang_falls(std::size_t count, double factor) {
    Stone stone = stiffened(turned(wood()), 100.0);
    stone.size = {0.039780, 0.026355, 0.012710};
    stone.nodes_per_face = 77;
    Model model = make_model(stone);
    model.ground.present = false;
    Block table = make_block(stone, {0.0, 0.0, -0.5 * stone.size.z()});
    table.fixed = true;
    model.blocks.push_back(table);
    double x = 0.0;
    for (std::size_t level = 0; level < count; ++level) {
        x += factor * 0.5 * stone.size.x() / static_cast<double>(count - level);
        model.blocks.push_back(make_block(stone, {x, 0.0, (static_cast<double>(level) + 0.5) * stone.size.z()}));
    }
    Simulation s(model, 0.8 * compute_critical_time_step(model));
    while (s.time() < 0.15) {
        advance(s, 256);
        for (std::size_t i = 1; i <= count; ++i)
            if (std::abs(tilt_about_y(s, i)) > 0.02) return true;
    }
    return false;
}

}  // namespace

// [PatersonZwick09]: n equal blocks reach (L/2) Σ 1/i beyond the table: 0.5, 0.75, 0.916667, 1.041667 L.
// The joints are a hundred times as stiff as wood's: near the limit a joint leans by the kernel angle over the square of the missing
// one percent, 1.8e4·5e-9 rad, which moves a block's weight by a hundredth of that percent.
TEST_CASE("a harmonic overhang stands with offsets one percent less and falls with one percent more") {
    for (std::size_t count = 1; count <= 3; ++count) {
        CAPTURE(count);
        CHECK_FALSE(overhang_falls(count, 0.99));
        CHECK(overhang_falls(count, 1.01));
    }
}

TEST_SUITE("slow") {
    TEST_CASE("a harmonic overhang of four blocks stands with one percent less and falls with one percent more") {
        CHECK_FALSE(overhang_falls(4, 0.99));
        CHECK(overhang_falls(4, 1.01));
    }
}
