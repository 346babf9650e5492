#include "lsdem/contact/overlap.hpp"

#include <algorithm>
#include <limits>

#include "lsdem/contract.hpp"

namespace musim::lsdem {
namespace {

/// A convex polygon that is being cut. A cut adds one corner at most.
struct Polygon {
    static constexpr std::size_t kMost = OverlapPieces::kMostCorners;
    std::size_t count = 0;
    std::array<Vector3, kMost> place;

    Polygon() {}
    Polygon(const Polygon& other) : count(other.count) { std::copy_n(other.place.begin(), count, place.begin()); }
    Polygon& operator=(const Polygon&) = delete;
    ~Polygon() = default;
};

/// An affine function: at + slope·x.
struct Affine {
    double at;
    Vector3 slope;
    double operator()(const Vector3& x) const { return at + slope.dot(x); }
};

Affine depth_below(const PlacedSolid& solid, std::size_t k) { return {solid.offset[k], -solid.normal[k]}; }

Affine difference(const Affine& a, const Affine& b) { return {a.at - b.at, a.slope - b.slope}; }

/// Keeps what lies where `inside` is positive; the border counts as inside where `with_border` says so [SutherlandHodgman74].
void clip(const Affine& inside, bool with_border, Polygon& polygon) {
    std::array<double, Polygon::kMost> at;
    std::size_t within = 0;
    const auto holds = [&](double value) { return with_border ? value >= 0.0 : value > 0.0; };
    for (std::size_t i = 0; i < polygon.count; ++i) {
        at[i] = inside(polygon.place[i]);
        within += holds(at[i]) ? 1 : 0;
    }
    if (within == polygon.count) return;
    if (within == 0) {
        polygon.count = 0;
        return;
    }
    std::array<Vector3, Polygon::kMost> from;
    std::copy_n(polygon.place.begin(), polygon.count, from.begin());
    std::size_t count = 0;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const bool has_room = count + 2 <= Polygon::kMost;
        EXPECTS(has_room);
        if (!has_room) break;
        const std::size_t next = i + 1 == polygon.count ? 0 : i + 1;
        if (holds(at[i])) polygon.place[count++] = from[i];
        if (holds(at[i]) == holds(at[next])) continue;
        polygon.place[count++] = from[i] + at[i] / (at[i] - at[next]) * (from[next] - from[i]);
    }
    polygon.count = count;
}

}  // namespace

void OverlapPieces::cut_faces(const PlacedSolid& x, const PlacedSolid& y, std::size_t body) {
    std::array<std::uint32_t, PlacedSolid::kMostFaces> outside{};  // corners, a bit each
    for (std::size_t c = 0; c < x.corner_count; ++c) {
        for (std::size_t k = 0; k < y.face_count; ++k) outside[k] |= (y.depth(k, x.corner[c]) > 0.0 ? 0U : 1U) << c;
    }
    for (std::size_t f = 0; f < x.face_count; ++f) {
        const PlacedSolid::Loop& loop = x.loop[f];
        // planes of y that all of the face is outside of, or that cut it
        std::uint32_t of_face = 0, cuts = 0;
        for (std::size_t i = 0; i < loop.count; ++i) of_face |= 1U << loop.first[i];
        bool apart = false;
        for (std::size_t k = 0; k < y.face_count; ++k) {
            const std::uint32_t out = outside[k] & of_face;
            apart = apart || out == of_face;
            cuts |= (out != 0 ? 1U : 0U) << k;
        }
        if (apart) continue;
        Polygon polygon;
        polygon.count = loop.count;
        for (std::size_t i = 0; i < loop.count; ++i) polygon.place[i] = x.corner[loop.first[i]];
        for (std::size_t k = 0; k < y.face_count && polygon.count > 0; ++k) {
            if ((cuts >> k & 1U) != 0) clip(depth_below(y, k), false, polygon);
        }
        if (polygon.count < 3) continue;

        // what is left lies inside y; planes that are nowhere nearest are left out
        std::array<double, PlacedSolid::kMostFaces> least;
        double bound = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < y.face_count; ++k) {
            double most = 0.0;
            least[k] = std::numeric_limits<double>::infinity();
            for (std::size_t i = 0; i < polygon.count; ++i) {
                const double d = y.depth(k, polygon.place[i]);
                least[k] = std::min(least[k], d);
                most = std::max(most, d);
            }
            bound = std::min(bound, most);
        }
        const auto can_be_nearest = [&](std::size_t k) { return least[k] <= bound; };
        for (std::size_t k = 0; k < y.face_count; ++k) {
            if (!can_be_nearest(k)) continue;
            Polygon cell = polygon;
            const Affine own = depth_below(y, k);
            for (std::size_t other = 0; other < y.face_count && cell.count > 0; ++other) {
                if (other != k && can_be_nearest(other)) clip(difference(depth_below(y, other), own), other > k, cell);
            }
            if (cell.count < 3) continue;
            // solids of too many faces would lose a part of their overlap
            const bool has_room = piece_count_ < kMostPieces && vertex_count_ + cell.count <= kMostVertices;
            EXPECTS(has_room);
            if (!has_room) continue;
            pieces_[piece_count_++] = {.normal = x.normal[f],
                                       .facing = -x.normal[f].dot(y.normal[k]),
                                       .first = static_cast<std::uint16_t>(vertex_count_),
                                       .count = static_cast<std::uint16_t>(cell.count),
                                       .body = body,
                                       .nearest_normal = y.normal[k]};
            for (std::size_t i = 0; i < cell.count; ++i) vertices_[vertex_count_++] = {cell.place[i], std::max(0.0, own(cell.place[i]))};
            with_cells_[body] |= 1U << f, with_cells_[1 - body] |= 1U << k;
        }
    }
}

void OverlapPieces::cut(const PlacedSolid& a, const PlacedSolid& b) {
    piece_count_ = vertex_count_ = 0;
    with_cells_ = {};
    cut_faces(a, b, 0);
    cut_faces(b, a, 1);
}

namespace {

/// ∫ d² over a polygon in a plane of normal n [m⁴].
double integrate_square(std::size_t count, const Vector3& normal, const OverlapPieces::Vertex* v) {
    double sum = 0.0;
    for (std::size_t i = 1; i + 1 < count; ++i) {
        const double twice = normal.dot((v[i].place - v[0].place).cross(v[i + 1].place - v[0].place));
        const double a = v[0].depth, b = v[i].depth, c = v[i + 1].depth;
        sum += twice / 12.0 * ((a * a + b * b) + (c * c + (a * b + (b * c + a * c))));
    }
    return sum;
}

}  // namespace

OverlapLoad sum_load(const OverlapPieces& pieces) {
    // of each body by itself, so that the bodies may change places without changing a bit
    std::array<Vector3, 2> force{Vector3::Zero(), Vector3::Zero()}, moment = force;
    std::array<double, 2> area{}, squares{};
    OverlapLoad load;
    for (const OverlapPieces::Piece& piece : pieces) {
        const OverlapPieces::Vertex* const v = pieces.vertices(piece);
        double sum = 0.0;
        Vector3 at = Vector3::Zero();
        for (std::size_t i = 0; i < piece.count; ++i) load.deepest = std::max(load.deepest, v[i].depth);
        for (std::size_t i = 1; i + 1 < piece.count; ++i) {
            const Vector3 one = v[i].place - v[0].place, two = v[i + 1].place - v[0].place;
            const double twice = piece.normal.dot(one.cross(two)), depth = (v[0].depth + v[i].depth) + v[i + 1].depth;
            area[piece.body] += 0.5 * twice;
            sum += twice / 6.0 * depth;
            at += twice / 24.0 * ((depth + v[i].depth) * one + (depth + v[i + 1].depth) * two);
        }
        squares[piece.body] += piece.facing * integrate_square(piece.count, piece.normal, v);
        force[piece.body] += sum * piece.normal;
        moment[piece.body] += (at + sum * v[0].place).cross(piece.normal);
    }
    load.force = 0.5 * (force[0] - force[1]);
    load.moment = 0.5 * (moment[0] - moment[1]);
    load.area = 0.5 * (area[0] + area[1]);
    load.energy = 0.25 * (squares[0] + squares[1]);
    return load;
}

namespace {

/// ∫ d² over the part of the sheet half way between planes i and k of `y` where both are nearest, inside `x`, times |n_i − n_k| [m⁴].
double integrate_sheet(const PlacedSolid& x, const PlacedSolid& y, std::size_t i, std::size_t k) {
    const Affine own = depth_below(y, i), gap = difference(depth_below(y, k), own);
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
    Polygon sheet;
    sheet.count = 4;
    sheet.place[0] = middle - e - f, sheet.place[1] = middle + e - f, sheet.place[2] = middle + e + f, sheet.place[3] = middle - e + f;

    clip(own, false, sheet);
    for (std::size_t j = 0; j < x.face_count && sheet.count > 0; ++j) clip(depth_below(x, j), false, sheet);
    for (std::size_t j = 0; j < y.face_count && sheet.count > 0; ++j) {
        if (j != i && j != k) clip(difference(depth_below(y, j), own), j > i, sheet);
    }
    std::array<OverlapPieces::Vertex, Polygon::kMost> vertices;
    for (std::size_t v = 0; v < sheet.count; ++v) vertices[v] = {sheet.place[v], own(sheet.place[v])};
    return slope * integrate_square(sheet.count, normal, vertices.data());
}

/// Sum over all sheets of `y` inside `x`; `with_cells`: planes of y that are nearest to some of the overlap, the only ones with sheets
/// there.
double integrate_sheets(const PlacedSolid& x, const PlacedSolid& y, std::uint32_t with_cells) {
    double sum = 0.0;
    for (std::size_t i = 0; i < y.face_count; ++i) {
        for (std::size_t k = i + 1; k < y.face_count; ++k) {
            if ((with_cells >> i & 1U) != 0 && (with_cells >> k & 1U) != 0) sum += integrate_sheet(x, y, i, k);
        }
    }
    return sum;
}

}  // namespace

double compute_overlap_energy(const PlacedSolid& a, const PlacedSolid& b, const OverlapPieces& pieces) {
    // d = ∇·(−n d²/2) in every cell, so its integral is one over the cell's border: pieces of faces, and the sheets between cells
    const double sheets = integrate_sheets(b, a, pieces.with_cells_of(0)) + integrate_sheets(a, b, pieces.with_cells_of(1));
    return sum_load(pieces).energy + 0.25 * sheets;
}

}  // namespace musim::lsdem
