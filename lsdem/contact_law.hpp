#pragma once

#include <optional>

#include "lsdem/model.hpp"

namespace musim::lsdem {

/// Damping ratio ζ = c/(2·sqrt(m_eff·k)) for which a linear spring-dashpot that never pulls gives the coefficient of restitution `e`:
///
///   e = exp(−2ζ·acos(ζ)/sqrt(1 − ζ²))          [SchwagerPoeschel07]; e = 0.3 ⇒ ζ = 0.497239
///
/// The textbook ζ = −ln e/sqrt(π² + ln² e) lets the dashpot pull at the end of the contact and would give 0.397 for e = 0.3.
/// Above ζ = 1 (e < e⁻²) the formula continues as exp(−2ζ·acosh(ζ)/sqrt(ζ² − 1)). Throws std::invalid_argument unless 0 < e ≤ 1.
double compute_damping_ratio(double restitution);

/// The inverse: coefficient of restitution of a damping ratio ζ ≥ 0.
double compute_restitution(double damping_ratio);

/// One interface, per unit area of contact. At a node with overlap d, outward follower normal n and displacement δ of the leader relative
/// to the follower over the last step:
///
///   pressure  σ = max(0, K_n·d − C_n·δ_n/dt)          shear traction  τ = −K_s·ξ − C_s·δ_t/dt,   |τ| ≤ μ·σ
///
/// with ξ the elastic part of the slip. Area enters only as a weight of the node, so that one law serves any node density.
struct Interface {
    double normal_stiffness = 0.0;  ///< K_n [Pa/m]
    double shear_stiffness = 0.0;   ///< K_s [Pa/m]
    double friction = 0.0;          ///< μ [-]
    double normal_damping = 0.0;    ///< C_n [Pa·s/m]
    double shear_damping = 0.0;     ///< C_s [Pa·s/m]

    bool operator==(const Interface&) const = default;
};

/// Both sides of an interface together. Stiffness per area: springs of half a block in series, 2ab/(a + b); friction, restitution: the
/// smaller; shear damping ratio: the larger.
Material combine(const Material& a, const Material& b);

/// Joint of a block of material `a` and one of material `b` (nothing: the ground): as Model::pairs has it, else combine().
Material find_joint(const Model& model, std::size_t a, const std::optional<std::size_t>& b);

/// Joint of block `a` and block `b` (nothing: the ground): that of their materials, with the friction that Model::scatter gives this one.
Material find_joint_of_blocks(const Model& model, std::size_t a, const std::optional<std::size_t>& b);

/// Interface of what both sides have together. Damping of a whole face, C·A_face = 2ζ·sqrt(m_eff·K·A_face). `effective_mass`
/// m_i·m_j/(m_i + m_j) [kg] (the block's own against the ground), `face_area` A_face [m²]: the smaller base of the two blocks, the block's
/// own on the ground.
Interface make_interface(const Material& joint, double effective_mass, double face_area);

/// The same law for a share of the stiffness, e.g. 1/2 for each side of a pair that is probed from both.
Interface scaled(const Interface& interface, double share);

}  // namespace musim::lsdem
