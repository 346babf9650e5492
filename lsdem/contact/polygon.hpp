#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "lsdem/detail/wide.hpp"
#include "lsdem/solid/solid.hpp"
#include "lsdem/types.hpp"

/// Points and planes in rows, and convex polygons that half spaces cut.
namespace musim::lsdem::detail {

/// An affine function: at + slope·x.
struct Affine {
    double at;
    Vector3 slope;
    double operator()(const Vector3& x) const { return at + slope.dot(x); }
};
inline Affine depth_below(const Plane& plane) { return {plane.offset, -plane.normal}; }
inline Affine difference(const Affine& a, const Affine& b) { return {a.at - b.at, a.slope - b.slope}; }

/// Points [m], each coordinate in a row by itself, so that a function of all goes in groups. Keeps its memory.
class Points {
  public:
    /// A function is computed for so many points at once; and so many bits has a word of marks.
    static constexpr std::size_t kGroup = 2, kWord = 64;

    std::size_t size() const { return count_; }
    bool empty() const { return count_ == 0; }
    Vector3 operator[](std::size_t i) const { return {x_[i], y_[i], z_[i]}; }
    void clear() { count_ = 0; }
    void resize(std::size_t count) {
        if (x_.size() < count) grow(count);
        count_ = count;
    }
    const double* row(std::size_t axis) const { return (axis == 0 ? x_ : axis == 1 ? y_ : z_).data(); }
    void set(std::size_t i, const Vector3& point) { x_[i] = point.x(), y_[i] = point.y(), z_[i] = point.z(); }
    void push_back(const Vector3& point) {
        resize(count_ + 1);
        set(count_ - 1, point);
    }
    void copy(const Points& from) {
        resize(from.count_);
        const std::size_t bytes = count_ * sizeof(double);
        std::memcpy(x_.data(), from.x_.data(), bytes);
        std::memcpy(y_.data(), from.y_.data(), bytes);
        std::memcpy(z_.data(), from.z_.data(), bytes);
    }
    /// Puts points [first, last) to where `to` is.
    void move(std::size_t first, std::size_t last, std::size_t to) {
        const std::size_t bytes = (last - first) * sizeof(double);
        std::memmove(&x_[to], &x_[first], bytes);
        std::memmove(&y_[to], &y_[first], bytes);
        std::memmove(&z_[to], &z_[first], bytes);
    }

    /// Values of a function at 64 points from word · 64 on, or at all that are left, into `values`, which has room for groups; and a bit
    /// for each of them, the first the lowest, that says whether its value is above zero, or, `with_zero`, no less.
    MUSIM_WIDE std::uint64_t evaluate(const Affine& function, std::size_t word, bool with_zero, double* values) const {
        using Real = double __attribute__((vector_size(16)));
        using Bits = std::uint64_t __attribute__((vector_size(16)));
        const Real at = Real{} + function.at, sx = Real{} + function.slope.x(), sy = Real{} + function.slope.y(),
                   sz = Real{} + function.slope.z(), zero{};
        const std::size_t begin = word * kWord, end = std::min(count_, begin + kWord);
        Bits marks{}, bit{1, 2};
        for (std::size_t i = begin; i < end; i += kGroup) {
            Real x, y, z;
            std::memcpy(&x, &x_[i], sizeof(Real)), std::memcpy(&y, &y_[i], sizeof(Real)), std::memcpy(&z, &z_[i], sizeof(Real));
            const Real value = at + ((sx * x + sy * y) + sz * z);
            std::memcpy(values + (i - begin), &value, sizeof(Real));
            marks |= (with_zero ? Bits(value >= zero) : Bits(value > zero)) & bit;
            bit <<= kGroup;
        }
        return (marks[0] | marks[1]) & low_bits(end - begin);
    }

    static std::uint64_t low_bits(std::size_t count) { return count == kWord ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1; }
    static std::size_t round_up_to_groups(std::size_t count) { return (count + kGroup - 1) / kGroup * kGroup; }

  private:
    void grow(std::size_t count) {
        const std::size_t room = round_up_to_groups(2 * count);
        x_.resize(room), y_.resize(room), z_.resize(room);
    }

    std::size_t count_ = 0;
    std::vector<double> x_, y_, z_;  // whose sizes are the room, in groups
};

/// Planes, each number of theirs in a row by itself.
class PlaneRows {
  public:
    void clear() { normals_.clear(), offset_.clear(); }
    void push_back(const Plane& plane) { normals_.push_back(plane.normal), offset_.push_back(plane.offset); }
    /// Depth of a point below each of the planes, into `depth` [m].
    void find_depths(const Vector3& x, std::vector<double>& depth) const;

  private:
    Points normals_;
    std::vector<double> offset_;
};

/// A bit for each of up to 64 numbers, the first the lowest: is it no more than `most`?
inline std::uint64_t mark_up_to(const double* numbers, std::size_t count, double most) {
    std::uint64_t marks = 0;
    for (std::size_t i = 0; i < count; ++i) marks |= std::uint64_t{numbers[i] <= most ? 1U : 0U} << i;
    return marks;
}
/// Calls visit(i) for the numbers up to `most`, in order.
template <class Visit>
void for_each_up_to(const std::vector<double>& numbers, std::size_t count, double most, const Visit& visit) {
    for (std::size_t begin = 0; begin < count; begin += Points::kWord) {
        const std::size_t end = std::min(count, begin + Points::kWord);
        for (std::uint64_t marks = mark_up_to(&numbers[begin], end - begin, most); marks != 0; marks &= marks - 1) {
            visit(begin + static_cast<std::size_t>(std::countr_zero(marks)));
        }
    }
}

/// Corners of a convex polygon, in order [m].
using Polygon = Points;

/// Cuts polygons; keeps its memory.
class PolygonCutter {
  public:
    /// Keeps what lies where `inside` is positive; the border counts as inside where `with_border` says so [SutherlandHodgman74].
    void clip(const Affine& inside, bool with_border, Polygon& polygon);

    /// The part of a polygon that such a clip would leave out, as `rest`; false where it would leave out none of its corners.
    bool find_rest(const Affine& inside, bool with_border, const Polygon& polygon, Polygon& rest);

  private:
    /// The same for any polygon.
    void clip_any(const Affine& inside, bool with_border, Polygon& polygon);

    std::vector<double> at_;
    Polygon whole_;
};

}  // namespace musim::lsdem::detail
