#include "lsdem/contact/overlap.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace musim::lsdem {
namespace {

/// Bodies of no more faces than this cut a face of another by those that have a corner of it outside. Affects speed only.
constexpr std::size_t kFewFaces = 8;

/// Depth below a plane that counts as rounding, over the largest distance of a plane from the origin of the pair [-].
constexpr double kRoundingDepth = 0x1p-46;

}  // namespace

void OverlapPieces::Sides::find(const PlacedPiece& corners, const PlacedPiece& planes) {
    words = corners.form->words_a_face();
    outside.resize(words * planes.face_count);
    std::array<double, detail::Points::kWord> at;
    all_outside = false;
    const bool marks_shallow = planes.face_count > kFewFaces;
    shallow.resize(marks_shallow ? outside.size() : 0);
    double farthest = 0.0;
    for (std::size_t k = 0; k < planes.face_count; ++k) farthest = std::max(farthest, std::abs(planes.offset[k]));
    const double rounding = kRoundingDepth * farthest;
    for (std::size_t k = 0; k < planes.face_count && !all_outside; ++k) {
        const detail::Affine depth = detail::depth_below({planes.normal[k], planes.offset[k]});
        bool all = true;
        for (std::size_t w = 0; w < words; ++w) {
            const std::uint64_t marked =
                detail::Points::low_bits(std::min(corners.corner_count - w * detail::Points::kWord, detail::Points::kWord));
            const std::uint64_t out = ~corners.corner.evaluate(depth, w, false, at.data()) & marked;
            outside[k * words + w] = out;
            if (marks_shallow) {
                const detail::Affine deeper{depth.at - rounding, depth.slope};
                shallow[k * words + w] = ~corners.corner.evaluate(deeper, w, false, at.data()) & marked;
            }
            all = all && out == marked;
        }
        // a half space has more than the corners of its sheet
        all_outside = all && corners.face_count > 1;
    }
}

void OverlapPieces::cut_face(const PlacedPiece& x, std::size_t f, const PlacedPiece& y, const Sides& of_x, const Sides& of_y) {
    polygon_.clear();
    const auto loop = x.loop(f);
    // planes of y that all of the face is outside of, or that cut it
    cuts_.clear();
    for (std::size_t k = 0; k < y.face_count; ++k) {
        const Sides::Share share = of_x.share(k, *x.form, f);
        if (share == Sides::Share::all) return;
        if (share == Sides::Share::some) cuts_.push_back(k);
        // sides that are flush push each other by rounding times a strip
        if (of_x.is_shallow(k, *x.form, f) && x.normal[f].dot(y.normal[k]) > 0.0) return;
    }
    if (y.face_count > kFewFaces) {
        // the plane of the face cuts y along those faces of y that it passes through
        const auto misses = [&](std::size_t k) { return of_y.share(f, *y.form, k) != Sides::Share::some; };
        cuts_.erase(std::remove_if(cuts_.begin(), cuts_.end(), misses), cuts_.end());
    }
    for (const std::uint32_t c : loop) polygon_.push_back(x.corner[c]);
    for (const std::size_t k : cuts_) {
        if (polygon_.empty()) return;
        cutter_.clip(detail::depth_below({y.normal[k], y.offset[k]}), false, polygon_);
    }
}

void OverlapPieces::add_pieces(const PlacedPiece& x, std::size_t f, const PlacedPiece& y, std::uint32_t body) {
    cells_.visit(polygon_, y, [&](std::uint32_t k, const detail::Polygon& cell) {
        const Plane nearest = y.nearest_plane(k);
        pieces_.push_back({.normal = x.normal[f],
                           .facing = -x.normal[f].dot(nearest.normal),
                           .first = static_cast<std::uint32_t>(vertices_.size()),
                           .count = static_cast<std::uint32_t>(cell.size()),
                           .body = body,
                           .nearest_normal = nearest.normal});
        most_vertices_ = std::max(most_vertices_, cell.size());
        for (std::size_t i = 0; i < cell.size(); ++i) {
            const Vector3 place = cell[i];
            vertices_.push_back({place, std::max(0.0, nearest.depth(place))});
        }
    });
}

void OverlapPieces::cut(const PlacedPiece& x, const PlacedPiece& y, const Sides& of_x, const Sides& of_y, std::uint32_t body) {
    for (std::size_t f = 0; f < x.face_count; ++f) {
        if (!x.is_outer(f)) continue;
        cut_face(x, f, y, of_x, of_y);
        if (polygon_.size() >= 3) add_pieces(x, f, y, body);
    }
}

void OverlapPieces::cut(const PlacedSolid& a, const PlacedSolid& b) {
    pieces_.clear();
    vertices_.clear();
    most_vertices_ = 0;
    for (const PlacedPiece& x : a.pieces()) {
        for (const PlacedPiece& y : b.pieces()) {
            sides_[0].find(x, y);
            if (sides_[0].all_outside) continue;
            sides_[1].find(y, x);
            if (sides_[1].all_outside) continue;
            cut(x, y, sides_[0], sides_[1], 0);
            cut(y, x, sides_[1], sides_[0], 1);
        }
    }
}

namespace {

/// ∫ d² over a triangle of twice the area `twice`, of the depths at its corners.
double integrate_square(double twice, double a, double b, double c) {
    return twice / 12.0 * ((a * a + b * b) + (c * c + (a * b + (b * c + a * c))));
}

}  // namespace

double integrate_square(std::size_t count, const Vector3& normal, const OverlapVertex* v) {
    double sum = 0.0;
    for (std::size_t i = 1; i + 1 < count; ++i) {
        const double twice = normal.dot((v[i].place - v[0].place).cross(v[i + 1].place - v[0].place));
        sum += integrate_square(twice, v[0].depth, v[i].depth, v[i + 1].depth);
    }
    return sum;
}

OverlapLoad sum_load(const OverlapPieces& pieces) {
    // of each body by itself, so that the bodies may change places without changing a bit
    std::array<Vector3, 2> force{Vector3::Zero(), Vector3::Zero()}, moment = force;
    std::array<double, 2> area{}, squares{};
    OverlapLoad load;
    for (const OverlapPieces::Piece& piece : pieces) {
        const OverlapPieces::Vertex* const v = pieces.vertices(piece);
        double sum = 0.0, square = 0.0;
        Vector3 at = Vector3::Zero();
        for (std::size_t i = 0; i < piece.count; ++i) load.deepest = std::max(load.deepest, v[i].depth);
        for (std::size_t i = 1; i + 1 < piece.count; ++i) {
            const Vector3 one = v[i].place - v[0].place, two = v[i + 1].place - v[0].place;
            const double twice = piece.normal.dot(one.cross(two)), depth = (v[0].depth + v[i].depth) + v[i + 1].depth;
            area[piece.body] += 0.5 * twice;
            square += integrate_square(twice, v[0].depth, v[i].depth, v[i + 1].depth);
            sum += twice / 6.0 * depth;
            at += twice / 24.0 * ((depth + v[i].depth) * one + (depth + v[i + 1].depth) * two);
        }
        squares[piece.body] += piece.facing * square;
        force[piece.body] += sum * piece.normal;
        moment[piece.body] += (at + sum * v[0].place).cross(piece.normal);
    }
    load.force = 0.5 * (force[0] - force[1]);
    load.moment = 0.5 * (moment[0] - moment[1]);
    load.area = 0.5 * (area[0] + area[1]);
    load.energy = 0.25 * (squares[0] + squares[1]);
    return load;
}

}  // namespace musim::lsdem
