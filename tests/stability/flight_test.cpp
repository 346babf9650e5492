#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>

#include "tests/stability/scenes.hpp"
#include "tests/stability/table.hpp"
#include "tests/support/rocking.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

/// Stands a block on one of its corners, turned a little so that nothing is symmetric.
Quaternion on_corner(const Stone& stone) {
    const Quaternion upright = Quaternion::FromTwoVectors(stone.size, -Vector3::UnitZ());
    return (Quaternion(Eigen::AngleAxisd(0.01, Vector3::UnitX())) * upright).normalized();
}

/// A block that falls corner first from ten heights above z = `top` [m].
Block make_falling_block(const Stone& stone, double top) {
    return make_block(stone, {0.1 * stone.size.x(), 0.1 * stone.size.y(), top + 10.0 * stone.size.z() + 0.5 * stone.size.norm()},
                      on_corner(stone));
}

Model make_slab(const Stone& stone) {
    Model model = make_model(stone);
    model.blocks.push_back(make_block(stone, {0.0, 0.0, 0.5 * stone.size.x()}, lying()));
    model.blocks[0].fixed = true;
    return model;
}

/// 2.8 m/s on a single corner node. Closure: rocking down to rest parts and touches within steps, (ω0 dt)² of that energy each.
constexpr Demands kDropped{.closure = 0.01, .gain = 1e-3, .overlap = 0.2};

}  // namespace

TEST_SUITE("stability") {
    // Turning is symplectic: its energy swings about the true one by (ω dt)², about 1e-6 at 100 rad/s, and does not wander.
    TEST_CASE("free blocks spin and tumble for a million steps without change of energy") {
        const Stone stone = coarse_wood();
        Model model = make_model(stone);
        model.gravity.setZero();
        model.ground.present = false;
        const Vector3 rates[] = {{1e-3, 0.0, 100.0}, {0.5, 100.0, 0.5}, {30.0, 50.0, -80.0}};
        for (int i = 0; i < 3; ++i) {
            model.blocks.push_back(make_block(stone, {static_cast<double>(i), 0.0, 0.0}));
            model.blocks.back().angular_velocity = rates[i];
        }
        const double step = default_time_step(model);
        check_sound("spinning about the stiff, the middle and no axis", observe(model, step, 1e6 * step, 1000),
                    {.closure = 1e-6, .gain = 1e-6, .drift = 0.0, .overlap = 0.0});
    }

    TEST_CASE("a block dropped corner first from ten heights neither gains energy nor sinks in") {
        for (const double restitution : {1e-3, 0.3, 1.0}) {
            Stone stone = wood();
            stone.restitution = restitution;
            Model ground = make_model(stone), slab = make_slab(stone);
            ground.blocks.push_back(make_falling_block(stone, 0.0));
            slab.blocks.push_back(make_falling_block(stone, stone.size.x()));
            check_sound(fmt::format("corner first on the ground, e = {}", restitution),
                        observe(ground, default_time_step(ground), 0.5, 400), kDropped);
            check_sound(fmt::format("corner first on a block, e = {}", restitution), observe(slab, default_time_step(slab), 0.5, 400),
                        kDropped);
        }
    }

    // What passes through a neighbor must say so: by a divergence, or by a deep overlap.
    TEST_CASE("a block that comes too fast for its step is stopped by its neighbor or reported") {
        const Stone stone = coarse_wood();
        for (const double speed : {1.0, 10.0, 100.0, 1e3, 1e4, 1e5}) {
            Model model = make_slab(stone);
            model.ground.present = false;
            model.blocks.push_back(make_block(stone, {0.0, 0.0, 1.7 * stone.size.x() + 0.5 * stone.size.z()}));
            model.blocks[1].velocity.z() = -speed;
            const double step = default_time_step(model), duration = std::max(6.0 * stone.size.z() / speed, 1000.0 * step);
            double place = 0.0;
            Observation seen = observe(model, step, duration, 200, [&](const Simulation& now) { place = now.position(1).z(); });
            // came out on the other side: by then the whole edge had overlapped
            if (place < 0.5 * stone.size.x()) seen.measured_overlap = std::max(seen.measured_overlap, 1.0);
            check_sound_or_detected(fmt::format("block at {:g} m/s against a fixed one", speed), model, seen, {.gain = 1e-2});
        }
    }

    // Every impact of the rocking block parts and touches within steps: (ω0 dt)² of the elastic energy of an edge. e = 1 leaves friction
    // alone to end it.
    TEST_CASE("a rocking block loses its energy and never gains any") {
        for (const double restitution : {0.3, 1.0})
            for (const bool on_block : {false, true}) {
                Stone stone = wood();
                stone.restitution = restitution;
                Model model = make_tilted_block(stone, 0.15);
                if (on_block) {
                    model.ground.present = false;
                    model.blocks[0].position.x() += 0.5 * stone.size.x();
                    model.blocks.push_back(make_block(stone, {0.0, 0.0, -0.5 * stone.size.z()}));
                    model.blocks[1].fixed = true;
                }
                // with e = 1 friction alone ends the rocking, later than this
                const Demands demands{.closure = 0.02,
                                      .gain = 1e-3,
                                      .drift = restitution < 1.0 ? 1e-9 : Demands::kAny,
                                      .kinetic = restitution < 1.0 ? 1e-9 : Demands::kAny,
                                      .overlap = 1e-2};
                check_sound(fmt::format("rocking on {}, e = {}", on_block ? "a block" : "the ground", restitution),
                            observe(model, default_time_step(model), 3.0, 1000), demands);
            }
    }
}
