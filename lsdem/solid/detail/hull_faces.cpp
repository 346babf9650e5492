#include "lsdem/solid/detail/hull_faces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

#include "lsdem/solid/detail/exact_sum.hpp"

namespace musim::lsdem::detail {
namespace {

/// An edge of a triangle.
struct Side {
    std::uint32_t triangle = 0;
    std::size_t edge = 0;
};
using Loop = std::vector<Side>;

class FaceJoiner {
  public:
    FaceJoiner(std::span<const Vector3> points, std::span<const HullTriangle> triangles, double tolerance)
        : points_(points), triangles_(triangles), tolerance_(tolerance), face_(triangles.size(), kNone) {
        for (const HullTriangle& triangle : triangles) areas_.push_back(sum_cross_products(points, triangle.corners));
    }

    std::vector<std::vector<std::uint32_t>> join() {
        grow_faces();
        while (repair_faces()) {
        }
        std::vector<std::vector<std::uint32_t>> faces;
        for (const Loop& loop : find_all_loops()) faces.push_back(find_corners(loop));
        return faces;
    }

  private:
    /// Faces are flat together where they are within this many tolerances of a plane [-].
    static constexpr double kFlat = 8.0;
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

    std::uint32_t corner(const Side& side) const { return triangles_[side.triangle].corners[side.edge]; }
    std::uint32_t across(const Side& side) const { return triangles_[side.triangle].neighbours[side.edge]; }

    /// Triangles in the order of their areas, since the largest ones have the best planes, each with those beside it in its plane.
    void grow_faces() {
        std::vector<std::uint32_t> order(triangles_.size());
        std::iota(order.begin(), order.end(), 0U);
        std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return areas_[a].norm() > areas_[b].norm(); });
        for (const std::uint32_t t : order) {
            if (face_[t] == kNone) grow_face(t);
        }
    }

    void grow_face(std::uint32_t seed) {
        Vector3 normal = Vector3::Zero(), moment = Vector3::Zero();
        double area = 0.0;
        std::vector<std::uint32_t> border;
        const auto take = [&](std::uint32_t t) {
            const HullTriangle& triangle = triangles_[t];
            const auto& c = triangle.corners;
            face_[t] = seed;
            normal += areas_[t];
            area += areas_[t].norm();
            moment += areas_[t].norm() * (points_[c[0]] + points_[c[1]] + points_[c[2]]) / 3.0;
            border.insert(border.end(), triangle.neighbours.begin(), triangle.neighbours.end());
        };
        take(seed);
        // what is too far from the plane of the triangles so far may be near that of more of them
        for (bool grown = true; grown && area > 0.0;) {
            grown = false;
            const std::vector<std::uint32_t> candidates = std::exchange(border, {});
            for (const std::uint32_t t : candidates) {
                if (face_[t] != kNone) continue;
                const Vector3 direction = normal.normalized(), middle = moment / area;
                const auto in_plane = [&](std::uint32_t p) { return std::abs(direction.dot(points_[p] - middle)) <= tolerance_; };
                if (std::all_of(triangles_[t].corners.begin(), triangles_[t].corners.end(), in_plane)) {
                    take(t);
                    grown = true;
                } else {
                    border.push_back(t);
                }
            }
        }
    }

    /// The next edge around the face of a triangle, after one whose other side is another face.
    Side find_next(const Side& side) const {
        Side next{side.triangle, (side.edge + 1) % 3};
        const std::uint32_t turning = corner(next);
        while (face_[across(next)] == face_[side.triangle]) {
            next.triangle = across(next);
            next.edge = (find_edge_to(next.triangle, turning) + 1) % 3;
        }
        return next;
    }

    std::size_t find_edge_to(std::uint32_t triangle, std::uint32_t to) const { return (find_edge(triangles_[triangle], to) + 2) % 3; }

    /// All loops around faces, in the order of their first triangles.
    std::vector<Loop> find_all_loops() const {
        std::vector<std::array<bool, 3>> known(triangles_.size(), {false, false, false});
        std::vector<Loop> loops;
        for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
            for (std::size_t i = 0; i < 3; ++i) {
                if (known[t][i] || face_[triangles_[t].neighbours[i]] == face_[t]) continue;
                Loop loop;
                for (Side side{t, i}; !known[side.triangle][side.edge]; side = find_next(side)) {
                    known[side.triangle][side.edge] = true;
                    loop.push_back(side);
                }
                loops.push_back(std::move(loop));
            }
        }
        return loops;
    }

    /// The edges between faces that meet in each point.
    void count_edges(const std::vector<Loop>& loops) {
        edges_at_.assign(points_.size(), 0);
        for (const Loop& loop : loops) {
            for (const Side& side : loop) ++edges_at_[corner(side)];
        }
    }

    std::vector<std::uint32_t> find_corners(const Loop& loop) const {
        std::vector<std::uint32_t> corners;
        for (const Side& side : loop) {
            if (edges_at_[corner(side)] > 2) corners.push_back(corner(side));
        }
        return corners;
    }

    double find_length(const Loop& loop) const {
        double length = 0.0;
        for (const Side& side : loop) {
            length += (points_[corner(side)] - points_[corner({side.triangle, (side.edge + 1) % 3})]).norm();
        }
        return length;
    }

    /// Joins faces where one is no convex polygon; returns whether there was one. One at a time, since each changes others.
    bool repair_faces() {
        const std::vector<Loop> loops = find_all_loops();
        count_edges(loops);
        std::vector<std::uint32_t> outer(triangles_.size(), kNone);
        for (std::uint32_t k = 0; k < loops.size(); ++k) {
            std::uint32_t& known = outer[face_[loops[k].front().triangle]];
            if (known == kNone) {
                known = k;
                continue;
            }
            // of two loops around a face the shorter one is around an island
            const Loop& island = find_length(loops[k]) < find_length(loops[known]) ? loops[k] : loops[known];
            return unite_with_nearest(island, std::numeric_limits<double>::infinity());
        }
        return std::any_of(loops.begin(), loops.end(), [&](const Loop& loop) { return repair_face(loop); });
    }

    bool repair_face(const Loop& loop) {
        const std::vector<std::uint32_t> corners = find_corners(loop);
        if (corners.size() < 3) return unite_with_nearest(loop, std::numeric_limits<double>::infinity());
        const Vector3 normal = sum_cross_products(points_, corners).normalized();
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const Vector3& here = points_[corners[(i + 1) % corners.size()]];
            const Vector3 before = here - points_[corners[i]], after = points_[corners[(i + 2) % corners.size()]] - here;
            const Vector3 chord = before + after;
            if (normal.dot(before.cross(after)) >= -tolerance_ * chord.norm()) continue;
            // a dent that no face beside it fills in a plane stays: it is a nick of the tolerance's size
            Loop at_dent;
            for (std::size_t k = 0; k < loop.size(); ++k) {
                const std::uint32_t dent = corners[(i + 1) % corners.size()];
                if (corner(loop[k]) == dent || corner(loop[(k + 1) % loop.size()]) == dent) at_dent.push_back(loop[k]);
            }
            if (unite_with_nearest(at_dent, kFlat * tolerance_)) return true;
        }
        return false;
    }

    /// Joins the face of some sides with the one across whose points are nearest to its plane, or whose plane is nearest to its points, if
    /// they are within a limit; returns whether.
    bool unite_with_nearest(const Loop& sides, double limit) {
        const std::uint32_t face = face_[sides.front().triangle];
        std::uint32_t best = kNone;
        double nearest = limit;
        for (const Side& side : sides) {
            const std::uint32_t other = face_[across(side)];
            const double height = find_area(face) < find_area(other) ? find_height(face, other) : find_height(other, face);
            if (height <= nearest) nearest = height, best = other;
        }
        if (best == kNone) return false;
        std::replace(face_.begin(), face_.end(), best, face);
        return true;
    }

    double find_area(std::uint32_t face) const { return find_vector(face).norm(); }

    /// Twice the vector of area of a face.
    Vector3 find_vector(std::uint32_t face) const {
        Vector3 sum = Vector3::Zero();
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            if (face_[t] == face) sum += areas_[t];
        }
        return sum;
    }

    /// The largest distance of a point of one face from the plane of another.
    double find_height(std::uint32_t face, std::uint32_t other) const {
        const Vector3 normal = find_vector(other).normalized();
        double offset = 0.0, area = 0.0, height = 0.0;
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            if (face_[t] != other) continue;
            const auto& c = triangles_[t].corners;
            offset += areas_[t].norm() * normal.dot(points_[c[0]] + points_[c[1]] + points_[c[2]]) / 3.0;
            area += areas_[t].norm();
        }
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            if (face_[t] != face) continue;
            for (const std::uint32_t c : triangles_[t].corners) height = std::max(height, std::abs(normal.dot(points_[c]) - offset / area));
        }
        return height;
    }

    std::span<const Vector3> points_;
    std::span<const HullTriangle> triangles_;
    double tolerance_ = 0.0;
    std::vector<Vector3> areas_;           ///< twice the vectors of area of the triangles
    std::vector<std::uint32_t> face_;      ///< of each triangle, named by one of its triangles
    std::vector<std::uint32_t> edges_at_;  ///< of each point
};

}  // namespace

std::vector<std::vector<std::uint32_t>> join_hull_triangles(std::span<const Vector3> points, std::span<const HullTriangle> triangles,
                                                            double tolerance) {
    return FaceJoiner(points, triangles, tolerance).join();
}

}  // namespace musim::lsdem::detail
