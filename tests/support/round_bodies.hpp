#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "lsdem/contact_law.hpp"
#include "lsdem/model.hpp"
#include "lsdem/shape.hpp"
#include "tests/support/models.hpp"

/// Round bodies on a foundation: a contact of stiffness K per area, wide enough to hold many nodes, is a bed of independent springs
/// (Winkler). A sphere pressed by d on a plane touches a cap of radius a = sqrt(2Rd) and presses with
///
///   F = ∫ K·δ dA = π R K d²,    with the dashpots  F = π R K [(d + τḋ)² − (τḋ)²] while sinking, π R K max(0, d + τḋ)² while rising,
///
/// τ = C/K: each spring pulls back to zero at its own time, never pulls. Two spheres: R → R₁R₂/(R₁ + R₂), m → m₁m₂/(m₁ + m₂).
/// Relative errors O(d/R).
namespace musim::lsdem::tests {

inline constexpr double kBallRadius = 0.01;     ///< R [m]
inline constexpr double kBallDensity = 2500.0;  ///< glass [kg/m³]

inline double ball_mass(double radius) { return kBallDensity * 4.0 / 3.0 * kPi * radius * radius * radius; }

/// Where the sphere of a trilinear level set really lies: between its nodes φ is too large by (h²/12)∇²φ = h²/(6R) in the mean, so that the
/// sphere is smaller by that; a cylinder, with one curvature along its grid, by half of it [m].
inline double sphere_shrinkage(double radius, double voxel) { return voxel * voxel / (6.0 * radius); }
inline double cylinder_shrinkage(double radius, double voxel) { return voxel * voxel / (12.0 * radius); }

/// Normal impact of a sphere on a bed of springs.
struct BedImpact {
    double mass = 0.0, radius = 0.0;        ///< effective ones [kg], [m]
    double stiffness = 0.0, damping = 0.0;  ///< K [Pa/m], C [Pa·s/m]
    double speed = 0.0;                     ///< [m/s]

    /// Largest overlap without dashpots: ½ m v² = π R K d³/3 [m].
    double depth() const { return std::cbrt(3.0 * mass * speed * speed / (2.0 * kPi * radius * stiffness)); }
    /// Duration without dashpots, 2∫dx/sqrt(1 − x³) = (2/3)·B(1/3, 1/2) = 2.804365 times d/v [s].
    double duration() const { return 2.804365 * depth() / speed; }
    /// Speed after over speed before, by integrating the law above (fourth-order Runge-Kutta, 8000 steps within d/v).
    double restitution() const;
};

inline double BedImpact::restitution() const {
    const double scale = kPi * radius * stiffness / mass, tau = damping / stiffness, h = depth() / speed / 8000.0;
    const auto acceleration = [&](double d, double w) {
        const double pressed = std::max(0.0, d + tau * w), over = std::max(0.0, tau * w);
        return d > 0.0 ? -scale * (pressed * pressed - over * over) : 0.0;
    };
    double d = 0.0, w = speed;
    do {
        const double a1 = acceleration(d, w), w2 = w + 0.5 * h * a1;
        const double a2 = acceleration(d + 0.5 * h * w, w2), w3 = w + 0.5 * h * a2;
        const double a3 = acceleration(d + 0.5 * h * w2, w3), w4 = w + h * a3;
        const double a4 = acceleration(d + h * w3, w4);
        d += h / 6.0 * (w + 2.0 * w2 + 2.0 * w3 + w4);
        w += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    } while (d > 0.0);
    return -w / speed;
}

/// A material with equal normal and shear stiffness per area [Pa/m].
inline Material make_ball_material(double stiffness, double friction, double restitution) {
    return {stiffness, stiffness, friction, restitution, 0.0};
}

/// A model without ground, of one material.
inline Model make_empty_model(const Material& material) {
    Model model;
    model.materials.push_back(material);
    model.ground.material = material;
    model.ground.present = false;
    return model;
}

inline std::size_t add_shape(Model& model, Shape shape) {
    model.shapes.push_back(std::move(shape));
    return model.shapes.size() - 1;
}

inline std::size_t add_block(Model& model, std::size_t shape, double mass, const Vector3& position,
                             const Quaternion& orientation = Quaternion::Identity()) {
    Block block;
    block.shape = shape;
    block.mass = mass;
    block.position = position;
    block.orientation = orientation;
    model.blocks.push_back(block);
    return model.blocks.size() - 1;
}

/// A held box, itself a grid, whose upper face is the rectangle [x0, x1] x [−w/2, w/2] at z = 0 with nodes every `spacing` or a little
/// less.
inline std::size_t add_plate(Model& model, double x0, double x1, double width, double spacing, double voxel) {
    const double thickness = 4.0 * voxel;
    const auto count = [&](double length) { return static_cast<int>(std::ceil(length / spacing)) + 1; };
    const NodeLattice lattice{count(x1 - x0), count(width), 2};
    const std::size_t shape = add_shape(model, make_grid_box_shape({x1 - x0, width, thickness}, lattice, voxel));
    const std::size_t plate = add_block(model, shape, 1.0, {0.5 * (x0 + x1), 0.0, -0.5 * thickness});
    model.blocks[plate].fixed = true;
    return plate;
}

/// A turn about no particular axis, so that no grid line lies along a contact.
inline Quaternion skew_orientation(double angle = 0.7) { return Quaternion(Eigen::AngleAxisd(angle, Vector3(1.0, 2.0, 3.0).normalized())); }

}  // namespace musim::lsdem::tests
