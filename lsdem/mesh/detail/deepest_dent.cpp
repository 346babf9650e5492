#include "lsdem/mesh/detail/deepest_dent.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace musim::lsdem::detail {
namespace {

/// Looks for the deepest point among edges given one after the other. Most are passed by one face to which they are near: that of the edge
/// before, since files list neighbours together.
class DentSearch {
  public:
    DentSearch(const Polyhedron& hull, double floor) : dent_{.depth = floor, .place = Vector3::Zero()} {
        for (const Polyhedron::Face& face : hull.faces) planes_.push_back(face.plane);
    }

    void look_along(const Vector3& from, const Vector3& to) {
        const auto is_passed = [&](const Plane& plane) { return std::max(plane.depth(from), plane.depth(to)) <= dent_.depth; };
        if (is_passed(planes_[near_])) return;
        const auto near = std::find_if(planes_.begin(), planes_.end(), is_passed);
        if (near != planes_.end()) {
            near_ = static_cast<std::size_t>(near - planes_.begin());
            return;
        }
        // the depth along the edge is the least of linear functions: from both ends their lowest lines are followed to where they cross
        double low = 0.0, high = 1.0;
        std::size_t left = find_nearest(from), right = find_nearest(to);
        near_ = left;
        take(from, left);
        take(to, right);
        for (std::size_t tries = 0; tries < planes_.size(); ++tries) {
            const Line rising = find_line(left, from, to), falling = find_line(right, from, to);
            if (rising.slope <= 0.0 || falling.slope >= 0.0) return;
            const double at = (falling.start - rising.start) / (rising.slope - falling.slope);
            if (!(at > low && at < high)) return;
            const Vector3 x = from + at * (to - from);
            const std::size_t nearest = find_nearest(x);
            take(x, nearest);
            if (nearest == left || nearest == right) return;
            const double slope = find_line(nearest, from, to).slope;
            (slope > 0.0 ? left : right) = nearest;
            (slope > 0.0 ? low : high) = at;
        }
    }

    const Dent& dent() const { return dent_; }

  private:
    /// Depth below a plane along an edge: start + slope·t, t from 0 to 1.
    struct Line {
        double start = 0.0, slope = 0.0;
    };

    Line find_line(std::size_t plane, const Vector3& from, const Vector3& to) const {
        const double start = planes_[plane].depth(from);
        return {.start = start, .slope = planes_[plane].depth(to) - start};
    }
    std::size_t find_nearest(const Vector3& x) const {
        std::size_t nearest = 0;
        for (std::size_t p = 1; p < planes_.size(); ++p) {
            if (planes_[p].depth(x) < planes_[nearest].depth(x)) nearest = p;
        }
        return nearest;
    }
    void take(const Vector3& x, std::size_t nearest) {
        const double depth = planes_[nearest].depth(x);
        if (depth > dent_.depth) dent_ = {.depth = depth, .place = x};
    }

    std::vector<Plane> planes_;
    Dent dent_;
    std::size_t near_ = 0;
};

}  // namespace

Dent find_deepest_dent(const ClosedPart& part, std::span<const Vector3> corners, const Polyhedron& hull, double floor) {
    DentSearch search(hull, floor);
    for (const ClosedPart::Face& face : part.faces) {
        const auto loop = part.loop(face);
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const std::uint32_t from = loop[i], to = loop[(i + 1) % loop.size()];
            if (from < to) search.look_along(corners[from], corners[to]);
        }
    }
    return search.dent().depth > floor ? search.dent() : Dent{};
}

}  // namespace musim::lsdem::detail
