#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include "lsdem/contact/overlap_lanes.hpp"
#include "lsdem/motion/settling_simulation.hpp"
#include "lsdem/time_step.hpp"
#include "tests/support/heaps.hpp"
#include "tests/support/models.hpp"
#include "tests/support/motion.hpp"
#include "tests/support/relative.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

/// Force on the upper box, and moment about its centre.
struct Push {
    Vector3 force = Vector3::Zero(), moment = Vector3::Zero();  ///< [N], [N·m]
};

/// A box on another one that is larger, moved by prescribed steps. Lengths of its sides b, w, h.
class MovedBox {
  public:
    MovedBox(const Vector3& size, const Interface& law, double depth, double twist = 0.0) : law_(law), depth_(depth) {
        box_.half = 0.5 * size;
        box_.position.z() = 0.5 * kTable + box_.half.z() - depth;
        box_.rotation = Eigen::AngleAxisd(twist, Vector3::UnitZ());
        table_.half = {2.0, 2.0, 0.5 * kTable};
    }

    /// Moves the upper box by a shift and a turn about its own centre, and finds what acts on it.
    Push move(const Vector3& shift, const Vector3& turn = Vector3::Zero()) {
        const Vector3 before = box_.position;
        box_.step = BodyStep{};
        if (!turn.isZero(0.0)) box_.step.turn = Eigen::AngleAxisd(turn.norm(), turn.normalized());
        box_.position += shift;
        box_.rotation = box_.step.turn * box_.rotation;
        box_.step.shift = box_.position - before;
        PairForce force;
        detail::LanePair pair{{&table_, &box_}, &law_, &contact_, &force, &tally_, &work_};
        detail::ExactRoom room;
        detail::compute_exact_pair(pair, {}, kStep, false, room);
        return {-force.force, force.follower_torque};
    }
    double lost() const { return work_.friction; }
    double area() const { return 4.0 * box_.half.x() * box_.half.y(); }
    double weight() const { return law_.normal_stiffness * area() * depth_; }

    static constexpr double kStep = 1e-3;  ///< [s]

  private:
    static constexpr double kTable = 1.0;
    BodyPose table_, box_;
    Interface law_;
    double depth_;
    OverlapContact contact_;
    PairTally tally_;
    PairWork work_;
};

constexpr Interface kLaw{.normal_stiffness = 1e9, .shear_stiffness = 0.8e9, .friction = 0.6, .normal_damping = 0.0, .shear_damping = 0.0};

constexpr double kHeight = 1.0;

/// Turns the box about its x axis until the part `open` of a joint of width w has opened, and back, under the load of `depth` all over it.
/// Push of the contact in the end.
Push open_and_close(MovedBox& box, double w, double depth, double open) {
    constexpr int kSteps = 800;
    constexpr double kAllClosed = 0.2;  // of the way to the end: all of the joint bears until then
    double tilt = 0.0, middle = depth;
    Push now;
    for (int i = 1; i <= kSteps; ++i) {
        const double way = 0.5 - 0.5 * std::cos(2.0 * kPi * i / kSteps);
        const double closed = 1.0 - open * std::max(0.0, (way - kAllClosed) / (1.0 - kAllClosed));
        const double tilt_now = std::min(1.0, way / kAllClosed) * 2.0 * depth / (w * closed * closed);
        const double middle_now = closed < 1.0 ? tilt_now * w * (closed - 0.5) : depth;
        const double lever = 0.5 * kHeight, lowered = lever * (std::cos(tilt_now) - std::cos(tilt));
        now = box.move({0.0, -lever * (std::sin(tilt_now) - std::sin(tilt)), middle - middle_now + lowered}, {tilt_now - tilt, 0.0, 0.0});
        tilt = tilt_now, middle = middle_now;
    }
    return now;
}

Model make_shaken_bond() {
    Model model = shortened(make_running_bond(wood(), 2, 3, 5), 0.01);
    model.ground.motion.shift[0] = velocity_step(1.0);
    return model;
}

}  // namespace

// Node by node: what opens loses its slip, what stays closed keeps it, and what closes again has none. So what never opened keeps its share
// of the shear, after the first cycle and after all others.
TEST_CASE("a joint that opens and closes keeps the shear of the part that never opened") {
    for (const double open : {0.5, 0.9, 0.98}) {
        CAPTURE(open);
        const double b = 0.3, w = 0.5, depth = 1e-6;
        MovedBox box({b, w, kHeight}, kLaw, depth);
        box.move(Vector3::Zero());
        const double slip = 0.5 * (1.0 - open) * kLaw.friction * depth * kLaw.normal_stiffness / kLaw.shear_stiffness;
        const double whole = box.move({slip, 0.0, 0.0}).force.x();
        // strips of the depth's width along the edges have no part in friction: over the width of what stays closed, where it is deepest
        const double closed = 1.0 - open, strips = 2.0 * depth / (w * closed * closed);
        for (int cycle = 0; cycle < 10; ++cycle) {
            CHECK(open_and_close(box, w, depth, open).force.x() == relative(closed * whole, strips));
        }
        CHECK(box.lost() > -1e-12 * std::abs(whole * slip));
    }
}

// Every point is pushed by C/Δt for what it went down in touch: together, C/Δt times the volume that the overlap has gained.
TEST_CASE("dashpots of a joint that closes push by the volume swept in touch, however shallow it is") {
    const double b = 0.3, w = 0.5, tilt = 1e-6;
    Interface damped = kLaw;
    damped.normal_damping = 2.0 * kLaw.normal_stiffness * MovedBox::kStep;
    MovedBox box({b, w, kHeight}, damped, -1e-6), springs({b, w, kHeight}, kLaw, -1e-6);
    for (MovedBox* const each : {&box, &springs}) each->move(Vector3::Zero(), {tilt, 0.0, 0.0});
    // an edge 1e-8 deep, half of the face, then all of it; the last step is in touch all over
    double before = 0.0;
    for (const double lower : {0.76e-6, 0.24e-6, 0.3e-6, 0.1e-6}) {
        CAPTURE(before);
        const double pushed = box.move({0.0, 0.0, -lower}).force.z(), spring = springs.move({0.0, 0.0, -lower}).force.z();
        REQUIRE(spring > before);
        CHECK(pushed == relative(spring + 2.0 * (spring - before), 1e-4));
        before = spring;
    }
}

TEST_CASE("a joint that sticks is a spring of its area against sliding and of its second moment against turning") {
    const double b = 0.3, w = 0.5, depth = 1e-6;
    MovedBox box({b, w, 1.0}, kLaw, depth);
    box.move(Vector3::Zero());
    const double slip = 1e-8, turn = 2e-8, stiffness = kLaw.shear_stiffness * b * w;
    const Push moved = box.move({slip, 0.0, 0.0}, {0.0, 0.0, turn});
    // strips of the depth's width along the edges are nearest to the sides and have no part in friction
    CHECK(moved.force.x() == relative(-stiffness * slip, 5.0 * depth / b));
    CHECK(moved.moment.z() == relative(-stiffness * (b * b + w * w) / 12.0 * turn, 10.0 * depth / b));
    // D2: back at the origin the force is zero again, to the rounding of places over the slip, and nothing is lost
    const Push back = box.move({-slip, 0.0, 0.0}, {0.0, 0.0, -turn});
    CHECK(std::hypot(back.force.x(), back.force.y()) < 1e-7 * stiffness * slip);
    CHECK(std::abs(box.lost()) < 1e-7 * stiffness * slip * slip);
}

// D2: a slider driven to and fro by u0 loses 4 μN (u0 − μN/k_s) a cycle
TEST_CASE("a joint that is driven to and fro loses the area of Cundall's loop") {
    MovedBox box({0.3, 0.5, 1.0}, kLaw, 1e-6);
    box.move(Vector3::Zero());
    const double limit = kLaw.friction * box.weight(), stiffness = kLaw.shear_stiffness * box.area(), amplitude = 5.0 * limit / stiffness;
    constexpr int kSteps = 2000;
    double at_start = 0.0;
    for (int i = 0; i < 2 * kSteps; ++i) {
        const double phase = 2.0 * kPi / kSteps;
        box.move({amplitude * (std::sin(phase * (i + 1)) - std::sin(phase * i)), 0.0, 0.0});
        if (i + 1 == kSteps) at_start = box.lost();
    }
    // 1e-3: reversals fall between steps
    CHECK(box.lost() - at_start == relative(4.0 * limit * (amplitude - limit / stiffness), 1e-3));
}

// A6, at any twist: pressure is even, so the reach of friction is the mean distance of the face from its middle
TEST_CASE("a box that spins is held by mu N times the mean distance of its face, however it is turned") {
    const double b = 0.3, w = 0.5, depth = 1e-6;
    for (const double twist : {0.0, 0.3, kPi / 4, 1.2}) {
        CAPTURE(twist);
        MovedBox box({b, w, 1.0}, kLaw, depth, twist);
        box.move(Vector3::Zero());
        Push spun;
        for (int i = 0; i < 20; ++i) spun = box.move(Vector3::Zero(), {0.0, 0.0, 1e-6});
        CHECK(spun.moment.z() == relative(-kLaw.friction * box.weight() * mean_distance(b, w), 1e-4));
        CHECK(std::hypot(spun.force.x(), spun.force.y()) < 1e-6 * kLaw.friction * box.weight());
    }
}

// The exact limit surface of a square that slides and spins about points at a distance r from its middle, by summing friction over its
// points; the ellipse is within 14 % of it.
TEST_CASE("friction of a box that slides and spins lies within 14 % of the exact limit surface") {
    const double a = 0.4, depth = 1e-6;
    for (const double pole : {0.05, 0.15, 0.3, 0.6}) {
        double force = 0.0, couple = 0.0;
        constexpr int kPoints = 400;
        for (int i = 0; i < kPoints; ++i) {
            for (int j = 0; j < kPoints; ++j) {
                const double x = a * ((i + 0.5) / kPoints - 0.5), y = a * ((j + 0.5) / kPoints - 0.5);
                const double vx = -y, vy = x + pole, speed = std::hypot(vx, vy);
                force += vy / speed / (kPoints * kPoints);
                couple += (x * vy - y * vx) / speed / (kPoints * kPoints);
            }
        }
        MovedBox box({a, a, 1.0}, kLaw, depth);
        box.move(Vector3::Zero());
        Push slid;
        for (int i = 0; i < 400; ++i) {
            const double turn = 2e-7;
            slid = box.move({0.0, pole * turn, 0.0}, {0.0, 0.0, turn});
        }
        const double limit = kLaw.friction * box.weight();
        const double got_force = -slid.force.y() / limit, got_couple = -slid.moment.z() / limit;
        const double reach = mean_distance(a, a);
        // along the ray to the exact point the ellipse lies at this part of it
        const double part = std::hypot(got_force, got_couple / reach) / std::hypot(force, couple / reach);
        CHECK(part > 0.86);
        CHECK(part < 1.14);
        CHECK(std::hypot(got_force, got_couple / reach) == relative(1.0, 1e-3));
        CHECK(got_force == doctest::Approx(force).epsilon(0.14));
    }
}

// D1
TEST_CASE("a block that falls flat on another or the ground bounces with its coefficient of restitution") {
    const Stone stone = wood();
    for (const bool on_block : {false, true}) {
        Model model = make_model(stone);
        const double floor = on_block ? stone.size.z() : 0.0, fall = 0.05 * stone.size.z();
        if (on_block) {
            model.ground.present = false;
            model.blocks.push_back(make_block(stone, {0.0, 0.0, 0.5 * stone.size.z()}));
            model.blocks[0].fixed = true;
        }
        model.blocks.push_back(make_block(stone, {0.0, 0.0, floor + 0.5 * stone.size.z() + fall}));
        const std::size_t falls = model.blocks.size() - 1;
        Simulation s(model, 0.02 * compute_critical_time_step(model));
        double fastest = 0.0, after = 0.0;
        while (after == 0.0) {
            advance(s);
            const double v = s.velocity(falls).z();
            fastest = std::min(fastest, v);
            // free again, on its way up
            if (v > 0.0 && s.contact_force(falls).isZero(0.0)) after = v;
        }
        // 1 %: weight during the impact over its force, g/(v ω) = 1e-3, and the step
        CHECK(-after / fastest == relative(stone.restitution, 0.01));
    }
}

TEST_CASE("a list that is made anew after any number of steps gives the same bits") {
    for (const Model& model : {make_shaken_bond(), make_loose_pile(wood(), 2, 2)}) {
        const double step = 0.8 * compute_critical_time_step(model);
        std::string expected;
        for (const int every : {0, 1, 7, 64}) {
            CAPTURE(every);
            Simulation s(model, step);
            for (int i = 0; i < 1792; ++i) {
                s.advance();
                if (every > 0 && i % every == 0) s.renew_neighbors();
            }
            if (every == 0) expected = s.state_hash();
            CHECK(s.state_hash() == expected);
        }
    }
}

TEST_CASE("threads, restarts and passing over pairs that are apart change no bit of blocks that meet by their overlap") {
    Model model = make_shaken_bond();
    const double step = 0.8 * compute_critical_time_step(model);
    Simulation whole(model, step), relay(model, step);
    whole.advance(1200);
    REQUIRE(whole.energy().friction_loss > 0.0);
    for (int part = 0; part < 3; ++part) {
        relay.advance(400);
        std::stringstream state;
        relay.save(state);
        relay = Simulation::restore(model, state, 2);
    }
    CHECK(relay.state_hash() == whole.state_hash());
    CHECK(relay.energy().balance() == whole.energy().balance());
    model.numerics.skip_apart = false;
    Simulation looking(model, step);
    looking.advance(1200);
    CHECK(looking.state_hash() == whole.state_hash());
}

TEST_CASE("blocks of unequal height come to rest in long steps, and go on in another simulation with the friction that they hold") {
    const Stone stone = wood();
    Model model = shortened(make_running_bond(stone, 1, 3, 4), 0.01);
    const double height = stone.size.z(), speed = std::sqrt(kGravity * height), step = 0.8 * compute_critical_time_step(model);
    SettlingSimulation settling(Simulation(model, 4.0 * step), 4.0 * speed / height, Inertia::as_stable);
    settling.advance(36000);
    const Simulation& settled = settling.state();
    REQUIRE_FALSE(settled.divergence());
    for (std::size_t b = 0; b < model.blocks.size(); ++b) {
        REQUIRE(settled.velocity(b).norm() < 1e-6 * speed);
        model.blocks[b].position = settled.position(b);
        model.blocks[b].orientation = settled.orientation(b);
    }
    model.preload = settled.preloads();
    Simulation taken(model, step);
    const auto before = settled.contact_forces(), after = taken.contact_forces();
    REQUIRE(after.size() == before.size());
    double friction = 0.0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        // who leads is the lower block when the list is made
        const double side = after[i].leader == before[i].leader ? 1.0 : -1.0;
        CHECK((after[i].force - side * before[i].force).norm() < 1e-5 * stone.weight());
        friction = std::max(friction, model.preload[i].friction.norm());
    }
    CHECK(friction > 1e-3 * stone.weight());
    // and stands as it stood
    taken.advance(2000);
    for (std::size_t b = 0; b < model.blocks.size(); ++b) CHECK((taken.position(b) - model.blocks[b].position).norm() < 1e-8 * height);
}

// Renumbered blocks meet with the bodies of a pair exchanged and add up their contacts in another order; a mirrored or turned scene rounds
// otherwise. What differs at first is rounding, 1e-16 of a coordinate over the overlap.
TEST_CASE("renumbering, mirroring and turning a scene change rounding only") {
    const Model model = make_shaken_bond();
    const std::size_t count = model.blocks.size();
    const double step = 0.8 * compute_critical_time_step(model), height = wood().size.z();
    constexpr std::uint64_t kSteps = 150;
    Simulation original(model, step);
    original.advance(kSteps);

    const auto largest_difference = [&](const Model& other, const std::function<std::size_t(std::size_t)>& number, const Matrix3& map) {
        Simulation s(other, step);
        s.advance(kSteps);
        double largest = 0.0;
        for (std::size_t i = 0; i < count; ++i)
            largest = std::max(largest, (s.position(number(i)) - map * original.position(i)).norm() / height);
        return largest;
    };
    Model renumbered = model;
    const auto backwards = [count](std::size_t i) { return count - 1 - i; };
    for (std::size_t i = 0; i < count; ++i) renumbered.blocks[backwards(i)] = model.blocks[i];
    CHECK(largest_difference(renumbered, backwards, Matrix3::Identity()) < 1e-11);

    const auto same = [](std::size_t i) { return i; };
    Model mirrored = model;
    for (Block& block : mirrored.blocks) {
        block.position.x() = -block.position.x();
        block.orientation = Quaternion(block.orientation.w(), block.orientation.x(), -block.orientation.y(), -block.orientation.z());
    }
    mirrored.ground.motion.shift[0] = velocity_step(-1.0);
    CHECK(largest_difference(mirrored, same, Vector3(-1.0, 1.0, 1.0).asDiagonal()) < 1e-11);

    Model turned = model;
    const Quaternion quarter(Eigen::AngleAxisd(0.5 * kPi, Vector3::UnitZ()));
    for (Block& block : turned.blocks) {
        block.position = quarter * block.position;
        block.orientation = quarter * block.orientation;
    }
    turned.ground.motion.shift = {BaseComponent{}, velocity_step(1.0), BaseComponent{}};
    CHECK(largest_difference(turned, same, quarter.toRotationMatrix()) < 1e-11);
}

// J5
TEST_CASE("frictionless blocks that collide at all angles without dashpots keep their energy") {
    Stone stone = wood();
    stone.friction = 0.0;
    stone.restitution = 1.0;
    const Model model = make_tumbling_cloud(stone, 2);
    Simulation s(model, 0.1 * compute_critical_time_step(model));
    const double before = s.energy().mechanical();
    double touched = 0.0;
    for (int i = 0; i < 60; ++i) {
        s.advance(500);
        touched = std::max(touched, s.energy().elastic_normal);
    }
    REQUIRE(touched > 0.0);
    CHECK(s.energy().mechanical() == relative(before, 1e-5));
}
