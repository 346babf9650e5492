#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "lsdem/contact/placed_solid.hpp"
#include "lsdem/contact/polygon.hpp"
#include "lsdem/types.hpp"

/// Convex polygons inside a solid, cut into cells over which one of its planes decides on the depth.
namespace musim::lsdem::detail {

/// Cuts polygons that lie inside a piece of a solid; keeps its memory.
class DepthCells {
  public:
    /// Calls visit(k, cell) for the cells of a polygon over which plane k of PlacedPiece::nearest_plane decides, see Polyhedron::wholes.
    template <class Visit>
    void visit(const Polygon& polygon, const PlacedPiece& piece, const Visit& visit) {
        for (std::size_t whole = 0; whole < piece.whole_count(); ++whole) {
            visit_nearest(polygon, piece, whole, 0, [&](std::uint32_t k, const Polygon& cell) {
                visit_deepest(piece, {whole, k}, 0, 1, cell, visit);
            });
        }
    }

    /// Calls visit(k, cell) for the cells of a polygon over which plane k is the nearest of one whole. `level`: of the memory to use; visit
    /// may use higher ones.
    template <class Visit>
    void visit_nearest(const Polygon& polygon, const PlacedPiece& piece, std::size_t whole, std::size_t level, const Visit& visit) {
        if (levels_.size() <= level) levels_.resize(level + 1);
        Level& room = levels_[level];
        if (piece.whole_size(whole) <= kFewPlanes) {
            find_candidates(polygon, piece, whole, room);
            for (const std::uint32_t k : room.candidates) {
                cut_cell(polygon, piece, k, room);
                if (room.cell.size() >= 3) visit(k, room.cell);
            }
        } else {
            find_neighbours(polygon, piece, whole, room);
            for (std::size_t i = 0; i < room.candidates.size(); ++i) {
                cut_nearer(piece, i, room);
                if (room.nearer[i].size() >= 3) visit(room.candidates[i], room.nearer[i]);
            }
        }
    }

  private:
    /// Among more planes those that are far below all of a polygon are left out at one point. Affects speed only.
    static constexpr std::size_t kFewPlanes = 8;

    struct Level {
        std::vector<std::uint32_t> candidates;
        std::vector<double> least, depth;
        std::deque<Polygon> nearer;  ///< parts in which the candidates are nearer than the first of them; of that all
        PlaneRows rows;              ///< of the candidates
        Polygon cell, deeper;
    };
    /// A plane of a whole.
    struct Chosen {
        std::size_t whole;
        std::uint32_t plane;
    };
    /// Planes of a whole that may be the nearest somewhere, by bounds.
    static void find_candidates(const Polygon& polygon, const PlacedPiece& piece, std::size_t whole, Level& room);
    /// The part of a polygon in which a candidate is the nearest of all.
    void cut_cell(const Polygon& polygon, const PlacedPiece& piece, std::uint32_t k, Level& room);

    /// The same of many planes. First of the candidates is one that is near in the middle, and the others those that are nearer somewhere.
    void find_neighbours(const Polygon& polygon, const PlacedPiece& piece, std::size_t whole, Level& room);
    /// Leaves of Level::nearer the part in which its candidate is the nearest of all.
    void cut_nearer(const PlacedPiece& piece, std::size_t candidate, Level& room);

    /// Visits the part of a cell, in which a plane is the nearest of its whole, in which no whole from `next` on is deeper.
    template <class Visit>
    void visit_deepest(const PlacedPiece& piece, const Chosen& chosen, std::size_t next, std::size_t level, const Polygon& cell,
                       const Visit& visit) {
        if (next == chosen.whole) ++next;
        if (next >= piece.whole_count()) return visit(chosen.plane, cell);
        const Affine own = depth_below(piece.nearest_plane(chosen.plane));
        visit_nearest(cell, piece, next, level, [&](std::uint32_t m, const Polygon& part) {
            if (m == chosen.plane) {
                // as deep: the first of both takes it
                if (chosen.whole < next) visit_deepest(piece, chosen, next + 1, level + 1, part, visit);
                return;
            }
            Polygon& shallower = levels_[level].deeper;
            shallower.copy(part);
            cutter_.clip(difference(own, depth_below(piece.nearest_plane(m))), chosen.whole < next, shallower);
            if (shallower.size() >= 3) visit_deepest(piece, chosen, next + 1, level + 1, shallower, visit);
        });
    }

    PolygonCutter cutter_;
    std::deque<Level> levels_;  // whose places stay when it grows
};

}  // namespace musim::lsdem::detail
