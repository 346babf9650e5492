#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "lsdem/motion/simulation.hpp"
#include "lsdem/time_step.hpp"
#include "tests/support/heaps.hpp"
#include "tests/support/models.hpp"
#include "tests/support/motion.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

/// Scale factors of an exact model, all of them powers of two [FengOwen14].
struct ExactScale {
    double length, time, density, gravity;

    double velocity() const { return length / time; }
};

/// The similar twin of a model; multiplies and divides only.
Model scale_model(const Model& model, const Stone& stone, const ExactScale& scale) {
    Model twin = model;
    Stone small = stone;
    small.size *= scale.length;
    twin.shapes[0] = make_box_shape(small.size, make_node_lattice(small.size, small.nodes_per_face));
    twin.shapes[1] = make_half_shape(small);
    const double stiffness_per_area = scale.density * scale.gravity;
    for (Material* material : {&twin.materials[0], &twin.ground.material}) {
        material->normal_stiffness *= stiffness_per_area;
        material->shear_stiffness *= stiffness_per_area;
    }
    twin.gravity *= scale.gravity;
    twin.velocity_damping /= scale.time;
    for (Block& block : twin.blocks) {
        block.mass *= scale.density * scale.length * scale.length * scale.length;
        block.position *= scale.length;
        block.height_offset *= scale.length;
        block.velocity *= scale.velocity();
        block.angular_velocity /= scale.time;
    }
    for (BaseComponent& component : twin.ground.motion.shift) {
        component.dt *= scale.time;
        for (double& v : component.velocity) v *= scale.velocity();
    }
    return twin;
}

/// A short wall under strong shaking in three directions: slip, rocking, impacts and new contacts.
Model make_shaken_wall(const Stone& stone) {
    Model model = make_running_bond(stone, 2, 3, 4);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double omega = 60.0 + 25.0 * static_cast<double>(axis);
        model.ground.motion.shift[axis] = sample_velocity(0.25, 250, [=](double t) { return 0.15 * std::sin(omega * t); });
    }
    return model;
}

/// Number of blocks whose state differs by a bit from the other's, scaled back.
std::size_t count_differences(const Simulation& model, const Simulation& prototype, const ExactScale& scale) {
    std::size_t different = 0;
    for (std::size_t i = 0; i < prototype.model().blocks.size(); ++i) {
        const bool same = model.position(i) / scale.length == prototype.position(i) &&
                          model.orientation(i).coeffs() == prototype.orientation(i).coeffs() &&
                          model.velocity(i) / scale.velocity() == prototype.velocity(i) &&
                          model.angular_velocity(i) * scale.time == prototype.angular_velocity(i);
        different += same ? 0 : 1;
    }
    return different;
}

}  // namespace

// [FengOwen14]: with scale factors that are powers of two every product of the computation scales exactly, unless an absolute tolerance
// hides somewhere. Time: sqrt(λ_l/λ_g).
TEST_CASE("a model at one sixteenth or one sixty-fourth of the size repeats the prototype to the last bit") {
    const Stone stone = wood();
    const Model prototype = make_shaken_wall(stone);
    const double step = 0.8 * compute_critical_time_step(prototype);
    for (const ExactScale& scale : {ExactScale{1.0 / 16.0, 0.25, 1.0, 1.0}, ExactScale{1.0 / 64.0, 0.0625, 4.0, 4.0}}) {
        CAPTURE(scale.length);
        Simulation large(prototype, step), small(scale_model(prototype, stone, scale), step * scale.time);
        for (int sample = 0; sample < 20; ++sample) {
            large.advance(1000);
            small.advance(1000);
            CHECK(count_differences(small, large, scale) == 0);
        }
        REQUIRE(large.energy().friction_loss > 0.0);
        REQUIRE(large.statistics().rebuilds > 1);
        const double moved = (large.position(0) - large.base().displacement - prototype.blocks[0].position).norm();
        REQUIRE(moved > 1e-3 * stone.size.z());
    }
}

TEST_CASE("blocks of unequal height repeat their prototype to the last bit, by their overlap and by nodes") {
    const Stone stone = wood();
    const ExactScale scale{1.0 / 16.0, 0.25, 1.0, 1.0};
    for (const FaceContact faces : {FaceContact::overlap, FaceContact::nodes}) {
        Model prototype = shortened(make_shaken_wall(stone), 0.01);
        prototype.numerics.face_contact = faces;
        const double step = 0.8 * compute_critical_time_step(prototype);
        Simulation large(prototype, step), small(scale_model(prototype, stone, scale), step * scale.time);
        large.advance(5000);
        small.advance(5000);
        CHECK(count_differences(small, large, scale) == 0);
        REQUIRE(large.energy().friction_loss > 0.0);
        CHECK(compute_critical_time_step(small.model()) == compute_critical_time_step(prototype) * scale.time);
    }
}

TEST_CASE("preparation damping at a rate that scales as 1/time repeats the prototype to the last bit, too") {
    const Stone stone = wood();
    Model prototype = make_shaken_wall(stone);
    prototype.velocity_damping = 192.0;
    const double step = 0.8 * compute_critical_time_step(prototype);
    const ExactScale scale{1.0 / 16.0, 0.25, 1.0, 1.0};
    Simulation large(prototype, step), small(scale_model(prototype, stone, scale), step * scale.time);
    for (int sample = 0; sample < 4; ++sample) {
        large.advance(1000);
        small.advance(1000);
        CHECK(count_differences(small, large, scale) == 0);
    }
    REQUIRE(large.energy().preparation_loss > 0.0);
    // λ_E = λ_l⁴ for λ_ρ = λ_g = 1
    CHECK(small.energy().preparation_loss * 65536.0 == large.energy().preparation_loss);
}

// Density with stiffness in proportion: forces scale, motion does not.
TEST_CASE("a denser stone with stiffness in proportion moves the same") {
    const Stone stone = wood();
    const Model light = make_shaken_wall(stone);
    const double step = 0.8 * compute_critical_time_step(light);
    const ExactScale scale{1.0, 1.0, 4.0, 1.0};
    Simulation a(light, step), b(scale_model(light, stone, scale), step);
    a.advance(10000);
    b.advance(10000);
    CHECK(count_differences(b, a, scale) == 0);

    // with a factor that is no power of two the motions agree to rounding, until chaos has made something of it
    const ExactScale odd{1.0, 1.0, 2.9, 1.0};
    Simulation c(light, step), d(scale_model(light, stone, odd), step);
    c.advance(1000);
    d.advance(1000);
    for (std::size_t i = 0; i < light.blocks.size(); ++i) CHECK((c.position(i) - d.position(i)).norm() < 1e-9 * stone.size.z());
}

namespace {

/// A column that cannot rotate, slid by half-sine pulses; λ_μ = `friction` scales μ and the base acceleration, time by its inverse root.
struct FrictionTwin {
    Simulation simulation;
    double time_factor;
};

FrictionTwin make_friction_twin(double friction_factor, bool rotation_locked) {
    Stone stone = wood();
    stone.friction *= friction_factor;
    stone.shear_stiffness *= friction_factor;
    const double time_factor = 1.0 / std::sqrt(friction_factor);
    Model model = make_resting_column(stone, 3, rotation_locked);
    model.ground.motion.shift[0] = half_sine(1.5 * 0.63 * friction_factor * kGravity, 0.02 * time_factor);
    return {Simulation(model, 2e-6 * time_factor), time_factor};
}

}  // namespace

// μ law: λ_a = λ_μ, λ_t = λ_μ^(-1/2), shear stiffness by λ_μ: exact while normal forces are the weights.
TEST_CASE("friction scaling is exact for a column that only slides and distorted for one that rocks") {
    for (const bool locked : {true, false}) {
        FrictionTwin prototype = make_friction_twin(1.0, locked), model = make_friction_twin(0.25, locked);
        prototype.simulation.advance(15000);
        model.simulation.advance(15000);
        double difference = 0.0, slip = 0.0;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto relative = [&](const FrictionTwin& t) {
                return t.simulation.position(i).x() - t.simulation.base().displacement.x();
            };
            difference = std::max(difference, std::abs(relative(prototype) - relative(model)));
            slip = std::max(slip, std::abs(relative(prototype)));
        }
        REQUIRE(slip > 1e-4 * wood().size.z());
        // sliding: all that differs is how the first instants of sticking ring, within the elastic offset of the base joint
        const double offset = 3.0 * wood().friction * wood().weight() / wood().shear_stiffness;
        if (locked) CHECK(difference < offset);
        if (!locked) CHECK(difference > 1e-2 * slip);
    }
}
