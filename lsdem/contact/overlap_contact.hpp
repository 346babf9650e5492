#pragma once

#include <cstdint>

#include "lsdem/contact/contact_area.hpp"
#include "lsdem/contact/overlap.hpp"
#include "lsdem/types.hpp"

/// The contact of two convex bodies: springs of their overlap, dashpots and friction; see docs/theory/overlap_contact.md.
namespace musim::lsdem {

/// Springs of friction over an area that comes and goes: a core that has always borne, and the rest, which came since or comes and goes.
/// `Value`: a force across the normal over an area [m²], or a couple along the direction in which the second body is pushed over the second
/// moment of that [m⁴].
template <class Value>
struct FrictionSprings {
    double area = 0.0, core = 0.0;  ///< [m² or m⁴]
    Value in_core, in_rest;         ///< [N or N·m]

    Value total() const { return in_core + in_rest; }
};

/// Memory of a contact from one step to the next: its slip, as the force of the springs of friction. World axes; friction acts on the
/// second body.
struct OverlapContact {
    bool touches = false;
    static constexpr std::size_t kCompanyBits = 24;
    /// Which pairs it is computed beside, those that asked for the same at the last step: from the highest bit on, whether it may slide,
    /// the edges of both main cells, eight bits each, whether its dashpots may pull or act early, both, whether corners count, and four
    /// bits, of which rims end on a side. Speed only: no bit of a result depends on it, and it is not saved.
    std::uint32_t company = 0;
    FrictionSprings<Vector3> sliding{.in_core = Vector3::Zero(), .in_rest = Vector3::Zero()};
    FrictionSprings<double> turning{.in_core = 0.0, .in_rest = 0.0};
    /// Least push of the normal springs since the contact began, raised so that it is no less than their push now over kForgottenGrowth
    /// [N].
    double lightest = 0.0;
    // what acted at the last step, for its work over the next
    Vector3 place = Vector3::Zero();                                            ///< middle of the area, about the origin of that time [m]
    Vector3 couple = Vector3::Zero();                                           ///< of the springs of friction [N·m]
    Vector3 dashpot_force = Vector3::Zero(), dashpot_couple = Vector3::Zero();  ///< of the dashpots, normal and tangential [N], [N·m]
};

/// The springs of a pair and the area over which its faces face each other.
struct OverlapGeometry {
    OverlapLoad load;
    ContactArea area;  ///< about `pressed()`

    bool touches() const { return load.force.squaredNorm() > 0.0; }
    /// Where the pressure acts: the point of the force's line nearest to the origin [m].
    Vector3 pressed() const { return load.force.cross(load.moment) / load.force.squaredNorm(); }
};
OverlapGeometry find_overlap_geometry(const OverlapPieces& pieces);

}  // namespace musim::lsdem
