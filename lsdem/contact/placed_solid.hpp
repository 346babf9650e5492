#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lsdem/body_pose.hpp"
#include "lsdem/contact/polygon.hpp"
#include "lsdem/solid/solid.hpp"
#include "lsdem/types.hpp"

/// Solids where they stand, in world axes about an origin of the pair they belong to. Each keeps its memory, so that steps need none.
namespace musim::lsdem {
namespace detail {
struct BoxMeeting;
}

/// A convex piece of a solid, or a half space.
struct PlacedPiece {
    std::size_t face_count = 0, corner_count = 0;
    std::vector<Vector3> normal;  ///< of the faces, outward
    std::vector<double> offset;   ///< of their planes from the origin of the pair along the normal [m]
    detail::Points corner;
    const Polyhedron* form = nullptr;
    /// Planes that a point of the piece can be nearest to, each once, and which of them bound each whole, see Polyhedron::wholes: those of
    /// one whole behind those of another. Empty of a solid of one piece, where they are the planes of its faces.
    std::vector<Plane> nearest;
    std::vector<std::uint32_t> members;
    std::vector<std::size_t> whole_ends;  ///< into `members`
    detail::PlaneRows nearest_rows;       ///< nearest_plane of all

    /// Depth of a point below the plane of face k; negative outside [m].
    double depth(std::size_t k, const Vector3& x) const { return offset[k] - normal[k].dot(x); }
    /// Corners of a face, counter-clockwise seen from outside.
    std::span<const std::uint32_t> loop(std::size_t k) const { return form->loop(form->faces[k]); }
    bool is_outer(std::size_t k) const { return form->faces[k].outer; }
    bool is_alone() const { return nearest.empty(); }
    std::size_t nearest_count() const { return is_alone() ? face_count : nearest.size(); }
    Plane nearest_plane(std::size_t k) const { return is_alone() ? Plane{normal[k], offset[k]} : nearest[k]; }
    std::size_t whole_count() const { return is_alone() ? 1 : whole_ends.size(); }
    std::size_t whole_size(std::size_t whole) const {
        return is_alone() ? face_count : whole_ends[whole] - (whole == 0 ? 0 : whole_ends[whole - 1]);
    }
    /// Plane i of a whole, as a number for nearest_plane.
    std::uint32_t member(std::size_t whole, std::size_t i) const {
        return is_alone() ? static_cast<std::uint32_t>(i) : members[(whole == 0 ? 0 : whole_ends[whole - 1]) + i];
    }
};

/// All pieces of a solid.
struct PlacedSolid {
    std::size_t piece_count = 0;
    std::vector<PlacedPiece> piece;

    std::span<const PlacedPiece> pieces() const { return std::span(piece).first(piece_count); }
};

/// Places a solid by a rotation body to world, with its origin at `position` [m]; refers to `solid`.
void place(const Solid& solid, const Matrix3& rotation, const Vector3& position, PlacedSolid& placed);

/// Places a box of half extents `half` [m]: the solid of make_box_solid(2 half), to the last bit.
void place_box(const Vector3& half, const Matrix3& rotation, const Vector3& position, PlacedSolid& placed);

/// A half space with the outward normal rotation·(0, 0, 1), seen by a body about the origin no point of which is farther away than `reach`
/// [m]: of its face, the square about `foot` that holds all that the body can cover.
void place_half_space(const Matrix3& rotation, const Vector3& foot, double reach, PlacedSolid& placed);

/// Two bodies and what they are made of; a box has no solid.
struct MeetingSolids {
    const Solid *a = nullptr, *b = nullptr;
};

/// Two bodies, or a body and the ground, about the origin of the pair.
struct PlacedPair {
    PlacedSolid a, b;
    Vector3 apart = Vector3::Zero();  ///< from the first centre to the second [m]

    PlacedPair() = default;
    explicit PlacedPair(const detail::BoxMeeting& poses, const MeetingSolids& solids = {}) { place(poses, solids); }
    void place(const detail::BoxMeeting& poses, const MeetingSolids& solids);
};

}  // namespace musim::lsdem
