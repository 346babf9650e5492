#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>

#include "lsdem/model.hpp"
#include "lsdem/shape.hpp"
#include "lsdem/types.hpp"
#include "tests/support/faces.hpp"

namespace musim::lsdem::tests {

inline constexpr double kPi = std::numbers::pi;

/// Standard gravity as the closed forms use it [m/s²].
inline constexpr double kGravity = 9.81;

/// A kind of block: size, density and the properties of a whole face contact.
struct Stone {
    Vector3 size;                    ///< edge lengths b, w, H [m]
    double density = 0.0;            ///< [kg/m³]
    double normal_stiffness = 0.0;   ///< k_n of the face across z [N/m]
    double shear_stiffness = 0.0;    ///< k_s of the same face [N/m]
    double friction = 0.0;           ///< [-]
    double restitution = 0.0;        ///< [-]
    double shear_damping_ratio = 0;  ///< [-]
    int nodes_per_face = 44;

    double mass() const { return density * size.prod(); }
    double weight() const { return mass() * kGravity; }
    double face_area() const { return size.x() * size.y(); }
};

/// Wood at 1:107 with the measured height [Harmon23, Tables 2-4].
inline Stone wood() { return {{0.012710, 0.026355, 0.039780}, 800.0, 30e6, 26e6, 0.63, 0.3}; }

/// Concrete at 1:25 with the measured height [Harmon23, Tables 2-4].
inline Stone concrete() { return {{0.0544, 0.1128, 0.17053}, 2320.0, 1050e6, 1000e6, 0.59, 0.3}; }

/// The prototype block 1.36 x 2.82 x 4.25 m at a length scale, of wood: the block of the closed forms for sliding and rocking.
inline Stone reference_wood(double length_scale = 1.0 / 107.0) {
    Stone stone = wood();
    stone.size = length_scale * Vector3(1.36, 2.82, 4.25);
    return stone;
}

/// The same stone turned by 90° about the vertical: its wide side along x.
inline Stone turned(Stone stone) {
    stone.size = {stone.size.y(), stone.size.x(), stone.size.z()};
    return stone;
}

/// The same stone with both stiffnesses multiplied.
inline Stone stiffened(Stone stone, double factor) {
    stone.normal_stiffness *= factor;
    stone.shear_stiffness *= factor;
    return stone;
}

inline Material make_material(const Stone& stone) {
    return {stone.normal_stiffness / stone.face_area(), stone.shear_stiffness / stone.face_area(), stone.friction, stone.restitution,
            stone.shear_damping_ratio};
}

/// A model with one shape, one material, the ground of that material, gravity, and no blocks yet. Every step of it is computed.
inline Model make_model(const Stone& stone) {
    Model model;
    model.numerics.skip_rest = false;
    model.shapes.push_back(make_box_shape(stone.size, make_node_lattice(stone.size, stone.nodes_per_face)));
    model.materials.push_back(make_material(stone));
    model.ground.material = model.materials.front();
    model.gravity = {0.0, 0.0, -kGravity};
    return model;
}

inline Block make_block(const Stone& stone, const Vector3& position, const Quaternion& orientation = Quaternion::Identity()) {
    Block block;
    block.mass = stone.mass();
    block.position = position;
    block.orientation = orientation;
    return block;
}

/// A column of `count` upright blocks at rest under `gravity` [m/s²]: every joint is compressed by the weight above it, as boxes are that
/// meet by their overlap.
inline Model make_resting_column(const Stone& stone, std::size_t count, bool rotation_locked = false, double gravity = kGravity) {
    Model model = make_model(stone);
    model.gravity.z() = -gravity;
    double top = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const double load = static_cast<double>(count - i) * stone.mass() * gravity / stone.normal_stiffness;
        top -= flat_overlap(stone.size, load * stone.face_area(), i == 0 ? 1 : 2);
        Block block = make_block(stone, {0.0, 0.0, top + 0.5 * stone.size.z()});
        block.rotation_locked = rotation_locked;
        model.blocks.push_back(block);
        top += stone.size.z();
    }
    return model;
}

/// Turns a block so that it lies on its largest face: its height along world x, its thin side b along world z.
inline Quaternion lying() { return Quaternion(Eigen::AngleAxisd(0.5 * kPi, Vector3::UnitY())); }

/// One block that lies at rest on its largest face.
inline Model make_lying_block(const Stone& stone) {
    Model model = make_model(stone);
    const double stiffness = stone.normal_stiffness / stone.face_area() * stone.size.y() * stone.size.z();
    model.blocks.push_back(make_block(stone, {0.0, 0.0, 0.5 * stone.size.x() - stone.weight() / stiffness}, lying()));
    return model;
}

/// Gravity on a plane inclined by `angle` [rad], downhill along +x.
inline Vector3 tilted_gravity(double angle) { return kGravity * Vector3(std::sin(angle), 0.0, -std::cos(angle)); }

}  // namespace musim::lsdem::tests
