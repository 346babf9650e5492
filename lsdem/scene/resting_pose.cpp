#include "lsdem/scene/resting_pose.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "lsdem/scene/detail/overlap.hpp"

namespace musim::lsdem::scene {
namespace {

/// Heights that differ by less than this part of the footprint are one: rounding of coordinates, not geometry.
constexpr double kSameHeight = 1e-12;

/// Looks for the face under the centre of mass; it is found after one or two unless the box is about to topple.
constexpr int kMaxLooks = 8;

/// Halvings of the tilt until a box clears its neighbors.
constexpr int kHalvings = 10;

/// Sweeps over the structure. With one, as if nothing lay on the blocks, a ring of ten layers topples while it settles; with eight it does
/// not (lsdem/study/README.md).
constexpr int kSweeps = 8;

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
    Vector3 to_world(const Vector3& point) const {
        return middle + point.x() * along_u + point.y() * along_v + point.z() * Vector3::UnitZ();
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
        if ((over_a < 0.0 && over_b > 0.0) || (over_a > 0.0 && over_b < 0.0)) kept.push_back(a + (b - a) * (over_a / (over_a - over_b)));
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
    Support support;
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
    RestingPlane& plane = facet.support.plane;
    plane.slope_u = (rise_b * (c.y() - a.y()) - rise_c * (b.y() - a.y())) / area;
    plane.slope_v = (rise_c * (b.x() - a.x()) - rise_b * (c.x() - a.x())) / area;
    plane.height = a.z() - plane.slope_u * a.x() - plane.slope_v * a.y();
    facet.support.part = {1.0 - at_b - at_c, at_b, at_c};
    facet.area = std::abs(area);
    facet.value = a.z() + at_b * rise_b + at_c * rise_c;
    return facet;
}

/// The face of the upper hull over (u, v): of all triangles around it the one that is highest there; of equally high ones the largest.
std::optional<Support> find_upper_face(std::span<const Vector3> points, double u, double v, double extent) {
    std::optional<Facet> best;
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t j = i + 1; j < points.size(); ++j) {
            for (std::size_t k = j + 1; k < points.size(); ++k) {
                std::optional<Facet> facet = find_facet(points[i], points[j], points[k], u, v);
                if (!facet) continue;
                facet->support.point = {i, j, k};
                const double gain = best ? facet->value - best->value : extent;
                if (gain > kSameHeight * extent || (gain >= -kSameHeight * extent && facet->area > best->area)) best = facet;
            }
        }
    }
    if (!best) return std::nullopt;
    return best->support;
}

double highest(std::span<const Vector3> points) {
    double height = points.front().z();
    for (const Vector3& point : points) height = std::max(height, point.z());
    return height;
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
    std::vector<std::size_t> carriers;   ///< boxes below that may carry it
    std::vector<std::size_t> neighbors;  ///< boxes of its layer that may be in its way
    std::vector<Vector3> points;
    std::vector<std::size_t> carrier_of_point;
    Support support;
    Load load;
};

/// All boxes, swept from the ground up and from the top down.
class Structure {
  public:
    Structure(std::span<BoxPose> boxes, std::span<const int> layer) : boxes_(boxes), layer_(layer), settlers_(boxes.size()) {
        std::size_t below = 0, first = 0;
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            if (layer[i] != layer[first]) below = first, first = i;
            settlers_[i].upright = boxes[i];
            for (std::size_t j = below; j < first; ++j)
                if (near(boxes[i], boxes[j])) settlers_[i].carriers.push_back(j);
            for (std::size_t j = first; j < i; ++j) {
                if (!near(boxes[i], boxes[j])) continue;
                settlers_[i].neighbors.push_back(j);
                settlers_[j].neighbors.push_back(i);
            }
        }
    }

    /// Places all boxes, each for the load it had.
    void rise() {
        for (std::size_t first = 0, last = 0; first < boxes_.size(); first = last) {
            while (last < boxes_.size() && layer_[last] == layer_[first]) ++last;
            for (std::size_t i = first; i < last; ++i) find_support(i);
            for (int pass = 0; pass < kPasses; ++pass)
                for (std::size_t i = first; i < last; ++i) boxes_[i] = pose(i, find_free_part(i));
        }
    }

    /// Finds what each box bears where it stands.
    void press() {
        std::vector<double> force(boxes_.size(), 0.0);
        std::vector<Vector3> moment(boxes_.size(), Vector3::Zero());
        for (std::size_t i = boxes_.size(); i-- > 0;) {
            Settler& settler = settlers_[i];
            const double weight = settler.upright.size.prod();
            const Vector3 place = force[i] > 0.0 ? Footprint(settler.upright).to_local(moment[i] / force[i]) : Vector3(Vector3::Zero());
            settler.load = {force[i] / weight, place.x(), place.y()};
            if (settler.carrier_of_point.empty()) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t point = settler.support.point[k], carrier = settler.carrier_of_point[point];
                const double part = settler.support.part[k] * (weight + force[i]);
                force[carrier] += part;
                moment[carrier] += part * Footprint(settler.upright).to_world(settler.points[point]);
            }
        }
    }

  private:
    void find_support(std::size_t i) {
        Settler& settler = settlers_[i];
        settler.points.clear();
        settler.carrier_of_point.clear();
        for (const std::size_t carrier : settler.carriers) {
            const std::vector<Vector3> points = cut_top(settler.upright, boxes_[carrier]);
            settler.points.insert(settler.points.end(), points.begin(), points.end());
            settler.carrier_of_point.insert(settler.carrier_of_point.end(), points.size(), carrier);
        }
        if (settler.points.empty()) {
            double ground = 0.0;
            for (const std::size_t carrier : settler.carriers) ground = std::max(ground, find_top(boxes_.subspan(carrier, 1)));
            settler.points.emplace_back(0.0, 0.0, ground);
        }
        const Vector3& size = settler.upright.size;
        settler.support = find_resting_plane(settler.points, size.z(), std::hypot(size.x(), size.y()), settler.load);
        boxes_[i] = pose(i, 0.0);
    }

    BoxPose pose(std::size_t i, double part) const {
        return tilt_onto(settlers_[i].upright, settlers_[i].support.plane, settlers_[i].points, part);
    }

    bool is_free(std::size_t i, double part) const {
        const BoxPose tilted = pose(i, part);
        return std::none_of(settlers_[i].neighbors.begin(), settlers_[i].neighbors.end(), [&](std::size_t j) {
            const double edge = std::min(tilted.size.minCoeff(), boxes_[j].size.minCoeff());
            return detail::compute_overlap(to_body(tilted), to_body(boxes_[j])) > detail::kTouchingTolerance * edge;
        });
    }

    double find_free_part(std::size_t i) const {
        if (is_free(i, 1.0)) return 1.0;
        double low = 0.0, high = 1.0;
        for (int halving = 0; halving < kHalvings; ++halving) {
            const double middle = 0.5 * (low + high);
            (is_free(i, middle) ? low : high) = middle;
        }
        return low;
    }

    std::span<BoxPose> boxes_;
    std::span<const int> layer_;
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

Support find_resting_plane(std::span<const Vector3> points, double height, double extent, const Load& load) {
    Support support{{highest(points), 0.0, 0.0}, {}, {}};
    for (int look = 0; look < kMaxLooks; ++look) {
        const RestingPlane before = support.plane;
        const double lean = -0.5 * height / std::sqrt(1.0 + before.slope_u * before.slope_u + before.slope_v * before.slope_v);
        const double u = (lean * before.slope_u + load.over_weight * load.u) / (1.0 + load.over_weight);
        const double v = (lean * before.slope_v + load.over_weight * load.v) / (1.0 + load.over_weight);
        const auto face = find_upper_face(points, u, v, extent);
        if (!face) return support;
        support = *face;
        if (support.plane.slope_u == before.slope_u && support.plane.slope_v == before.slope_v) break;
    }
    return support;
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

void put_to_rest(std::span<BoxPose> boxes, std::span<const int> layer) {
    Structure structure(boxes, layer);
    structure.rise();
    for (int sweep = 1; sweep < kSweeps; ++sweep) {
        structure.press();
        structure.rise();
    }
}

}  // namespace musim::lsdem::scene
