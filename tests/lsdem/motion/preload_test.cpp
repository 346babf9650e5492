#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "lsdem/motion/settling_simulation.hpp"
#include "lsdem/time_step.hpp"
#include "tests/support/models.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

/// A beam, turned and tilted, that lies on the edges of two supports, one of which is higher.
Model make_leaning_beam(const Stone& stone) {
    Model model = make_model(stone);
    const double h = stone.size.z(), span = stone.size.y();
    for (const double y : {-span, span}) {
        model.blocks.push_back(make_block(stone, {0.0, y, 0.5 * h + (y > 0.0 ? 0.02 * h : 0.0)}));
        model.blocks.back().fixed = y > 0.0;
    }
    const Quaternion turn(Eigen::AngleAxisd(0.08, Vector3::UnitZ())), lie(Eigen::AngleAxisd(0.5 * kPi, Vector3::UnitX()));
    model.blocks.push_back(make_block(stone, {0.0, 0.0, h + 0.6 * stone.size.y()}, turn * lie));
    return model;
}

}  // namespace

TEST_CASE("a pile goes on in another simulation with the forces that its contacts hold, friction included") {
    const Stone stone = wood();
    Model model = make_leaning_beam(stone);
    const double h = stone.size.z(), step = 0.5 * compute_critical_time_step(model), rate = 4.0 * std::sqrt(kGravity / h);
    SettlingSimulation settling(Simulation(model, step), rate);
    settling.advance(200000);
    const Simulation& settled = settling.state();
    REQUIRE(settled.velocity(2).norm() < 1e-5 * std::sqrt(kGravity * h));

    for (std::size_t b = 0; b < model.blocks.size(); ++b) {
        model.blocks[b].position = settled.position(b);
        model.blocks[b].orientation = settled.orientation(b);
    }
    model.preload = settled.preloads();
    const auto before = settled.contact_forces();
    REQUIRE(before.size() >= 3);
    Model renamed = model;
    for (Preload& preload : renamed.preload) {
        if (!preload.follower) continue;
        // the two blocks change places: on the other one acts the opposite force
        std::swap(preload.leader, *preload.follower);
        preload.friction = -preload.friction;
    }
    for (const Model& given : {model, renamed}) {
        const Simulation taken(given, step);
        const auto after = taken.contact_forces();
        REQUIRE(after.size() == before.size());
        double friction = 0.0;
        for (std::size_t i = 0; i < before.size(); ++i) {
            CHECK(after[i].leader == before[i].leader);
            CHECK((after[i].force - before[i].force).norm() < 1e-4 * stone.weight());
            CHECK((taken.preloads()[i].friction - model.preload[i].friction).norm() < 1e-4 * stone.weight());
            friction = std::max(friction, model.preload[i].friction.norm());
        }
        CHECK(friction > 5e-3 * stone.weight());
    }
    // without them the beam begins to slip
    model.preload.clear();
    const Simulation bare(model, step);
    for (const Preload& held : bare.preloads()) CHECK(held.friction.norm() < 1e-9 * stone.weight());
}

TEST_CASE("a preload of a block that is not there, or that is not finite, is refused") {
    const Model model = make_leaning_beam(wood());
    const double step = 0.1 * compute_critical_time_step(model), unknown = std::numeric_limits<double>::quiet_NaN();
    const auto accepts = [&](const Preload& preload) {
        Model given = model;
        given.preload = {preload};
        try {
            Simulation simulation(given, step);
        } catch (const std::invalid_argument&) {
            return false;
        }
        return true;
    };
    const Preload known{0, 2, {1.0, 0.0, 0.0}, 1.0};
    CHECK(accepts(known));
    Preload strange_leader = known, strange_follower = known, unknown_friction = known, unknown_couple = known;
    strange_leader.leader = 3;
    strange_follower.follower = 3;
    unknown_friction.friction.y() = unknown;
    unknown_couple.couple = unknown;
    for (const Preload& bad : {strange_leader, strange_follower, unknown_friction, unknown_couple}) CHECK_FALSE(accepts(bad));
}

TEST_CASE("a block that slides from one support onto another is carried without a break") {
    // a beam on two fixed blocks with a gap between them
    Stone stone = turned(wood());
    stone.friction = 0.0;
    Model model = make_model(stone);
    const double h = stone.size.z(), length = stone.size.x(), thin = stone.size.y();
    const double strip = 0.025 * thin, speed = 0.1 * std::sqrt(kGravity * h);
    for (const double x : {0.0, 1.5 * length}) {
        model.blocks.push_back(make_block(stone, {x, 0.0, 0.5 * h}));
        model.blocks.back().fixed = true;
    }
    model.blocks.push_back(make_block(stone, {length - strip, 0.0, 1.5 * h}));
    model.blocks.back().velocity = {-speed, 0.0, 0.0};
    const double step = 0.2 * compute_critical_time_step(model);
    Simulation simulation(model, step);
    const auto upward_force = [&] {
        for (const ContactForce& contact : simulation.contact_forces())
            if (contact.leader == 0 && contact.follower == 2) return -contact.force.z();
        return 0.0;
    };
    // it bounces on its springs at first; then the left block carries a growing part
    const double whole = 0.15 * thin / speed;
    simulation.advance(static_cast<std::uint64_t>(0.2 * whole / step));
    double least = std::numeric_limits<double>::infinity(), before = upward_force(), largest_fall = 0.0;
    while (simulation.time() < whole) {
        simulation.advance(1);
        const double now = upward_force();
        least = std::min(least, now);
        largest_fall = std::max(largest_fall, before - now);
        before = now;
    }
    CHECK(length - strip - simulation.position(2).x() > 0.06 * thin);
    CHECK(least > 0.0);
    // one step does not take away what it bears
    CHECK(largest_fall < 0.1 * stone.weight());
}
