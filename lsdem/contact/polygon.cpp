#include "lsdem/contact/polygon.hpp"

#include <array>
#include <bit>

namespace musim::lsdem::detail {
namespace {

/// The point between two at which a function, of values `a` and `b` there, is zero.
inline Vector3 find_crossing(const Vector3& from, const Vector3& to, double a, double b) { return from + a / (a - b) * (to - from); }

/// Corners of a polygon of up to 64 that a clip keeps or leaves out, where both are one run: of a convex one they are, but for rounding.
struct CornerRuns {
    std::uint64_t kept, cut;
    std::size_t first_cut, after_cut;  ///< the run that is left out, round the polygon: `after_cut` is the first that is kept
    bool are_two;

    CornerRuns(std::uint64_t holds, std::size_t count)
        : kept(holds), cut(~holds & Points::low_bits(count)), first_cut(0), after_cut(0), are_two(false) {
        if (kept == 0 || cut == 0) return;
        // a run that begins at the first corner may begin before
        const bool starts_kept = (kept & 1U) != 0;
        const auto second = static_cast<std::size_t>(std::countr_zero(starts_kept ? cut : kept));
        const std::uint64_t from_second = (starts_kept ? cut : kept) >> second;
        const std::size_t end = second + static_cast<std::size_t>(std::countr_one(from_second)), third = end == count ? 0 : end;
        are_two = (from_second & (from_second + 1)) == 0;
        first_cut = starts_kept ? second : third, after_cut = starts_kept ? third : second;
    }
};

}  // namespace

void PlaneRows::find_depths(const Vector3& x, std::vector<double>& depth) const {
    const std::size_t count = offset_.size();
    if (depth.size() < count) depth.resize(count);
    const double *const nx = normals_.row(0), *const ny = normals_.row(1), *const nz = normals_.row(2), *const offset = offset_.data();
    const double x0 = x.x(), x1 = x.y(), x2 = x.z();
    double* const result = depth.data();
    for (std::size_t k = 0; k < count; ++k) result[k] = offset[k] - ((nx[k] * x0 + ny[k] * x1) + nz[k] * x2);
}

void PolygonCutter::clip(const Affine& inside, bool with_border, Polygon& polygon) {
    const std::size_t count = polygon.size();
    if (count > Polygon::kWord) return clip_any(inside, with_border, polygon);
    std::array<double, Polygon::kWord> at;
    const std::uint64_t kept = polygon.evaluate(inside, 0, with_border, at.data());
    if (kept == Polygon::low_bits(count)) return;
    if (kept == 0) return polygon.clear();
    const CornerRuns runs(kept, count);
    if (!runs.are_two) return clip_any(inside, with_border, polygon);
    const auto cross = [&](std::size_t i, std::size_t next) { return find_crossing(polygon[i], polygon[next], at[i], at[next]); };
    const std::size_t first = runs.first_cut, after = runs.after_cut;
    const std::size_t before_first = (first == 0 ? count : first) - 1, last = (after == 0 ? count : after) - 1;
    const Vector3 leaving = cross(before_first, first), coming = cross(last, after);
    if ((runs.kept & 1U) != 0) {
        // what is kept goes on behind the cut, or ends there
        const std::size_t behind = after == 0 ? 0 : count - after, to = first + 2;
        polygon.resize(std::max(count, to + behind));
        if (to != after && behind > 0) polygon.move(after, count, to);
        polygon.set(first, leaving), polygon.set(first + 1, coming);
        polygon.resize(to + behind);
    } else {
        const std::size_t end = first == 0 ? count : first, length = end - after;
        polygon.resize(std::max(count, length + 2));
        if (after != 1) polygon.move(after, end, 1);
        polygon.set(0, coming), polygon.set(length + 1, leaving);
        polygon.resize(length + 2);
    }
}

bool PolygonCutter::find_rest(const Affine& inside, bool with_border, const Polygon& polygon, Polygon& rest) {
    const std::size_t count = polygon.size();
    const auto clip_copy = [&] {
        rest.copy(polygon);
        clip({-inside.at, -inside.slope}, !with_border, rest);
        return !rest.empty();
    };
    if (count > Polygon::kWord) return clip_copy();
    std::array<double, Polygon::kWord> at;
    const CornerRuns runs(polygon.evaluate(inside, 0, with_border, at.data()), count);
    if (runs.cut == 0) return false;
    if (!runs.are_two) return clip_copy();
    const auto cross = [&](std::size_t i, std::size_t next) { return find_crossing(polygon[i], polygon[next], at[i], at[next]); };
    const std::size_t first = runs.first_cut, after = runs.after_cut;
    rest.clear();
    rest.push_back(cross((first == 0 ? count : first) - 1, first));
    std::size_t i = first, last = first;
    for (; i != after; i = i + 1 == count ? 0 : i + 1) rest.push_back(polygon[i]), last = i;
    rest.push_back(cross(last, after));
    return true;
}

void PolygonCutter::clip_any(const Affine& inside, bool with_border, Polygon& polygon) {
    const std::size_t count = polygon.size();
    at_.resize(count);
    for (std::size_t i = 0; i < count; ++i) at_[i] = inside(polygon[i]);
    const auto holds = [&](std::size_t i) { return with_border ? at_[i] >= 0.0 : at_[i] > 0.0; };
    whole_.clear();
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t next = i + 1 == count ? 0 : i + 1;
        if (holds(i)) whole_.push_back(polygon[i]);
        if (holds(i) != holds(next)) whole_.push_back(find_crossing(polygon[i], polygon[next], at_[i], at_[next]));
    }
    std::swap(whole_, polygon);
}

}  // namespace musim::lsdem::detail
