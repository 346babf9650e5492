#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "lsdem/solid/solid.hpp"
#include "lsdem/types.hpp"

/// Solids as seen from afar: their faces in the picture, which of them are hidden, and in which order to draw.
namespace musim::lsdem {

/// From where solids are looked at, without perspective: three directions of unit length in the world frame, at right angles.
struct SpaceView {
    Vector3 right = Vector3::UnitX();    ///< to the right in the picture
    Vector3 up = Vector3::UnitZ();       ///< upward in the picture
    Vector3 toward = -Vector3::UnitY();  ///< toward the eye

    /// A point or direction of the world in the picture's axes: right, up, toward.
    Vector3 operator*(const Vector3& world) const { return {world.dot(right), world.dot(up), world.dot(toward)}; }
};

/// The eye stands above the horizontal by `lift` [rad], turned about the vertical by `turn`, from the side of −y toward +x [rad].
SpaceView look_from(double turn, double lift);

/// View of previews: x runs to the right and toward the eye, y to the right and away, z upward.
SpaceView look_from_corner();

/// The rectangle of a picture that something takes, in metres along right and up.
struct ViewBounds {
    double left = 0.0, right = 0.0, bottom = 0.0, top = 0.0;

    double width() const { return right - left; }
    double height() const { return top - bottom; }
};

/// The rectangle around two others.
ViewBounds unite(const ViewBounds& a, const ViewBounds& b);

/// Bounds of a placed solid.
ViewBounds find_bounds(const Solid& solid, const Placing& place, const SpaceView& view);

/// Where a view stands in a picture: one metre is `scale` px, the view's origin at (x, y) [px].
struct ViewPlace {
    double x = 0.0, y = 0.0, scale = 1.0;
};

/// A corner as "x,y" for the attribute `points`.
std::string write_point(const Vector3& world, const SpaceView& view, const ViewPlace& place);

/// An outer face of a solid that looks at the eye.
struct SeenFace {
    std::size_t body = 0;               ///< number of the solid
    std::size_t piece = 0;              ///< number of its convex piece, see list_pieces
    std::size_t face = 0;               ///< in the piece
    Vector3 normal = Vector3::UnitZ();  ///< world frame
    std::vector<Vector3> corners = {};  ///< in the picture's axes [m], counter-clockwise
};

/// A convex piece of a solid in the picture's axes.
struct SeenPiece {
    std::size_t body = 0;                       ///< number of the solid
    const Polyhedron* piece = nullptr;          ///< in the frame of the body
    std::vector<Vector3> corners = {};          ///< [m]
    std::vector<Plane> planes = {};             ///< of its faces
    std::vector<Eigen::Vector2d> outline = {};  ///< counter-clockwise [m]
    ViewBounds bounds = {};
};

/// A solid and where it is.
struct PlacedSolid {
    const Solid* solid = nullptr;
    Placing place;
};

/// Pieces of all solids, one solid after another.
std::vector<SeenPiece> list_pieces(const std::vector<PlacedSolid>& solids, const SpaceView& view);

/// Edges in which outer faces of a piece that look at the eye end, as two corners each, in the picture's axes [m]. `drawn`: those of its
/// edges that are lines, see SolidEdges.
std::vector<std::array<Vector3, 2>> find_silhouette(const SeenPiece& piece, const std::vector<std::vector<bool>>& drawn);

/// Outer faces of all solids that look at the eye, piece by piece.
std::vector<SeenFace> list_faces(const std::vector<PlacedSolid>& solids, const SpaceView& view);

/// Outline of points in a picture: their convex hull, counter-clockwise [monotone chain].
std::vector<Eigen::Vector2d> find_outline(std::vector<Eigen::Vector2d> points);

/// Points in rows from the lower left one, an even distance apart.
struct PointGrid {
    double left = 0.0, bottom = 0.0;  ///< the first point, along right and up [m]
    double spacing = 1.0;             ///< [m]
    std::size_t columns = 0, rows = 0;
};

inline constexpr std::size_t kNoFace = std::numeric_limits<std::size_t>::max();

/// Number of the face that is nearest to the eye at each point of a grid, row by row; kNoFace where there is none. Points on an edge belong
/// to its faces.
std::vector<std::size_t> find_nearest_faces(const std::vector<SeenFace>& faces, const PointGrid& grid);

/// A piece to draw.
struct DrawnPart {
    std::size_t piece = 0;
    std::vector<Eigen::Vector2d> within = {};  ///< only the part of it in this convex polygon, counter-clockwise; empty: the whole
};

/// The given pieces in an order in which later ones are drawn over earlier ones. Of two convex pieces that do not overlap one is nearer to
/// the eye wherever both are seen: it follows. Where pieces hide each other in a ring, the farthest begins, and the part of it that hides
/// the piece that should have been before it is drawn again. Pieces that overlap may hide each other in parts wrongly.
std::vector<DrawnPart> sort_by_depth(const std::vector<SeenPiece>& pieces, std::vector<std::size_t> some);

}  // namespace musim::lsdem
