#include "lsdem/scene/resting_pose.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>

#include "lsdem/scene/detail/overlap.hpp"

namespace musim::lsdem {
namespace {

/// Heights that differ by less than this part of the footprint are one: rounding of coordinates, not geometry.
constexpr double kSameHeight = 1e-12;

/// Looks for the face under the centre of mass; it is found after one or two unless the box is about to topple.
constexpr int kMostPasses = 8;

/// Halvings of the tilt until a box clears its neighbors.
constexpr int kHalvings = 10;

/// Passes over a layer; in the second one boxes use the room that others have left.
constexpr int kPasses = 2;

/// Footprint of an upright box: middle in plan, directions of its body x and y axes.
struct Footprint {
    Vector3 middle, along_u, along_v;
    double half_u, half_v;

    explicit Footprint(const BoxPose& box)
        : middle(box.position.x(), box.position.y(), 0.0),
          along_u(box.orientation * Vector3::UnitX()),
          along_v(box.orientation * Vector3::UnitY()),
          half_u(0.5 * box.size.x()),
          half_v(0.5 * box.size.y()) {}

    Vector3 to_local(const Vector3& point) const {
        const Vector3 from_middle = point - middle;
        return {along_u.dot(from_middle), along_v.dot(from_middle), point.z()};
    }
};

std::array<Vector3, 4> find_top_corners(const BoxPose& box) {
    const Vector3 half = 0.5 * box.size;
    std::array<Vector3, 4> corners;
    for (std::size_t c = 0; c < 4; ++c) {
        const double x = c == 0 || c == 3 ? -half.x() : half.x(), y = c < 2 ? -half.y() : half.y();
        corners[c] = box.position + box.orientation * Vector3(x, y, half.z());
    }
    return corners;
}

/// Height of the highest corner [m]; zero without boxes.
double find_top(std::span<const BoxPose> boxes) {
    double top = 0.0;
    for (const BoxPose& box : boxes)
        for (const Vector3& corner : find_top_corners(box)) top = std::max(top, corner.z());
    return top;
}

/// The part of a polygon with `side`·p[axis] ≤ limit [SutherlandHodgman74].
std::vector<Vector3> cut(const std::vector<Vector3>& polygon, Eigen::Index axis, double side, double limit) {
    std::vector<Vector3> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vector3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double over_a = side * a[axis] - limit, over_b = side * b[axis] - limit;
        if (over_a <= 0.0) kept.push_back(a);
        if ((over_a < 0.0 && over_b > 0.0) || (over_a > 0.0 && over_b < 0.0)) kept.emplace_back(a + (b - a) * (over_a / (over_a - over_b)));
    }
    return kept;
}

/// The part of the top face of `carrier` over the footprint of `box`, in the frame of the latter.
std::vector<Vector3> cut_top(const BoxPose& box, const BoxPose& carrier) {
    const Footprint footprint(box);
    std::vector<Vector3> polygon;
    for (const Vector3& corner : find_top_corners(carrier)) polygon.push_back(footprint.to_local(corner));
    for (const double side : {-1.0, 1.0}) {
        polygon = cut(polygon, 0, side, footprint.half_u);
        polygon = cut(polygon, 1, side, footprint.half_v);
    }
    return polygon;
}

double cross(double au, double av, double bu, double bv) { return au * bv - av * bu; }

/// The plane through three points, when (u, v) lies inside their triangle in plan.
struct Facet {
    RestingPlane plane;
    double area = 0.0;   ///< twice the triangle's, in plan [m²]
    double value = 0.0;  ///< height at (u, v) [m]
};
std::optional<Facet> find_facet(const Vector3& a, const Vector3& b, const Vector3& c, double u, double v) {
    const double area = cross(b.x() - a.x(), b.y() - a.y(), c.x() - a.x(), c.y() - a.y());
    if (area == 0.0) return std::nullopt;
    const double at_b = cross(u - a.x(), v - a.y(), c.x() - a.x(), c.y() - a.y()) / area;
    const double at_c = cross(b.x() - a.x(), b.y() - a.y(), u - a.x(), v - a.y()) / area;
    if (at_b < 0.0 || at_c < 0.0 || at_b + at_c > 1.0) return std::nullopt;
    const double rise_b = b.z() - a.z(), rise_c = c.z() - a.z();
    Facet facet;
    facet.plane.slope_u = (rise_b * (c.y() - a.y()) - rise_c * (b.y() - a.y())) / area;
    facet.plane.slope_v = (rise_c * (b.x() - a.x()) - rise_b * (c.x() - a.x())) / area;
    facet.plane.height = a.z() - facet.plane.slope_u * a.x() - facet.plane.slope_v * a.y();
    facet.area = std::abs(area);
    facet.value = a.z() + at_b * rise_b + at_c * rise_c;
    return facet;
}

/// The face of the upper hull over (u, v): of all triangles around it the one that is highest there; of equally high ones the largest.
std::optional<RestingPlane> find_upper_face(std::span<const Vector3> points, double u, double v, double extent) {
    std::optional<Facet> best;
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t j = i + 1; j < points.size(); ++j) {
            for (std::size_t k = j + 1; k < points.size(); ++k) {
                const std::optional<Facet> facet = find_facet(points[i], points[j], points[k], u, v);
                if (!facet) continue;
                const double gain = best ? facet->value - best->value : extent;
                if (gain > kSameHeight * extent || (gain >= -kSameHeight * extent && facet->area > best->area)) best = facet;
            }
        }
    }
    if (!best) return std::nullopt;
    return best->plane;
}

/// Height of a plane of given slopes that no point looks through.
double clear(std::span<const Vector3> points, double slope_u, double slope_v) {
    double height = points.front().z() - slope_u * points.front().x() - slope_v * points.front().y();
    for (const Vector3& point : points) height = std::max(height, point.z() - slope_u * point.x() - slope_v * point.y());
    return height;
}

detail::Body to_body(const BoxPose& box) { return {0.5 * box.size, box.position, box.orientation.toRotationMatrix(), false, false}; }

/// Boxes whose plans may overlap, whatever their tilt: closer than their half diagonals.
bool near(const BoxPose& a, const BoxPose& b) {
    const Vector3 offset = a.position - b.position;
    return std::hypot(offset.x(), offset.y()) <= 0.5 * (a.size.norm() + b.size.norm());
}

/// A box on its way to rest.
struct Settler {
    BoxPose upright;
    std::vector<std::size_t> neighbors;  ///< boxes of its layer that may be in its way
    std::vector<Vector3> points;
    RestingPlane plane;
    double part = 0.0;  ///< of the tilt of its plane that it has
};

/// The boxes of one layer, and where they stand so far.
class Layer {
  public:
    Layer(std::span<const BoxPose> below, std::span<BoxPose> boxes, double clearance)
        : boxes_(boxes), clearance_(clearance), settlers_(boxes.size()) {
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            settlers_[i].upright = boxes[i];
            for (std::size_t j = 0; j < i; ++j) {
                if (!near(boxes[i], boxes[j])) continue;
                settlers_[i].neighbors.push_back(j);
                settlers_[j].neighbors.push_back(i);
            }
        }
        for (std::size_t i = 0; i < boxes.size(); ++i) find_plane(i, below);
    }

    void come_to_rest() {
        for (int pass = 0; pass < kPasses; ++pass)
            for (std::size_t i = 0; i < boxes_.size(); ++i) tilt(i, find_free_part(i));
    }

  private:
    void find_plane(std::size_t i, std::span<const BoxPose> below) {
        Settler& settler = settlers_[i];
        std::vector<BoxPose> carriers;
        std::copy_if(below.begin(), below.end(), std::back_inserter(carriers),
                     [&](const BoxPose& box) { return near(settler.upright, box); });
        settler.points = find_support_points(settler.upright, carriers.empty() ? below : carriers);
        const Vector3& size = settler.upright.size;
        settler.plane = find_resting_plane(settler.points, size.z(), std::hypot(size.x(), size.y()));
        tilt(i, 0.0);
    }

    BoxPose pose(std::size_t i, double part) const {
        return tilt_onto(settlers_[i].upright, settlers_[i].plane, settlers_[i].points, part);
    }

    void tilt(std::size_t i, double part) {
        settlers_[i].part = part;
        boxes_[i] = pose(i, part);
    }

    /// Depth by which box i, tilted by `part`, reaches into each of its neighbors, less the clearance [m].
    std::vector<double> find_intrusions(std::size_t i, double part) const {
        const detail::Body tilted = to_body(pose(i, part));
        std::vector<double> intrusions;
        for (const std::size_t j : settlers_[i].neighbors)
            intrusions.push_back(detail::compute_overlap(tilted, to_body(boxes_[j])) + clearance_);
        return intrusions;
    }

    /// No less than what it has: that is free, whereas a neighbor may have taken the room in which it stood upright.
    double find_free_part(std::size_t i) const {
        double low = settlers_[i].part, high = 1.0;
        const std::vector<double> least = find_intrusions(i, low);
        const auto is_free = [&](double part) {
            const std::vector<double> intrusions = find_intrusions(i, part);
            for (std::size_t n = 0; n < intrusions.size(); ++n) {
                const Vector3 &size = settlers_[i].upright.size, &other = boxes_[settlers_[i].neighbors[n]].size;
                const double touching = detail::kTouchingTolerance * std::min(size.minCoeff(), other.minCoeff());
                if (intrusions[n] > std::max(least[n], 0.0) + touching) return false;
            }
            return true;
        };
        if (is_free(1.0)) return 1.0;
        for (int halving = 0; halving < kHalvings; ++halving) {
            const double middle = 0.5 * (low + high);
            (is_free(middle) ? low : high) = middle;
        }
        return low;
    }

    std::span<BoxPose> boxes_;
    double clearance_;
    std::vector<Settler> settlers_;
};

}  // namespace

std::vector<Vector3> find_support_points(const BoxPose& box, std::span<const BoxPose> below) {
    std::vector<Vector3> points;
    for (const BoxPose& carrier : below) {
        const std::vector<Vector3> polygon = cut_top(box, carrier);
        points.insert(points.end(), polygon.begin(), polygon.end());
    }
    if (points.empty()) points.emplace_back(0.0, 0.0, find_top(below));
    return points;
}

RestingPlane find_resting_plane(std::span<const Vector3> points, double height, double extent) {
    RestingPlane plane{clear(points, 0.0, 0.0), 0.0, 0.0};
    for (int look = 0; look < kMostPasses; ++look) {
        const RestingPlane before = plane;
        const double lean = -0.5 * height / std::sqrt(1.0 + before.slope_u * before.slope_u + before.slope_v * before.slope_v);
        const auto face = find_upper_face(points, lean * before.slope_u, lean * before.slope_v, extent);
        if (!face) return before;
        plane = *face;
        if (plane.slope_u == before.slope_u && plane.slope_v == before.slope_v) break;
    }
    return plane;
}

BoxPose tilt_onto(const BoxPose& box, const RestingPlane& plane, std::span<const Vector3> points, double part) {
    const double slope_u = part * plane.slope_u, slope_v = part * plane.slope_v;
    const Vector3 normal = box.orientation * Vector3(-slope_u, -slope_v, 1.0).normalized();
    BoxPose tilted = box;
    tilted.orientation = (Quaternion::FromTwoVectors(Vector3::UnitZ(), normal) * box.orientation).normalized();
    const Vector3 foot(box.position.x(), box.position.y(), clear(points, slope_u, slope_v));
    tilted.position = foot + 0.5 * box.size.z() * normal;
    return tilted;
}

void put_to_rest(std::span<const BoxPose> below, std::span<BoxPose> boxes, double clearance) {
    Layer(below, boxes, clearance).come_to_rest();
}

}  // namespace musim::lsdem
