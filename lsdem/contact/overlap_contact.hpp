#pragma once

#include <array>
#include <cstdint>

#include "lsdem/contact/contact_area.hpp"
#include "lsdem/contact/overlap.hpp"
#include "lsdem/contact_law.hpp"
#include "lsdem/losses.hpp"
#include "lsdem/types.hpp"

/// The contact of two convex bodies: springs of their overlap, dashpots and friction; see docs/theory/overlap_contact.md.
namespace musim::lsdem {

/// Where two bodies are and were, about the origin of the pair. World axes.
struct PairMotion {
    std::array<Vector3, 2> center{Vector3::Zero(), Vector3::Zero()};           ///< centres of mass now [m]
    std::array<Vector3, 2> previous_center{Vector3::Zero(), Vector3::Zero()};  ///< and one step ago, about the origin of that time [m]
    Vector3 shift = Vector3::Zero();                                           ///< of the second centre against the first over the step [m]
    std::array<Quaternion, 2> turn{Quaternion::Identity(), Quaternion::Identity()};  ///< of each body over the step
};

/// A force on the second body at a point, with a couple.
struct PlacedWrench {
    Vector3 force = Vector3::Zero(), couple = Vector3::Zero();  ///< [N], [N·m]
};

/// Springs of friction over an area that comes and goes: a core that has always borne, and the rest, which came since or comes and goes.
/// `Value`: a force across the normal over an area [m²], or a couple along the direction in which the second body is pushed over the second
/// moment of that [m⁴].
template <class Value>
struct FrictionSprings {
    double area = 0.0, core = 0.0;  ///< [m² or m⁴]
    Value in_core, in_rest;         ///< [N or N·m]

    Value total() const { return in_core + in_rest; }
};

/// What a contact remembers from one step to the next. World axes; friction acts on the second body.
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
    Vector3 place = Vector3::Zero();   ///< middle of the area, about the origin of that time [m]
    Vector3 couple = Vector3::Zero();  ///< of the springs of friction [N·m]
    PlacedWrench dashpots;             ///< normal and tangential
};

/// What a contact does in a step.
struct OverlapForces {
    Vector3 force = Vector3::Zero();   ///< on the second body [N]
    Vector3 moment = Vector3::Zero();  ///< on the second body about the origin of the pair [N·m]
    double elastic_normal = 0.0;       ///< stored now, but for a part overlap/size of it [J]
    double elastic_shear = 0.0;        ///< stored now [J]
    double overlap = 0.0;              ///< largest depth [m]
    double area = 0.0;                 ///< of faces inside the other body: stiffness over K is no larger [m²]
    PairWork work;                     ///< dissipated over the step [J]
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

/// Both bodies of a pair, cut into pieces when these are first asked for. Refers to what it is made from, and to room for the pieces.
class OverlapBodies {
  public:
    struct Box {
        const Vector3& half;      ///< extents [m]
        const Matrix3& rotation;  ///< body to world
        Vector3 center;           ///< about the origin of the pair [m]
    };
    OverlapBodies(const Box& a, const Box& b, OverlapPieces& room)
        : half_{&a.half, &b.half}, rotation_{&a.rotation, &b.rotation}, center_{a.center, b.center}, pieces_(&room) {}
    /// A box and the ground at a height about the origin of the pair [m].
    OverlapBodies(const Box& a, double ground, OverlapPieces& room)
        : half_{&a.half, nullptr}, rotation_{&a.rotation, nullptr}, center_{a.center}, ground_(ground), pieces_(&room) {}

    const OverlapPieces& pieces();
    double energy();  ///< see compute_overlap_energy [m⁴]

  private:
    void place(PlacedSolid& a, PlacedSolid& b) const;

    std::array<const Vector3*, 2> half_;
    std::array<const Matrix3*, 2> rotation_;
    std::array<Vector3, 2> center_;
    double ground_ = 0.0;
    bool is_cut_ = false;
    OverlapPieces* pieces_;
};

/// Contact of two bodies at step n from their overlap; updates what it remembers. `stored_shear`: energy of its springs of friction at step
/// n − 1 [J]. `first_step`: the step before is none, so nothing has slipped.
OverlapForces compute_overlap_contact(const OverlapGeometry& geometry, const PairMotion& motion, const Interface& law, double dt,
                                      bool first_step, double stored_shear, OverlapBodies& bodies, OverlapContact& contact);

}  // namespace musim::lsdem
