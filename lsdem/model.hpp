#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "lsdem/joint_scatter.hpp"
#include "lsdem/loads.hpp"
#include "lsdem/shape.hpp"
#include "lsdem/types.hpp"

namespace musim::lsdem {

/// Contact properties of one side of an interface, or of both together: see combine() in contact_law.hpp.
struct Material {
    double normal_stiffness = 0.0;     ///< K_n = k_n/A_face [Pa/m]
    double shear_stiffness = 0.0;      ///< K_s = k_s/A_face [Pa/m]
    double friction = 0.0;             ///< Coulomb coefficient μ [-]
    double restitution = 0.0;          ///< normal coefficient of restitution e, in (0, 1] [-]
    double shear_damping_ratio = 0.0;  ///< ζ_s of the optional tangential dashpot, 0 in the papers [-]
};

/// One rigid block. The body frame has its origin in the centre of mass and its axes along the principal axes of inertia.
///
/// A box may be taller than its shape, or shorter, by `height_offset`: its top face is moved, and the centre of mass with it by half, so
/// that in its body frame it reaches from −(H + Δ)/2 to (H + Δ)/2. Mass is given; inertia and contact follow the own height.
struct Block {
    std::size_t shape = 0;                            ///< index into Model::shapes
    std::size_t material = 0;                         ///< index into Model::materials
    double mass = 0.0;                                ///< [kg]
    double height_offset = 0.0;                       ///< Δ: how much taller than its shape along body z, the top face moved [m]
    Vector3 position = Vector3::Zero();               ///< centre of mass, world frame [m]
    Quaternion orientation = Quaternion::Identity();  ///< body to world
    Vector3 velocity = Vector3::Zero();               ///< of the centre of mass, world frame [m/s]
    Vector3 angular_velocity = Vector3::Zero();       ///< world frame [rad/s]
    bool fixed = false;                               ///< held in place: takes forces, does not move
    bool rotation_locked = false;                     ///< translates only; for wave-speed calibration and rigid-plastic limits
    bool with_base = false;                           ///< of a fixed one: it moves as the base does instead
};

/// Joint of blocks of two materials, or of one with the ground, where it does not follow from the two by combine().
struct MaterialPair {
    std::size_t first = 0;              ///< index into Model::materials
    std::optional<std::size_t> second;  ///< another one; nothing: the ground
    Material joint;                     ///< of both sides together

    bool is_of(std::size_t a, const std::optional<std::size_t>& b) const {
        return (first == a && second == b) || (first == b && second == a);
    }
};

/// Source of a component of the base's motion; for results, the kernel does not use it. A record has samples at the times of the
/// component's, a formula a peak.
struct MotionSource {
    std::vector<double> velocity;      ///< of the record, before it was filtered and brought to rest [m/s]; empty: of no record
    std::vector<double> acceleration;  ///< likewise [m/s²]; empty: the record has none
    double peak_acceleration = 0.0;    ///< PGA of the formula [m/s²]; 0: none, or not known
};

/// Prescribed velocity of the base along one world axis, or rate of its turn about one: samples v_k at t_k = start + k·dt, linear in
/// between, so that the acceleration is stepwise constant and the displacement, its exact integral, is piecewise quadratic. Zero before
/// `start`; the last sample holds after the end. A first sample that is not zero is a step in velocity.
struct BaseComponent {
    double start = 0.0;            ///< t_0 [s]
    double dt = 0.0;               ///< [s]; irrelevant with fewer than two samples
    std::vector<double> velocity;  ///< v_k [m/s or rad/s]; empty: no motion along this axis, or about it
    MotionSource source = {};
};

/// Prescribed motion of the ground: its point `pivot` is displaced by d(t), the integral of `shift`, while the ground is turned by the
/// rotation vector θ(t), the integral of `turn`, about the world's axes: a point that was at x when the motion began is at
///   pivot + d + exp[θ×] (x − pivot).
struct BaseComponents {
    std::array<BaseComponent, 3> shift = {};  ///< along x, y, z [m/s]
    std::array<BaseComponent, 3> turn = {};   ///< about x, y, z [rad/s]
    Vector3 pivot = Vector3::Zero();          ///< in the frame of the ground, whose origin is in the plane that carries the structure [m]

    /// Components of both, one after the other.
    std::array<BaseComponent, 6> all() const { return {shift[0], shift[1], shift[2], turn[0], turn[1], turn[2]}; }
    bool turns() const {
        return std::any_of(turn.begin(), turn.end(), [](const BaseComponent& about) { return !about.velocity.empty(); });
    }
};

/// The plane z = 0 that carries the structure and moves with the base.
struct Ground {
    bool present = true;
    Material material;
    BaseComponents motion;
};

/// Which nodes probe a pair of blocks.
enum class ContactNodes {
    leader,  ///< those of the leader (the lower block), as in [Harmon23]
    both     ///< those of both blocks, each side with half the stiffness per area
};

/// Contact of boxes with each other and with the ground.
enum class FaceContact {
    overlap,  ///< springs that store half of K_n times the integral of both depths over the overlap: see docs/theory/overlap_contact.md
    nodes     ///< the leader's surface nodes against the follower, as spheres and grids; a reference
};

/// Force that the friction of a contact holds at the start; what it presses with follows from the poses alone.
struct Preload {
    std::size_t leader = 0;               ///< leads the contact, whichever block is lower
    std::optional<std::size_t> follower;  ///< nothing: the ground
    Vector3 friction = Vector3::Zero();   ///< on the leader, world frame [N]; beyond the Coulomb limit the contact slides at once
    double couple = 0.0;                  ///< against turning about the normal force, on the leader, along that on it [N·m]

    bool is_finite() const { return friction.allFinite() && std::isfinite(couple); }
    bool operator==(const Preload&) const = default;
};

/// Choices by which a model is computed.
struct Numerics {
    FaceContact face_contact = FaceContact::overlap;
    ContactNodes contact_nodes = ContactNodes::leader;
    bool skip_rest = true;   ///< pass over time in which the base stands and nothing moves
    bool skip_apart = true;  ///< pass over pairs that cannot have met since they were found apart; same results
};

/// Everything that defines a simulation, apart from its time step: what there is, and how it is computed.
struct Model {
    std::vector<Shape> shapes;
    std::vector<Material> materials;
    std::vector<MaterialPair> pairs;  ///< of materials; those that are not in it follow from the two
    JointScatter scatter;             ///< of single joints about those of their materials
    std::vector<Block> blocks;
    Ground ground;
    Vector3 gravity = Vector3::Zero();  ///< world frame [m/s²]
    std::vector<Load> loads;            ///< beside the weight, from the start of a run on; not while it comes to rest before
    /// Friction of blocks that stand already; nothing of contacts that are not named. Contacts by nodes don't take it.
    std::vector<Preload> preload;
    /// Rate α at which velocities and spins decay towards rest, dv/dt = F/m − α·v [1/s]; only for preparing a specimen while the base
    /// stands. The velocity damping of [Harmon23, eq. 12], v ← (1 − c_v)·v in each step, is α = −ln(1 − c_v)/dt. See
    /// docs/theory/preparation.md.
    double velocity_damping = 0.0;
    Numerics numerics;
};

/// Does a block meet the ground, and others of its kind, by their overlap?
inline bool meets_by_overlap(const Model& model, const Block& block) {
    const Shape& shape = model.shapes[block.shape];
    if (shape.solid != nullptr) return true;
    return model.numerics.face_contact == FaceContact::overlap && shape.faceted && std::holds_alternative<BoxLevelSet>(shape.level_set);
}

}  // namespace musim::lsdem
