#include <doctest/doctest.h>
#include <fmt/format.h>

#include "lsdem/time_step.hpp"
#include "tests/stability/scenes.hpp"
#include "tests/stability/table.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

constexpr double kBelow[] = {0.1, 0.3, 0.5, 0.8, 0.9, 1.0};
constexpr double kAbove[] = {1.1, 1.2, 1.3};

/// Without rotation the limit of a chain is exact. Alternating velocities excite its stiffest mode.
Model make_exact_chain(double restitution) {
    Stone stone = coarse_wood();
    stone.restitution = restitution;
    Model model = make_resting_column(stone, 10, true);
    for (std::size_t i = 0; i < 10; ++i) model.blocks[i].velocity.z() = i % 2 == 0 ? 1e-6 : -1e-6;
    shake(model, 0.3 * kGravity, 30.0, 0.1);
    return model;
}

Observation run_at(const Model& model, double fraction) { return observe(model, fraction * compute_critical_time_step(model), 0.1, 100); }

std::string name_of(const char* scene, double fraction) { return fmt::format("step {:.1f} of the limit, {}", fraction, scene); }

/// Touching and parting within a step cost (ω0 dt)² of the energy of the blocks concerned; at the limit, ω0 dt = 1, blocks that rock and
/// slide were seen to lose 1e-2 of the energy in play.
Demands shaken(double fraction) { return {.closure = 0.01 + 0.02 * fraction * fraction, .gain = 1e-6, .overlap = 1e-2}; }

}  // namespace

TEST_SUITE("stability") {
    TEST_CASE("an undamped chain stays bounded up to the limit and is stopped above it") {
        const Model chain = make_exact_chain(1.0);
        for (const double fraction : kBelow)
            check_sound(name_of("chain", fraction), run_at(chain, fraction), {.closure = 1e-9, .gain = 1e-9, .overlap = 1e-4});
        for (const double fraction : kAbove) check_detected(name_of("chain", fraction), chain, run_at(chain, fraction));
    }

    // Dashpots and joints that lift hold the unstable motion of a damped chain down, so that it chatters instead of growing; no look at its
    // state or its energy balance shows. The program compares the two steps and warns (tests/cli).
    TEST_CASE("a damped chain is still up to the limit and chatters above it without gaining energy") {
        const Model chain = make_exact_chain(0.3);
        // at 0.3 g the chain is sheared by 5e-6 of an edge; chatter is a thousand times that
        for (const double fraction : kBelow)
            check_sound(name_of("chain, e = 0.3", fraction), run_at(chain, fraction),
                        {.closure = 1e-9, .gain = 1e-9, .drift = 1e-5, .overlap = 1e-4});
        for (const double fraction : kAbove)
            check_sound_or_detected(name_of("chain, e = 0.3", fraction), chain, run_at(chain, fraction), {.gain = 1e-3, .overlap = 1e-2});
    }

    // Blocks that turn: the limit is a bound on the safe side, so that some steps above it are stable still.
    TEST_CASE("a shaken column and a shaken wall stay bounded up to the limit and do not fail silently above it" *
              doctest::test_suite("stability-slow")) {
        for (const double restitution : {1.0, 0.3}) {
            Stone stone = coarse_wood();
            stone.restitution = restitution;
            Model column = make_resting_column(stone, 10), wall = make_wall(stone);
            for (Model* model : {&column, &wall}) {
                shake(*model, 0.3 * kGravity, 30.0, 0.1);
                const std::string scene = fmt::format("{}, e = {}", model == &column ? "column" : "wall", restitution);
                for (const double fraction : kBelow) {
                    // damped, as they are by default, at every fraction; undamped at two
                    if (restitution == 1.0 && fraction != 0.5 && fraction != 1.0) continue;
                    check_sound(name_of(scene.c_str(), fraction), run_at(*model, fraction), shaken(fraction));
                }
                for (const double fraction : kAbove)
                    check_sound_or_detected(name_of(scene.c_str(), fraction), *model, run_at(*model, fraction),
                                            {.closure = 0.05, .gain = 1e-3, .overlap = 1e-2});
            }
        }
    }
}
