#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "lsdem/contact/overlap.hpp"

namespace musim::lsdem {
namespace {

using detail::Affine;
using detail::depth_below;
using detail::DepthCells;
using detail::difference;
using detail::Polygon;
using detail::PolygonCutter;

/// Depths below a plane [m].
struct DepthRange {
    double least = std::numeric_limits<double>::infinity(), most = -std::numeric_limits<double>::infinity();
};

/// Corners of an overlap, which lies within their hull.
class OverlapCorners {
  public:
    explicit OverlapCorners(const OverlapPieces& pieces) {
        for (const OverlapPieces::Piece& piece : pieces) {
            for (std::uint32_t i = 0; i < piece.count; ++i) places_.push_back(pieces.vertices(piece)[i].place);
        }
        for (const Vector3& place : places_) margin_ = std::max(margin_, 1e-9 * (place - places_.front()).norm());
    }

    /// Depths of the overlap below a plane, with a margin far above rounding and far below its size.
    DepthRange find_depths(const Plane& plane) const {
        DepthRange range;
        for (const Vector3& place : places_) {
            const double depth = plane.depth(place);
            range.least = std::min(range.least, depth);
            range.most = std::max(range.most, depth);
        }
        return {range.least - margin_, range.most + margin_};
    }

  private:
    std::vector<Vector3> places_;
    double margin_ = 0.0;  ///< [m]
};

/// Integrals over the borders of the cells into which the planes of a piece y cut what is inside another piece x.
class CellBorders {
  public:
    /// Sum over all sheets between two cells of y inside x [m⁴]: ∫ d² times |n_i − n_k|, where the depth takes the less deep of planes i,
    /// k; less that, where it takes the deeper.
    double integrate_sheets(const PlacedPiece& x, const PlacedPiece& y, const OverlapCorners& overlap) {
        find_near_planes(y, overlap);
        double sum = 0.0;
        for (std::size_t i = 0; i < near_.size(); ++i) {
            for (std::size_t k = i + 1; k < near_.size(); ++k) sum += integrate_sheet(x, y, near_[i], near_[k]);
        }
        return sum;
    }

    /// Sum over the faces of `of` that are no part of its solid's surface, inside `in`, of ∫ d² n·n_k [m⁴]: n outward, n_k of the plane of
    /// y that decides on the depth there; y is one of both.
    double integrate_inner_faces(const PlacedPiece& of, const PlacedPiece& in, const PlacedPiece& y) {
        double sum = 0.0;
        for (std::size_t f = 0; f < of.face_count; ++f) {
            if (of.is_outer(f)) continue;
            face_.clear();
            for (const std::uint32_t c : of.loop(f)) face_.push_back(of.corner[c]);
            for (std::size_t k = 0; k < in.face_count && !face_.empty(); ++k) {
                cutter_.clip({in.offset[k], -in.normal[k]}, false, face_);
            }
            if (face_.size() < 3) continue;
            cells_.visit(face_, y, [&](std::uint32_t k, const Polygon& cell) {
                const Plane plane = y.nearest_plane(k);
                sum -= of.normal[f].dot(plane.normal) * integrate(cell, of.normal[f], depth_below(plane));
            });
        }
        return sum;
    }

  private:
    /// Planes of y that may decide on the depth somewhere in the overlap: those below which it has points no deeper than it can be in y,
    /// and in a whole of y it is no deeper than below any one plane of that.
    void find_near_planes(const PlacedPiece& y, const OverlapCorners& overlap) {
        depths_.clear();
        for (std::uint32_t k = 0; k < y.nearest_count(); ++k) depths_.push_back(overlap.find_depths(y.nearest_plane(k)));
        double deepest = 0.0;
        for (std::size_t whole = 0; whole < y.whole_count(); ++whole) {
            double most = std::numeric_limits<double>::infinity();
            for (std::size_t m = 0; m < y.whole_size(whole); ++m) most = std::min(most, depths_[y.member(whole, m)].most);
            deepest = std::max(deepest, most);
        }
        near_.clear();
        for (std::uint32_t k = 0; k < y.nearest_count(); ++k) {
            if (depths_[k].least <= deepest) near_.push_back(k);
        }
    }

    double integrate(const Polygon& polygon, const Vector3& normal, const Affine& depth) {
        vertices_.clear();
        for (std::size_t i = 0; i < polygon.size(); ++i) vertices_.push_back({polygon[i], depth(polygon[i])});
        return integrate_square(vertices_.size(), normal, vertices_.data());
    }

    double integrate_sheet(const PlacedPiece& x, const PlacedPiece& y, std::uint32_t i, std::uint32_t k) {
        const Affine own = depth_below(y.nearest_plane(i)), gap = difference(depth_below(y.nearest_plane(k)), own);
        const double slope = gap.slope.norm();
        if (!(slope > 0.0)) return 0.0;
        const Vector3 normal = gap.slope / slope;

        // a square in the sheet that holds all of x
        Vector3 middle = Vector3::Zero();
        for (std::size_t c = 0; c < x.corner_count; ++c) middle += x.corner[c] / static_cast<double>(x.corner_count);
        double reach = 0.0;
        for (std::size_t c = 0; c < x.corner_count; ++c) reach = std::max(reach, (x.corner[c] - middle).norm());
        middle -= gap(middle) / slope * normal;
        Eigen::Index least = 0;
        normal.cwiseAbs().minCoeff(&least);
        const Vector3 e = normal.cross(Vector3::Unit(least)).normalized() * (2.0 * reach), f = normal.cross(e);
        Polygon& sheet = face_;
        sheet.clear();
        for (const Vector3& corner : {Vector3(-e - f), Vector3(e - f), Vector3(e + f), Vector3(f - e)}) sheet.push_back(middle + corner);

        cutter_.clip(own, false, sheet);
        for (std::size_t j = 0; j < x.face_count && !sheet.empty(); ++j) cutter_.clip({x.offset[j], -x.normal[j]}, false, sheet);
        if (y.is_alone()) {
            for (std::uint32_t j = 0; j < y.nearest_count() && !sheet.empty(); ++j) {
                if (j != i && j != k) cutter_.clip(difference(depth_below(y.nearest_plane(j)), own), j > i, sheet);
            }
            return slope * integrate(sheet, normal, own);
        }
        for (std::size_t j = 0; j < y.face_count && !sheet.empty(); ++j) cutter_.clip({y.offset[j], -y.normal[j]}, false, sheet);
        return sheet.size() < 3 ? 0.0 : slope * integrate_switch(y, Sheet{i, k, normal, own}, 0, {}, sheet);
    }

    /// A plane half way between two planes of a piece.
    struct Sheet {
        std::uint32_t i, k;
        Vector3 normal;
        Affine depth;
    };
    /// Wholes seen so far that are as deep at the sheet as its own planes: those with the one, with the other, with both.
    struct Bounding {
        bool only_i = false, only_k = false, both = false;
    };
    /// ∫ d² over the part of a polygon of a sheet at which the depth changes from one of its planes to the other: positive where it takes
    /// the less deep of them, negative where the deeper; wholes below `next` are done.
    double integrate_switch(const PlacedPiece& y, const Sheet& sheet, std::size_t next, const Bounding& seen, const Polygon& polygon) {
        if (next == y.whole_count()) {
            if (seen.only_i && seen.only_k) return -integrate(polygon, sheet.normal, sheet.depth);
            return seen.both && !seen.only_i && !seen.only_k ? integrate(polygon, sheet.normal, sheet.depth) : 0.0;
        }
        bool has_i = false, has_k = false;
        for (std::size_t m = 0; m < y.whole_size(next); ++m) {
            has_i = has_i || y.member(next, m) == sheet.i;
            has_k = has_k || y.member(next, m) == sheet.k;
        }
        // parts over which one other plane of the whole is the nearest: where it is nearer than the sheet's, the whole is not as deep
        double sum = 0.0;
        Bounding bounding = seen;
        bounding.both = bounding.both || (has_i && has_k);
        bounding.only_i = bounding.only_i || (has_i && !has_k);
        bounding.only_k = bounding.only_k || (has_k && !has_i);
        for (std::size_t m = 0; m < y.whole_size(next); ++m) {
            const std::uint32_t plane = y.member(next, m);
            if (plane == sheet.i || plane == sheet.k) continue;
            const Affine own = depth_below(y.nearest_plane(plane));
            Polygon part = polygon;
            for (std::size_t o = 0; o < y.whole_size(next) && !part.empty(); ++o) {
                const std::uint32_t other = y.member(next, o);
                if (other == plane || other == sheet.i || other == sheet.k) continue;
                cutter_.clip(difference(depth_below(y.nearest_plane(other)), own), other > plane, part);
            }
            Polygon farther = part;
            cutter_.clip(difference(own, sheet.depth), false, farther);
            // deeper than the sheet's planes without having them: nothing changes there
            if (farther.size() >= 3 && (has_i || has_k)) sum += integrate_switch(y, sheet, next + 1, bounding, farther);
            cutter_.clip(difference(sheet.depth, own), true, part);
            if (part.size() >= 3) sum += integrate_switch(y, sheet, next + 1, seen, part);
        }
        return sum;
    }

    PolygonCutter cutter_;
    DepthCells cells_;
    Polygon face_;
    std::vector<OverlapVertex> vertices_;
    std::vector<DepthRange> depths_;
    std::vector<std::uint32_t> near_;
};

/// Integrals over borders of the cells of `in` inside `of`, but for the faces of `of` that are part of its surface [m⁴].
double integrate_borders(const PlacedSolid& of, const PlacedSolid& in, const OverlapCorners& overlap, CellBorders& borders) {
    double sum = 0.0;
    for (const PlacedPiece& x : of.pieces()) {
        for (const PlacedPiece& y : in.pieces()) {
            sum += borders.integrate_sheets(x, y, overlap);
            sum += borders.integrate_inner_faces(x, y, y);
            sum += borders.integrate_inner_faces(y, x, y);
        }
    }
    return sum;
}

}  // namespace

double compute_overlap_energy(const PlacedSolid& a, const PlacedSolid& b, const OverlapPieces& pieces) {
    // d = ∇·(−n d²/2) in every cell, so its integral is one over the cell's border: pieces of faces, and the sheets between cells
    CellBorders borders;
    const OverlapCorners overlap(pieces);
    const double rest = integrate_borders(b, a, overlap, borders) + integrate_borders(a, b, overlap, borders);
    return sum_load(pieces).energy + 0.25 * rest;
}

}  // namespace musim::lsdem
