#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "lsdem/solid/solid.hpp"

namespace musim::lsdem::detail {

/// A convex part of a compound, or a share of it that cuts have left.
struct Cell {
    /// Source of faces that a cut has made.
    static constexpr std::uint32_t kCut = std::numeric_limits<std::uint32_t>::max();

    Polyhedron body;
    std::vector<std::uint32_t> sources;  ///< of each face: the part's face that it is a share of, or `kCut`
    std::size_t part = 0;
};

/// A cell of a whole part: each face its own source.
Cell make_cell(const Polyhedron& part, std::size_t number);

/// Cells on the two sides of a plane. A side on which nothing lies farther from the plane than the tolerance has none.
struct CutCell {
    std::optional<Cell> below, above;
};
CutCell cut(const Cell& cell, const Plane& plane, double tolerance);

/// Shares of a cell below all planes, and outside one of them: of the first plane, what is below it outside the second, and so on.
struct CarvedCell {
    std::optional<Cell> inside;
    std::vector<Cell> outside;
};
CarvedCell carve(const Cell& cell, std::span<const Plane> planes, double tolerance);

/// Planes of the faces of a convex body.
std::vector<Plane> collect_planes(const Polyhedron& body);

/// The mean of a face's corners [m].
Vector3 find_middle(const Polyhedron& body, const Polyhedron::Face& face);

/// Convex hull of cells, if they fill it: no point of it lies farther from them than about the tolerance [m].
std::optional<Polyhedron> find_filled_hull(std::span<const Cell* const> cells, double tolerance);

}  // namespace musim::lsdem::detail
