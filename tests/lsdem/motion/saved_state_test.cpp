#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "lsdem/motion/simulation.hpp"
#include "lsdem/motion/state_fields.hpp"
#include "lsdem/time_step.hpp"
#include "tests/support/heaps.hpp"
#include "tests/support/models.hpp"
#include "tests/support/motion.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

std::string save(const Simulation& simulation) {
    std::ostringstream out;
    simulation.save(out);
    return out.str();
}

Simulation restore(const Model& model, const std::string& state, int threads = 1) {
    std::istringstream in(state);
    return Simulation::restore(model, in, threads);
}

/// Message of the error by which a state is refused; empty when it is not.
std::string refusal(const Model& model, const std::string& state) {
    try {
        (void)restore(model, state);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return {};
}

/// Shakes the ground hard along x and a little along z, at a pace that fits the papers' block.
void shake(Model& model) {
    model.ground.motion.shift[0] = sample_velocity(0.2, 200, [](double t) { return 0.3 * std::sin(90.0 * t); });
    model.ground.motion.shift[2] = sample_velocity(0.2, 200, [](double t) { return 0.05 * std::sin(140.0 * t); });
}

struct NamedModel {
    std::string name;
    Model model;
};

/// Every kind of contact and of block that the kernel has.
std::vector<NamedModel> make_models() {
    Model column = make_resting_column(wood(), 6);
    shake(column);
    Model bond = make_running_bond(wood(), 2, 2, 3);
    shake(bond);
    Model pile = make_loose_pile(wood(), 2, 2);
    pile.blocks[0].rotation_locked = true;
    Model cloud = make_tumbling_cloud(wood(), 2);
    cloud.velocity_damping = 3.0;
    Model sliding = make_lying_block(wood());
    sliding.blocks[0].velocity.x() = 0.1;
    sliding.gravity = tilted_gravity(std::atan(1.5 * wood().friction));

    // the same wall with other contacts
    Stone dashpots = wood();
    dashpots.shear_damping_ratio = 0.1;
    Model viscous = make_running_bond(dashpots, 1, 2, 3), by_nodes = bond, both = bond;
    viscous.blocks[0].fixed = true;
    shake(viscous);
    by_nodes.numerics.face_contact = FaceContact::nodes;
    both.numerics.face_contact = FaceContact::nodes;
    both.numerics.contact_nodes = ContactNodes::both;
    both.materials[0].shear_damping_ratio = 0.1;
    Model grids = make_resting_column(wood(), 3);
    grids.shapes[0] = make_grid_box_shape(wood().size, make_node_lattice(wood().size, 44), 0.001);
    grids.blocks[2].orientation = Quaternion(Eigen::AngleAxisd(0.3, Vector3::UnitY()));
    grids.blocks[2].position.z() += 0.1 * wood().size.z();
    shake(grids);
    Model balls = make_model(wood());
    balls.shapes[0] = make_sphere_shape(0.01, 200, 0.001);
    for (int i = 0; i < 3; ++i) balls.blocks.push_back(make_block(wood(), {0.004 * i, 0.0, 0.0105 + 0.021 * i}));
    return {{"column", column},     {"running bond", bond},     {"pile of tilted blocks", pile},
            {"free flight", cloud}, {"sliding block", sliding}, {"dashpots and a fixed block", viscous},
            {"nodes", by_nodes},    {"nodes of both", both},    {"grid level sets", grids},
            {"balls", balls}};
}

}  // namespace

TEST_CASE("a run that is saved and restored again and again ends in the bits of an uninterrupted one" * doctest::test_suite("one-thread")) {
    for (const NamedModel& named : make_models()) {
        CAPTURE(named.name);
        const Model& model = named.model;
        const double step = 0.8 * compute_critical_time_step(model);
        Simulation whole(model, step), relay(model, step);
        // before, at and after rebuilds of the neighbor list, and right at the start
        std::uint64_t rebuilds = 0;
        std::size_t legs_with_rebuild = 0;
        const std::uint64_t legs[] = {0, 1, 7, 64, 500, 1, 1000, 333, 1, 1, 600, 500};
        for (const std::uint64_t steps : legs) {
            const std::string state = save(relay);
            relay = restore(model, state);
            CHECK(save(relay) == state);
            whole.advance(steps);
            relay.advance(steps);
            // the state as a whole: histories, counters and energies too
            CHECK(save(relay) == save(whole));
            legs_with_rebuild += whole.statistics().rebuilds > rebuilds ? 1 : 0;
            rebuilds = whole.statistics().rebuilds;
        }
        CHECK_FALSE(whole.divergence().has_value());
        CHECK(legs_with_rebuild > 2);
        CHECK(relay.state_hash() == whole.state_hash());
        CHECK(relay.energy().balance() == whole.energy().balance());
        CHECK(relay.statistics().max_overlap_over_height == whole.statistics().max_overlap_over_height);
        CHECK(relay.velocity_damping() == model.velocity_damping);
    }
}

TEST_CASE("saved states are the same for any number of threads and can be resumed with another") {
    Model model = make_running_bond(wood(), 8, 12, 9);
    model.ground.motion.shift[0] = velocity_step(1.0);
    const double step = 0.8 * compute_critical_time_step(model);
    Simulation two(model, step, 2);
    two.advance(60);
    const std::string state = save(two);
    two.advance(50);
    for (const int threads : {1, 3}) {
        CAPTURE(threads);
        Simulation s = restore(model, state, threads);
        CHECK(s.threads() == threads);
        s.advance(50);
        CHECK(save(s) == save(two));
    }
    INFO("bytes per block: " << state.size() / model.blocks.size());
    CHECK(static_cast<double>(state.size()) < 4096.0 * static_cast<double>(model.blocks.size()));
}

TEST_CASE("time at rest that was being passed over is passed over after a restore, too") {
    Model model = make_resting_column(wood(), 3);
    model.numerics.skip_rest = true;
    model.ground.motion.shift[0] = {0.2, 1e-3, {0.0, 0.1, 0.1}};
    const double step = 0.5 * compute_critical_time_step(model);
    Simulation whole(model, step);
    advance_to(whole, 0.15);
    REQUIRE(whole.statistics().skipped > 0);
    Simulation resumed = restore(model, save(whole));
    whole.advance(static_cast<std::uint64_t>(0.1 / step));
    resumed.advance(static_cast<std::uint64_t>(0.1 / step));
    CHECK(save(resumed) == save(whole));
}

TEST_CASE("a diverged run stays diverged") {
    const Model model = make_loose_pile(wood(), 2, 1);
    Simulation s(model, 20.0 * compute_critical_time_step(model));
    s.advance(20000);
    REQUIRE(s.divergence().has_value());
    Simulation resumed = restore(model, save(s));
    REQUIRE(resumed.divergence().has_value());
    CHECK(resumed.divergence()->kind == s.divergence()->kind);
    CHECK(resumed.divergence()->time == s.divergence()->time);
    const double time = resumed.time();
    resumed.advance(10);
    CHECK(resumed.time() == time);
}

TEST_CASE("a state leaves the rest of its stream alone") {
    const Model model = make_resting_column(wood(), 2);
    const Simulation s(model, 1e-6);
    std::stringstream stream;
    s.save(stream);
    stream << "what follows";
    CHECK(Simulation::restore(model, stream).state_hash() == s.state_hash());
    std::string rest;
    std::getline(stream, rest);
    CHECK(rest == "what follows");
}

TEST_CASE("a state of another model is refused, down to the last bit of any number") {
    Model model = make_running_bond(wood(), 1, 2, 2);
    model.ground.motion.shift[0] = velocity_step(1.0);
    Simulation s(model, 1e-6);
    s.advance(10);
    const std::string state = save(s);
    CHECK(refusal(model, state).empty());
    const auto up = [](double& value) { value = std::nextafter(value, 1e300); };
    const std::function<void(Model&)> changes[] = {
        [&](Model& m) { up(m.blocks[1].mass); },
        [&](Model& m) { up(m.blocks[1].velocity.y()); },
        [&](Model& m) { m.blocks[0].fixed = true; },
        [&](Model& m) { m.blocks[0].rotation_locked = true; },
        [&](Model& m) { m.blocks.pop_back(); },
        [&](Model& m) { up(m.materials[0].friction); },
        [&](Model& m) { up(m.ground.material.restitution); },
        [&](Model& m) {
            m.pairs.push_back({0, {}, m.ground.material});
        },
        [&](Model& m) { m.ground.present = false; },
        [&](Model& m) { up(m.ground.motion.shift[0].velocity[0]); },
        [&](Model& m) { up(m.ground.motion.shift[1].start); },
        [&](Model& m) { up(m.gravity.x()); },
        [&](Model& m) { m.numerics.contact_nodes = ContactNodes::both; },
        [&](Model& m) { m.numerics.face_contact = FaceContact::nodes; },
        [&](Model& m) { m.numerics.skip_rest = !m.numerics.skip_rest; },
        [&](Model& m) { m.numerics.skip_apart = !m.numerics.skip_apart; },
        [&](Model& m) { m.velocity_damping = 1e-300; },
        [&](Model& m) { up(m.shapes[1].nodes.half_z.back()); },
        [&](Model& m) { up(m.shapes[0].node_spacing.x()); },
        [&](Model& m) { m.shapes[0] = make_grid_box_shape(wood().size, make_node_lattice(wood().size, 44), 0.002); },
    };
    for (std::size_t i = 0; i < std::size(changes); ++i) {
        Model other = model;
        changes[i](other);
        CHECK_MESSAGE(refusal(other, state).find("another model") != std::string::npos, "change ", i);
    }
}

TEST_CASE("a state that is cut off or has one byte changed is refused in words") {
    const Model model = make_loose_pile(wood(), 1, 2);
    Simulation s(model, 0.5 * compute_critical_time_step(model));
    s.advance(3000);
    const std::string state = save(s);
    std::mt19937 random(5);
    // every byte of head and seal, and one in seventeen between
    for (std::size_t at = 0; at < state.size(); at += at < 64 || at + 32 > state.size() ? 1 : 17) {
        std::string damaged = state;
        damaged[at] = static_cast<char>(damaged[at] ^ static_cast<char>(1U << (random() % 8U)));
        CHECK_MESSAGE(refusal(model, damaged).starts_with("saved state: "), "byte ", at);
        CHECK_MESSAGE(refusal(model, state.substr(0, at)).find("cut off") != std::string::npos, "cut at ", at);
    }
    CHECK(refusal(model, "").find("cut off") != std::string::npos);
    CHECK(refusal(model, std::string(4096, 'x')).find("something else") != std::string::npos);
}

// With a checksum that fits, the checks of the reader itself are all there is. Sizes and places are wrong at random here; under the address
// sanitizer this also shows that none is believed.
TEST_CASE("contents that contradict themselves are refused, whatever their checksum says" * doctest::test_suite("one-thread")) {
    Model model = make_running_bond(wood(), 1, 2, 2);
    for (const FaceContact faces : {FaceContact::overlap, FaceContact::nodes}) {
        model.numerics.face_contact = faces;
        Simulation s(model, 0.5 * compute_critical_time_step(model));
        s.advance(50);
        std::istringstream in(save(s));
        const std::string contents = read_sealed(in, kStateKind);
        const auto sealed = [](const std::string& bytes) {
            std::ostringstream out;
            write_sealed(out, kStateKind, bytes);
            return out.str();
        };
        REQUIRE(refusal(model, sealed(contents)).empty());
        CHECK(refusal(model, sealed(contents + "x")).find("more than it should") != std::string::npos);
        std::mt19937 random(6);
        std::size_t refused = 0;
        for (int trial = 0; trial < 2000; ++trial) {
            std::string wrong = contents;
            wrong[random() % wrong.size()] = static_cast<char>(random());
            refused += refusal(model, sealed(wrong)).empty() ? 0 : 1;
            wrong.resize(random() % wrong.size());
            CHECK_FALSE(refusal(model, sealed(wrong)).empty());
        }
        // most bytes are digits of doubles, which nobody can distinguish from right ones
        CHECK(refused > 10);
    }
}
