#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "lsdem/simulation.hpp"
#include "lsdem/tilted.hpp"
#include "lsdem/time_step.hpp"
#include "tests/support/models.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

/// A block that stands deep in the ground, and one that leans on it deep in its top, at rest.
Model make_sunk_blocks(const Stone& stone) {
    Model model = make_model(stone);
    const double h = stone.size.z();
    const Quaternion lean(Eigen::AngleAxisd(0.01, Vector3::UnitY()));
    model.blocks.push_back(make_block(stone, {0.0, 0.0, (0.5 - 1e-3) * h}));
    model.blocks.push_back(make_block(stone, {0.0, 0.0, (1.5 - 2e-3) * h}, lean));
    return model;
}

double upward_force(const Simulation& simulation, std::size_t leader, std::optional<std::size_t> follower) {
    for (const ContactForce& contact : simulation.contact_forces())
        if (contact.leader == leader && contact.follower == follower) return -contact.force.z();
    return 0.0;
}

}  // namespace

TEST_CASE("blocks that stand already bear what they are said to bear, however deep they overlap") {
    const Stone stone = wood();
    Model model = make_sunk_blocks(stone);
    const double weight = stone.weight(), one = weight * weight / (2.0 * stone.normal_stiffness);
    model.preload = {{0, {}, 4.0 * one}, {0, 1, one}};
    const Simulation simulation(model, 0.1 * compute_critical_time_step(model));
    const auto forces = simulation.contact_forces();
    REQUIRE(forces.size() == 2);
    for (const ContactForce& contact : forces) {
        const double wanted = contact.follower ? one : 4.0 * one;
        CHECK(contact.energy == doctest::Approx(wanted).epsilon(1e-9));
    }
    // a flat face that holds (2mg)²/(2k) pushes with 2mg; the tilted one with more than √(2kE), since less of it carries
    CHECK(-upward_force(simulation, 0, std::nullopt) == doctest::Approx(2.0 * weight).epsilon(1e-9));
    const double leaning = upward_force(simulation, 0, 1);
    CHECK(leaning > 0.0);
    CHECK(leaning < weight);

    model.preload.clear();
    const Simulation sprung(model, 0.1 * compute_critical_time_step(model));
    CHECK(upward_force(sprung, 0, 1) > 100.0 * weight);
}

TEST_CASE("contacts that no preload names bear nothing at first") {
    Model model = make_sunk_blocks(wood());
    model.preload = {{0, {}, 1e-9 * wood().weight() * wood().size.z()}};
    const Simulation simulation(model, 0.1 * compute_critical_time_step(model));
    CHECK(upward_force(simulation, 0, std::nullopt) < 0.0);
    CHECK(upward_force(simulation, 0, 1) == 0.0);
}

TEST_CASE("a pile goes on in another simulation with the forces that its contacts hold, friction included") {
    // a beam, turned and tilted so that it meets its supports as boxes at an angle, and one of these stands on the ground
    const Stone stone = wood();
    Model model = make_model(stone);
    const double h = stone.size.z(), span = stone.size.y();
    for (const double y : {-span, span}) {
        model.blocks.push_back(make_block(stone, {0.0, y, 0.5 * h + (y > 0.0 ? 0.02 * h : 0.0)}));
        model.blocks.back().fixed = y > 0.0;
    }
    const Quaternion turn(Eigen::AngleAxisd(0.08, Vector3::UnitZ())), lie(Eigen::AngleAxisd(0.5 * kPi, Vector3::UnitX()));
    model.blocks.push_back(make_block(stone, {0.0, 0.0, h + 0.6 * stone.size.y()}, turn * lie));
    const double step = 0.5 * compute_critical_time_step(model), rate = 4.0 * std::sqrt(kGravity / h);
    Simulation settled(model, step);
    settled.begin_preparation(rate);
    settled.advance(200000);
    REQUIRE(settled.velocity(2).norm() < 1e-5 * std::sqrt(kGravity * h));

    for (std::size_t b = 0; b < model.blocks.size(); ++b) {
        model.blocks[b].position = settled.position(b);
        model.blocks[b].orientation = settled.orientation(b);
    }
    model.preload = settled.preloads();
    const Simulation taken(model, step);
    const auto before = settled.contact_forces(), after = taken.contact_forces();
    REQUIRE(before.size() >= 3);
    REQUIRE(after.size() == before.size());
    double friction = 0.0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        CHECK(after[i].leader == before[i].leader);
        CHECK((after[i].force - before[i].force).norm() < 1e-4 * stone.weight());
        CHECK((taken.preloads()[i].friction - model.preload[i].friction).norm() < 1e-4 * stone.weight());
        friction = std::max(friction, model.preload[i].friction.norm());
    }
    CHECK(friction > 5e-3 * stone.weight());
    CHECK(std::any_of(model.preload.begin(), model.preload.end(), [](const Preload& p) { return p.faces != 0; }));
    CHECK(std::any_of(model.preload.begin(), model.preload.end(), [](const Preload& p) { return !p.traction_u.empty(); }));
}

TEST_CASE("a preload of a block that is not there, or of less than nothing, is refused") {
    const Model model = make_sunk_blocks(wood());
    const double step = 0.1 * compute_critical_time_step(model), unknown = std::numeric_limits<double>::quiet_NaN();
    for (const Preload& bad : {Preload{2, {}, 1.0}, Preload{0, 2, 1.0}, Preload{0, 1, -1.0}, Preload{0, 1, unknown}}) {
        Model wrong = model;
        wrong.preload = {bad};
        CHECK_THROWS_AS(Simulation(wrong, step), std::invalid_argument);
    }
    Preload known{0, 1, 1.0};
    known.count_p = 2, known.count_q = 3;
    known.traction_u = known.traction_v = std::vector<double>(6, 0.0);
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
    CHECK(accepts(known));
    Preload fewer = known, endless = known, other_faces = known, unknown_friction = known, unknown_couple = known;
    fewer.traction_v.pop_back();
    endless.count_p = std::size_t{1} << 40U;
    other_faces.faces = TiltedFaces::kCodes + 1;
    unknown_friction.traction_u.back() = unknown;
    unknown_couple.couple = unknown;
    for (const Preload& bad : {fewer, endless, other_faces, unknown_friction, unknown_couple}) CHECK_FALSE(accepts(bad));
}

TEST_CASE("a block that slides onto another is carried without a break when the strip they share becomes a patch") {
    // a beam on two fixed blocks with a gap between them; it shares less with the left one than two skins at first, and more in the end
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
    // it bounces on its springs at first; then the left block carries a growing part
    const double whole = 0.15 * thin / speed;
    simulation.advance(static_cast<std::uint64_t>(0.2 * whole / step));
    double least = std::numeric_limits<double>::infinity(), before = upward_force(simulation, 0, 2), largest_fall = 0.0;
    while (simulation.time() < whole) {
        simulation.advance(1);
        const double now = upward_force(simulation, 0, 2);
        least = std::min(least, now);
        largest_fall = std::max(largest_fall, before - now);
        before = now;
    }
    CHECK(length - strip - simulation.position(2).x() > 0.06 * thin);
    CHECK(least > 0.0);
    // one step does not take away what it bears
    CHECK(largest_fall < 0.1 * stone.weight());
}
