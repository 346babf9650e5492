#include "lsdem/contact/contact_area.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "lsdem/contact/contact_step.hpp"
#include "lsdem/detail/wide.hpp"

namespace musim::lsdem {
namespace {

double share_of(const OverlapPieces::Piece& piece) { return detail::share_of_facing(piece.facing); }

/// A triangle of a piece, about a point.
struct Triangle {
    std::array<Vector3, 3> place;
    double area;
};

/// Calls visit(triangle, indices of its three vertices) for every triangle of a piece's fan.
template <class Visit>
void for_each_triangle(const OverlapPieces& pieces, const OverlapPieces::Piece& piece, const Vector3& about, const Visit& visit) {
    const OverlapPieces::Vertex* const v = pieces.vertices(piece);
    for (std::size_t i = 1; i + 1 < piece.count; ++i) {
        const Triangle triangle{{v[0].place - about, v[i].place - about, v[i + 1].place - about},
                                0.5 * piece.normal.dot((v[i].place - v[0].place).cross(v[i + 1].place - v[0].place))};
        visit(triangle, std::array<std::size_t, 3>{0, i, i + 1});
    }
}

/// Adds integrals of affine functions.
struct Moments : PressureMoments {
    void add(const Triangle& triangle, const std::array<double, 3>& value, double weight) {
        const double total = (value[0] + value[1]) + value[2];
        sum += weight * triangle.area / 3.0 * total;
        for (std::size_t i = 0; i < 3; ++i) at += weight * triangle.area / 12.0 * (total + value[i]) * triangle.place[i];
    }
    /// The part where the function is positive.
    void add_positive(const Triangle& triangle, const std::array<double, 3>& value, double weight) {
        const int above = static_cast<int>(value[0] > 0.0) + static_cast<int>(value[1] > 0.0) + static_cast<int>(value[2] > 0.0);
        if (above == 0) return;
        if (above == 3) return add(triangle, value, weight);
        // one vertex is on the other side than the two others
        std::size_t lone = 0;
        while ((value[lone] > 0.0) != (above == 1)) ++lone;
        const std::size_t j = (lone + 1) % 3, k = (lone + 2) % 3;
        const double to_j = value[lone] / (value[lone] - value[j]), to_k = value[lone] / (value[lone] - value[k]);
        const Vector3& at_lone = triangle.place[lone];
        const Triangle corner{{at_lone, at_lone + to_j * (triangle.place[j] - at_lone), at_lone + to_k * (triangle.place[k] - at_lone)},
                              triangle.area * to_j * to_k};
        if (above == 2) add(triangle, value, weight);
        add(corner, {value[lone], 0.0, 0.0}, above == 1 ? weight : -weight);
    }
};

/// Area, first and second moments of a surface about a point.
struct AreaMoments {
    double area = 0.0;                 ///< [m²]
    Vector3 at = Vector3::Zero();      ///< [m³]
    Matrix3 second = Matrix3::Zero();  ///< lower triangle [m⁴]

    void add(const Triangle& triangle, double weight) {
        const Vector3 sum = (triangle.place[0] + triangle.place[1]) + triangle.place[2];
        const double share = weight * triangle.area;
        area += share;
        at += share / 3.0 * sum;
        for (Eigen::Index r = 0; r < 3; ++r) {
            for (Eigen::Index c = 0; c <= r; ++c) {
                double products = sum[r] * sum[c];
                for (const Vector3& x : triangle.place) products += x[r] * x[c];
                second(r, c) += share / 12.0 * products;
            }
        }
    }
    friend AreaMoments operator+(const AreaMoments& a, const AreaMoments& b) { return {a.area + b.area, a.at + b.at, a.second + b.second}; }
};

}  // namespace

ContactArea find_contact_area(const OverlapPieces& pieces, const Vector3& about) {
    // each body's by itself, so that they may change places without changing a bit
    std::array<AreaMoments, 2> half;
    for (const OverlapPieces::Piece& piece : pieces) {
        const double share = 0.5 * share_of(piece);
        if (!(share > 0.0)) continue;
        AreaMoments& sum = half[piece.body];
        for_each_triangle(pieces, piece, about, [&](const Triangle& triangle, const auto& /*index*/) { sum.add(triangle, share); });
    }
    const AreaMoments both = half[0] + half[1];
    ContactArea found;
    found.area = both.area;
    if (!(both.area > 0.0)) return found;
    found.arm = both.at / both.area;
    found.second = both.second;
    found.second.triangularView<Eigen::StrictlyUpper>() = both.second.transpose();
    found.second -= both.area * found.arm * found.arm.transpose();
    return found;
}

PressureMoments find_pull(const OverlapPieces& pieces, const AffinePressure& dashpot, double stiffness) {
    std::array<Moments, 2> half;
    thread_local std::vector<double> pull;  // room
    pull.resize(std::max(pull.size(), pieces.most_vertices()));
    for (const OverlapPieces::Piece& piece : pieces) {
        const double share = 0.5 * share_of(piece);
        if (!(share > 0.0)) continue;
        const OverlapPieces::Vertex* const v = pieces.vertices(piece);
        bool pulls = false;
        for (std::size_t i = 0; i < piece.count; ++i) {
            pull[i] = -(dashpot.at + dashpot.slope.dot(v[i].place - dashpot.about)) - stiffness * v[i].depth;
            pulls = pulls || pull[i] > 0.0;
        }
        if (!pulls) continue;
        Moments& sum = half[piece.body];
        for_each_triangle(pieces, piece, dashpot.about, [&](const Triangle& triangle, const std::array<std::size_t, 3>& index) {
            sum.add_positive(triangle, {pull[index[0]], pull[index[1]], pull[index[2]]}, share);
        });
    }
    return {half[0].sum + half[1].sum, half[0].at + half[1].at};
}

namespace {

/// ∫ d r over a polygon in a plane, r the distance from the origin: the triangles between the origin and its sides, in closed form.
/// `depth_at_origin`: d there, as it goes on from the polygon.
double integrate_distance(std::size_t count, const Vector3* place, const double* depth, double depth_at_origin, const Vector3& normal) {
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t next = i + 1 == count ? 0 : i + 1;
        const Vector3 side = place[next] - place[i];
        const double length = side.norm();
        if (!(length > 0.0)) continue;
        const Vector3 along = side / length;
        const double away = normal.dot(place[i].cross(along)), s0 = along.dot(place[i]), s1 = s0 + length;
        if (away == 0.0) continue;
        const double r0 = std::sqrt(away * away + s0 * s0), r1 = std::sqrt(away * away + s1 * s1);
        // s + r without cancellation
        const double e0 = s0 > 0.0 ? s0 + r0 : away * away / (r0 - s0), e1 = s1 > 0.0 ? s1 + r1 : away * away / (r1 - s1);
        const double of_r = 0.5 * ((s1 * r1 - s0 * r0) + away * away * (e0 > 0.0 ? detail::log_of_ratio<detail::Wide<1>>(e1, e0) : 0.0));
        const double slope = (depth[next] - depth[i]) / length;
        const double of_depth_r = (depth[i] - slope * s0) * of_r + slope * ((r1 * r1 * r1 - r0 * r0 * r0) / 3.0);
        sum += away * (depth_at_origin / 12.0 * of_r + 0.25 * of_depth_r);
    }
    return sum;
}

/// View of a piece along `normal`, in which the second body is pushed.
struct Sight {
    double sign, cosine, share;  ///< share: in the reach [-]
    Sight(const OverlapPieces::Piece& piece, const Vector3& normal)
        : sign(piece.body == 0 ? 1.0 : -1.0),
          cosine(sign * piece.normal.dot(normal)),
          share(share_of(piece) * detail::share_of_facing(cosine)) {}
    /// ∫ d over the piece as it is seen [m³].
    double load(const OverlapPieces& pieces, const OverlapPieces::Piece& piece) const {
        const OverlapPieces::Vertex* const v = pieces.vertices(piece);
        double sum = 0.0;
        for_each_triangle(pieces, piece, v[0].place, [&](const Triangle& triangle, const std::array<std::size_t, 3>& i) {
            sum += share * cosine * triangle.area / 3.0 * ((v[i[0]].depth + v[i[1]].depth) + v[i[2]].depth);
        });
        return sum;
    }
};

}  // namespace

double find_least_reach(const OverlapPieces& pieces, const Vector3& normal, double deepest) {
    constexpr double kRounding = 1.0 - 1e-9;
    std::array<double, 2> load{};
    for (const OverlapPieces::Piece& piece : pieces) {
        const Sight sight(piece, normal);
        if (sight.share > 0.0) load[piece.body] += sight.load(pieces, piece);
    }
    // a body without a load has no part in it
    const double least = std::min(load[0] > 0.0 ? load[0] : load[1], load[1] > 0.0 ? load[1] : load[0]);
    return least > 0.0 ? 2.0 / 3.0 * kRounding * std::sqrt(least / (std::numbers::pi * deepest)) : 0.0;
}

double find_reach(const OverlapPieces& pieces, const Vector3& normal, const Vector3& about) {
    std::array<double, 2> distance{}, load{};
    thread_local std::vector<Vector3> place;  // room
    thread_local std::vector<double> depth;
    place.resize(std::max(place.size(), pieces.most_vertices())), depth.resize(place.size());
    for (const OverlapPieces::Piece& piece : pieces) {
        const Sight sight(piece, normal);
        if (!(sight.share > 0.0)) continue;
        const OverlapPieces::Vertex* const v = pieces.vertices(piece);
        for (std::size_t i = 0; i < piece.count; ++i) {
            const Vector3 x = v[i].place - about;
            place[i] = x - normal.dot(x) * normal;
            depth[i] = v[i].depth;
        }
        // the point of the piece's plane that lies over the origin
        const Vector3 to_first = v[0].place - about;
        const Vector3 over = piece.normal.dot(to_first) / piece.normal.dot(normal) * normal;
        const double at_origin = v[0].depth - piece.nearest_normal.dot(over - to_first);
        const double of_piece = integrate_distance(piece.count, place.data(), depth.data(), at_origin, normal);
        distance[piece.body] += sight.share * sight.sign * of_piece;
        load[piece.body] += sight.load(pieces, piece);
    }
    const double total = load[0] + load[1];
    return total > 0.0 ? std::max(0.0, (distance[0] + distance[1]) / total) : 0.0;
}

}  // namespace musim::lsdem
