#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/stability/scenes.hpp"
#include "tests/stability/table.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

/// Demands on let-go or struck stacks. Closure: a light block that bounces on a heavy one touches and parts within steps, each time
/// (ω0 dt)² of its energy, and all the energy in play is its own; second order (2.4e-2, 6e-3, 1.4e-3 at 1, 1/2, 1/4 of the default step).
/// Overlap: 0.1 m/s times sqrt(m/k_n) is 2e-4 of an edge, sqrt(1e6) times that when the stiffness falls so far.
constexpr Demands kStruck{.closure = 0.05, .gain = 1e-6, .overlap = 0.1};

/// Three blocks on each other, the middle one of another stiffness.
Model make_sandwich(double stiffness_ratio) {
    const Stone stone = coarse_wood();
    Model model = make_model(stone);
    model.materials.push_back(make_material(stiffened(stone, stiffness_ratio)));
    for (std::size_t i = 0; i < 3; ++i)
        model.blocks.push_back(make_block(stone, {0.0, 0.0, (0.5 + static_cast<double>(i)) * stone.size.z()}));
    model.blocks[1].material = 1;
    return model;
}

/// Two blocks on each other, the upper one `ratio` times as heavy; both so stiff that the heavier one presses its joint by 3.5e-7 of the
/// height and that its stack does not buckle, which takes k_n b²/12 > m g H.
Model make_unequal_pair(double ratio) {
    const Stone stone = stiffened(coarse_wood(), std::max(1.0, 0.1 * ratio));
    Model model = make_model(stone);
    for (std::size_t i = 0; i < 2; ++i)
        model.blocks.push_back(make_block(stone, {0.0, 0.0, (0.5 + static_cast<double>(i)) * stone.size.z()}));
    model.blocks[1].mass *= ratio;
    return model;
}

/// The uppermost block comes from just above at 0.1 m/s.
Model struck(Model model) {
    model.blocks.back().position.z() += 1e-6 * model.shapes[0].half_extents.z();
    model.blocks.back().velocity.z() = -0.1;
    return model;
}

void check_restitution(double restitution) {
    Stone stone = coarse_wood();
    stone.restitution = restitution;
    const Model wall = make_shaken_wall(stone);
    check_sound(fmt::format("wall, restitution {}", restitution), observe(wall, default_time_step(wall), 0.2, 100),
                {.closure = 0.01, .gain = 1e-6, .overlap = 1e-2});
}

}  // namespace

TEST_SUITE("stability") {
    TEST_CASE("blocks of unequal stiffness rest on each other and bounce without gaining energy") {
        for (const double ratio : {1e-6, 1e-4, 1e-2, 1e2, 1e4, 1e6}) {
            Model stack = make_sandwich(ratio);
            // a joint of width b bears K (b² w/4 − b³/12) at most, 0.8 of the stack at 1e-6: there in a tenth of gravity
            if (ratio < 1e-5) stack.gravity *= 0.1;
            const double step = default_time_step(stack);
            // a soft joint settles by 2 m g/k_n, 0.04 b at 1e-6 and 4e-3 b at 1e-4, and by twice that when it is let go; struck, by
            // 0.1 m/s times sqrt(m/k_n), 0.15 b at 1e-6
            const Demands demands{.closure = kStruck.closure, .gain = kStruck.gain, .overlap = ratio < 1e-5 ? 0.4 : 0.1};
            check_sound(fmt::format("stiffness ratio {:.0e}, let go", ratio), observe(stack, step, 40000 * step, 200), demands);
            check_sound(fmt::format("stiffness ratio {:.0e}, struck", ratio), observe(struck(stack), step, 40000 * step, 200), demands);
        }
    }

    TEST_CASE("blocks of unequal mass rest on each other and bounce without gaining energy") {
        for (const double ratio : {1e-6, 1e-4, 1e-2, 1e2, 1e4, 1e6}) {
            const Model stack = make_unequal_pair(ratio);
            const double step = default_time_step(stack);
            // five periods of the heavier block on its joint, which lasts 2 pi sqrt(ratio) times longer than the lighter one's
            const double duration = std::max(20000.0, 60.0 * std::sqrt(std::max(ratio, 1.0 / ratio))) * step;
            check_sound(fmt::format("mass ratio {:.0e}, let go", ratio), observe(stack, step, duration, 200), kStruck);
            check_sound(fmt::format("mass ratio {:.0e}, struck", ratio), observe(struck(stack), step, duration, 200), kStruck);
        }
    }

    TEST_CASE("a shaken wall stays sound for any friction and shear stiffness") {
        for (const double shear_over_normal : {0.1, 2.0})
            for (const double friction : {0.0, 0.01, 10.0}) {
                Stone stone = coarse_wood();
                stone.shear_stiffness = shear_over_normal * stone.normal_stiffness;
                stone.friction = friction;
                const Model wall = make_shaken_wall(stone);
                check_sound(fmt::format("wall, k_s/k_n {}, friction {}", shear_over_normal, friction),
                            observe(wall, default_time_step(wall), 0.2, 100), {.closure = 0.01, .gain = 1e-6, .overlap = 1e-2});
            }
    }

    TEST_CASE("a shaken wall stays sound with nodes of both sides and with shear damping") {
        Stone stone = coarse_wood();
        Model both = make_shaken_wall(stone);
        both.numerics.face_contact = FaceContact::nodes;
        both.numerics.contact_nodes = ContactNodes::both;
        stone.shear_damping_ratio = 0.5;
        const Model damped = make_shaken_wall(stone);
        const Demands demands{.closure = 0.01, .gain = 1e-6, .overlap = 1e-2};
        check_sound("wall, nodes of both sides", observe(both, default_time_step(both), 0.2, 100), demands);
        check_sound("wall, shear damping 0.5", observe(damped, default_time_step(damped), 0.2, 100), demands);
    }

    TEST_CASE("a shaken wall stays sound for any restitution" * doctest::test_suite("stability-slow")) {
        for (const double restitution : {0.01, 0.3, 1.0}) check_restitution(restitution);
    }
}

// The step falls with the damping ratio: at e = 1e-3 it is 25 times shorter than at 0.3.
TEST_SUITE("stability-slow") {
    TEST_CASE("a shaken wall stays sound with hardly any restitution") { check_restitution(1e-3); }
}
