#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

#include "lsdem/detail/tilted_kernel.hpp"
#include "lsdem/simulation.hpp"
#include "lsdem/time_step.hpp"
#include "tests/support/heaps.hpp"
#include "tests/support/models.hpp"
#include "tests/support/motion.hpp"
#include "tests/support/relative.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;
using detail::BoxPair;
using detail::RelativePose;
using detail::TiltedLoad;

namespace {

/// Two boxes in the world.
struct Boxes {
    std::array<Vector3, 2> position;
    std::array<Matrix3, 2> rotation;
};

constexpr std::size_t kLeader = 0, kFollower = 1;

RelativePose relative_pose(const Boxes& boxes) {
    const Matrix3 back = boxes.rotation[kFollower].transpose();
    const Matrix3 q = back * boxes.rotation[kLeader];
    const Vector3 t = back * (boxes.position[kLeader] - boxes.position[kFollower]);
    return {q, t, q, t};
}

/// Force and moment about its centre that a box gets, world frame.
struct Wrench {
    Vector3 force, moment;
};

Wrench wrench_on(std::size_t box, const Boxes& boxes, const TiltedLoad& load) {
    const RelativePose pose = relative_pose(boxes);
    const Matrix3& frame = boxes.rotation[kFollower];
    const detail::Row moment_row = detail::compute_moment(load.force, pose);
    const Vector3 force = frame * Vector3(load.force.force[0], load.force.force[1], load.force.force[2]);
    const Vector3 moment = frame * Vector3(moment_row[0], moment_row[1], moment_row[2]);
    if (box == kFollower) return {-force, -moment};
    return {force, moment - (boxes.position[kLeader] - boxes.position[kFollower]).cross(force)};
}

}  // namespace

TEST_CASE("the force between tilted boxes is minus the gradient of its energy for every motion of either box") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> even(-1.0, 1.0);
    const BoxPair halves{{0.5, 0.8, 1.1}, {0.9, 0.6, 0.7}};
    const double stiffness = 1.0, step = 1e-7;
    int loaded = 0, with_edges = 0;
    double worst = 0.0;
    for (int trial = 0; trial < 3000; ++trial) {
        Boxes boxes;
        for (std::size_t i = 0; i < 2; ++i) boxes.rotation[i] = random_orientation(random).toRotationMatrix();
        boxes.position = {1.2 * Vector3(even(random), even(random), even(random)), Vector3(even(random), even(random), even(random))};
        const TiltedFaces faces{static_cast<std::uint8_t>(trial % 3), static_cast<std::uint8_t>(trial / 3 % 3),
                                trial % 2 == 0 ? 1.0 : -1.0};
        const double late = trial % 5 == 0 ? 0.1 : 0.0;
        const auto load_at = [&](const Boxes& at) {
            return detail::compute_tilted_load(halves, relative_pose(at), faces, late, stiffness);
        };
        const TiltedLoad load = load_at(boxes);
        if (load.energy < 1e-3) continue;
        ++loaded;
        const detail::Row& f = load.force.force;
        if (std::abs(f[(faces.k + 1U) % 3U]) + std::abs(f[(faces.k + 2U) % 3U]) > 0.01 * std::abs(f[faces.k])) ++with_edges;
        double size = 0.0;
        for (const double component : f) size = std::max(size, std::abs(component));

        for (std::size_t box = 0; box < 2; ++box) {
            const Wrench wrench = wrench_on(box, boxes, load);
            for (int axis = 0; axis < 3; ++axis) {
                const Vector3 unit = Vector3::Unit(axis);
                const auto energy_moved = [&](double by) {
                    Boxes moved = boxes;
                    moved.position[box] += by * unit;
                    return load_at(moved).energy;
                };
                const auto energy_turned = [&](double by) {
                    Boxes turned = boxes;
                    turned.rotation[box] = Eigen::AngleAxisd(by, unit).toRotationMatrix() * boxes.rotation[box];
                    return load_at(turned).energy;
                };
                const double slope = (energy_moved(step) - energy_moved(-step)) / (2.0 * step);
                const double turning = (energy_turned(step) - energy_turned(-step)) / (2.0 * step);
                worst = std::max(worst, std::abs(slope + wrench.force[axis]) / size);
                worst = std::max(worst, std::abs(turning + wrench.moment[axis]) / size);
            }
        }
    }
    MESSAGE(loaded << " loaded poses, " << with_edges << " with loaded edges; gradient off by " << worst << " of the force");
    REQUIRE(loaded > 300);
    REQUIRE(with_edges > 200);
    // central differences of a step h over boxes of size 1: third derivatives, up to 1/cos³ = 1e3, times h²/6, and rounding 1e-16/h; where
    // a corner of one face passes an edge of the other within h, the second derivative jumps, by some times the force: h times that
    CHECK(worst < 1e-6);
}

namespace {

/// Where a pressure that grows with the depth lies, over the part of the leader's face in the follower: from a fine grid of its points.
struct SampledReach {
    double load = 0.0, squared = 0.0;
    double root_mean_square() const { return std::sqrt(squared / load); }
};

SampledReach sample_reach(const BoxPair& halves, const RelativePose& pose, const TiltedFaces& faces) {
    constexpr int kPoints = 600;
    const std::size_t k = faces.k, n = faces.n, p = (n + 1U) % 3U, q = (n + 2U) % 3U;
    const double face_n = faces.side * pose.rotation[k][n] < 0.0 ? halves.leader[n] : -halves.leader[n];
    SampledReach sum;
    double load_a = 0.0, load_b = 0.0;
    for (int i = 0; i < kPoints; ++i) {
        for (int j = 0; j < kPoints; ++j) {
            detail::Row place{}, seen{};
            place[n] = face_n;
            place[p] = halves.leader[p] * (2.0 * (i + 0.5) / kPoints - 1.0);
            place[q] = halves.leader[q] * (2.0 * (j + 0.5) / kPoints - 1.0);
            bool inside = true;
            for (std::size_t r = 0; r < 3; ++r) {
                seen[r] = pose.position[r] + detail::dot(pose.rotation[r], place);
                if (r != k) inside = inside && std::abs(seen[r]) < halves.follower[r];
            }
            const double depth = halves.follower[k] - faces.side * seen[k];
            if (!inside || depth <= 0.0) continue;
            sum.load += depth, load_a += depth * place[p], load_b += depth * place[q];
            sum.squared += depth * (place[p] * place[p] + place[q] * place[q]);
        }
    }
    sum.squared -= (load_a * load_a + load_b * load_b) / sum.load;
    return sum;
}

}  // namespace

TEST_CASE("boxes at an angle resist turning with the root of three quarters of the mean square distance of their pressure") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> even(-1.0, 1.0);
    const BoxPair halves{{0.5, 0.8, 1.1}, {0.9, 0.6, 0.7}};
    Interface interface;
    interface.normal_stiffness = interface.shear_stiffness = 1.0;
    interface.friction = 0.5;
    const detail::StepLaw law(interface, 1.0);
    int loaded = 0;
    double worst = 0.0;
    for (int trial = 0; trial < 400; ++trial) {
        // the leader stands on the follower, tilted and turned, one of its corners or edges sunk in
        const Vector3 axis(even(random), even(random), 0.0);
        const Matrix3 turned =
            (Eigen::AngleAxisd(0.3 * even(random), axis.normalized()) * Eigen::AngleAxisd(even(random), Vector3::UnitZ()))
                .toRotationMatrix();
        const double reach = turned.row(2).cwiseAbs().dot(Vector3(0.5, 0.8, 1.1));
        const Vector3 position(0.6 * even(random), 0.6 * even(random), 0.7 + reach - 0.05 - 0.04 * even(random));
        // turned about the vertical by so much in one step that hardly anything else counts
        const Matrix3 before = Eigen::AngleAxisd(-1.0, Vector3::UnitZ()).toRotationMatrix() * turned;
        const RelativePose pose(turned, position, before, position);
        TiltedContact contact;
        detail::PairSums sums;
        detail::compute_tilted_contact(halves, pose, law, true, {}, contact, sums);
        if (!contact.touches || contact.couple == detail::Row{}) continue;
        const detail::Row &push = contact.elastic.force, &couple = contact.couple;
        const double limit = interface.friction * std::sqrt(detail::dot(push, push)),
                     shear = std::sqrt(detail::dot(contact.shear, contact.shear));
        // where the centre of pressure moves as well, both share the limit
        const double left = std::sqrt(std::max(0.0, limit * limit - shear * shear));
        if (left < 0.3 * limit) continue;
        ++loaded;
        const double found = std::sqrt(detail::dot(couple, couple)) / left;
        const double expected = std::sqrt(0.75) * sample_reach(halves, pose, contact.faces).root_mean_square();
        worst = std::max(worst, std::abs(found / expected - 1.0));
    }
    MESSAGE(loaded << " contacts at an angle, reach off by " << worst);
    REQUIRE(loaded > 50);
    // the grid misses up to a cell along the border: a few of 600 cells of a polygon that may be a tenth as wide
    CHECK(worst < 0.02);
}

namespace {

Model make_free_model(const Stone& stone) {
    Model model = make_model(stone);
    model.gravity.setZero();
    model.ground.present = false;
    return model;
}

}  // namespace

// Their edges pass each other at 26 um, measured along both edges' common normal.
TEST_CASE("boxes that come close edge to edge without touching do not push each other") {
    Stone stone = wood();
    stone.nodes_per_face = 15;
    stone.restitution = 1.0;
    Model model = make_free_model(stone);
    Block a = make_block(stone, {-0.0045939644334147267, 0.094015374130268739, 0.036906489452120411},
                         Quaternion(0.63739111220993361, -0.11739625452739889, 0.74085013834084168, 0.17632856268647404));
    a.velocity = {-0.21336315087576357, 0.21959878272141403, -0.2310838202672042};
    a.angular_velocity = {2.9056102268808939, 2.3173497352472356, 4.2605797389144335};
    Block b = make_block(stone, {-0.0052731567862003316, 0.056647759130509838, 0.027901029112591274},
                         Quaternion(0.48554006870061905, 0.75893825811505056, 0.017851640478894711, 0.43352610185285209));
    b.velocity = {0.0038184297944573501, 0.040931095496694783, -0.07467425494865748};
    b.angular_velocity = {-10.726052928066682, 0.87546644343335653, 2.5605319469880921};
    model.blocks = {a, b};
    for (const auto nodes : {ContactNodes::leader, ContactNodes::both}) {
        model.contact_nodes = nodes;
        Simulation s(model, 0.5 * compute_critical_time_step(model));
        REQUIRE(s.statistics().pairs > 0);
        CHECK(s.contact_force(0) == Vector3::Zero());
        const Energy start = s.energy();
        // the gap closes at less than |v| + (|ω_a| + |ω_b|) R = 0.45 + 17.4·0.025 = 0.9 m/s: nothing can touch within 20 us
        advance_to(s, 2e-5);
        CHECK(s.contact_force(0) == Vector3::Zero());
        CHECK(s.statistics().contact_nodes == 0);
        CHECK(s.energy().kinetic == relative(start.kinetic, 1e-12));
    }
}

TEST_CASE("a corner that drops beside the edge of a fixed block is not turned back before it touches") {
    Stone stone = wood();
    stone.restitution = 1.0;
    Model model = make_free_model(stone);
    model.contact_nodes = ContactNodes::both;
    Block fixed = make_block(stone, {0.0, 0.0, 0.5 * stone.size.x()}, lying());
    fixed.fixed = true;
    Block falling = make_block(stone, {0.0062257112044880412, 0.005732995570150487, 0.037894802448153138},
                               Quaternion(0.39871437782152414, 0.38046050037061074, 0.062813469662792082, -0.83206437287331392));
    falling.velocity = {0.0, 0.0, -1.5};
    model.blocks = {fixed, falling};
    Simulation s(model, 0.2 * compute_critical_time_step(model));
    const double energy = s.energy().kinetic;
    // the corners are apart by 0.16 mm, by a separating axis, until 4 ms
    advance_to(s, 3.9e-3);
    CHECK(s.velocity(1) == falling.velocity);
    double worst = 0.0;
    while (s.time() < 6e-3) {
        advance(s, 20);
        worst = std::max(worst, std::abs(s.energy().balance() / energy - 1.0));
    }
    REQUIRE(s.statistics().max_overlap_over_height > 0.0);
    REQUIRE(s.velocity(1).z() > falling.velocity.z());
    // leapfrog keeps the energy of a spring to (ω0 dt)²/4, with ω0 of a whole face
    const double steps = s.time_step() * std::sqrt(stone.normal_stiffness / stone.mass());
    CHECK(worst < 0.25 * steps * steps);
}

// The follower's edge slides along the leader's flat face: the force is across that face, not across one of the follower's.
TEST_CASE("a block that slides on its edge along a flat face is slowed by mu g") {
    const Stone stone = wood();
    for (const double direction : {1.0, -1.0}) {
        for (const double tilt : {0.6, 0.25 * kPi}) {
            Model model = make_model(stone);
            model.ground.present = false;
            Block table = make_block(stone, {0.0, 0.0, -0.5 * stone.size.x()}, lying());
            table.fixed = true;
            // lying along x, its lower edge along y
            const Quaternion turn = Quaternion(Eigen::AngleAxisd(tilt, Vector3::UnitY())) * lying();
            const Vector3 reach = turn.toRotationMatrix().cwiseAbs() * (0.5 * stone.size);
            Block slider = make_block(stone, {0.0, 0.5 * stone.size.y(), reach.z()}, turn);
            slider.rotation_locked = true;
            slider.velocity.x() = direction * 0.4;
            model.blocks = {table, slider};
            // the edge lies at the end of the block that points down; start it at the middle of the table
            const Matrix3 r = turn.toRotationMatrix();
            Vector3 corner = Vector3::Zero();
            for (int a = 0; a < 3; ++a) corner += (r(2, a) < 0.0 ? 0.5 : -0.5) * stone.size[a] * r.col(a);
            model.blocks[1].position.x() = -corner.x() - direction * 0.25 * stone.size.z();

            Simulation s(model, 0.5 * compute_critical_time_step(model));
            advance_to(s, 0.03);
            REQUIRE(s.statistics().contact_nodes > 0);
            // ∫N dt = m(g t + v_z); the friction of a sliding contact is μ times that, whatever the history of N.
            // What is left is the first step of every touch, where the slip is still elastic: μ N/k_s of the 9 mm it slides
            const double impulse = kGravity * s.time() + s.velocity(1).z();
            CHECK(direction * (slider.velocity.x() - s.velocity(1).x()) == relative(stone.friction * impulse, 2e-3));
        }
    }
}

TEST_CASE("elastic collisions without friction give the kinetic energy back") {
    Stone stone = wood();
    stone.restitution = 1.0;
    stone.friction = 0.0;
    int collisions = 0, losing = 0;
    double gained = 0.0, steps = 0.0;
    for (std::uint32_t seed = 0; seed < 40; ++seed) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> even(-1.0, 1.0);
        const double apart = 1.05 * stone.size.norm();
        Model model = make_free_model(stone);
        model.blocks.push_back(make_block(stone, Vector3::Zero(), random_orientation(random)));
        const double y = 0.3 * apart * even(random), z = 0.3 * apart * even(random);
        model.blocks.push_back(make_block(stone, {apart, y, z}, random_orientation(random)));
        model.blocks[1].velocity.x() = -0.5;
        Simulation s(model, 0.2 * compute_critical_time_step(model));
        steps = s.time_step() * std::sqrt(stone.normal_stiffness / stone.mass());
        const double energy = s.energy().kinetic;
        advance_to(s, 0.08);
        REQUIRE_FALSE(s.divergence().has_value());
        // some are still in contact: what their springs hold counts
        const double back = s.energy().mechanical() / energy - 1.0;
        collisions += s.statistics().max_overlap_over_height > 0.0 ? 1 : 0;
        losing += back < -0.01 ? 1 : 0;
        gained = std::max(gained, back);
    }
    MESSAGE(collisions << " elastic collisions, " << losing << " lose more than 1 %, none gains more than " << gained);
    REQUIRE(collisions > 30);
    CHECK(losing == 0);
    // (ω0 dt)² of the energy, with ω0 of a whole face
    CHECK(gained < steps * steps);
}
