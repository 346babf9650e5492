#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "lsdem/types.hpp"

namespace musim::lsdem {

/// Signed distance φ to a box in closed form: negative inside, in its body frame [m].
struct BoxLevelSet {
    Vector3 half = Vector3::Zero();  ///< half edge lengths [m]

    /// φ(x) [m].
    double value(const Vector3& x) const;
    /// ∇φ(x), of unit length; inside, the outward normal of the nearest face.
    Vector3 gradient(const Vector3& x) const;
};

/// Signed distance φ on a regular grid, trilinear in between, in the body frame. Outside the grid φ is the value at the nearest grid
/// border plus the distance to it.
class GridLevelSet {
  public:
    GridLevelSet() = default;
    /// Samples `distance` [m] on the nodes origin + spacing·(i, j, k) with 0 ≤ i < counts[0], and likewise j, k. Throws
    /// std::invalid_argument when a count is below 2 or the spacing is not positive.
    GridLevelSet(const Vector3& origin, double spacing, std::array<std::size_t, 3> counts,
                 const std::function<double(const Vector3&)>& distance);

    /// φ(x) [m].
    double value(const Vector3& x) const;
    /// Gradient of the trilinear interpolant; not normalised.
    Vector3 gradient(const Vector3& x) const;

    const Vector3& origin() const { return origin_; }
    double spacing() const { return spacing_; }
    const std::array<std::size_t, 3>& counts() const { return counts_; }
    const std::vector<double>& values() const { return values_; }  ///< φ at the nodes, i fastest, then j [m]

  private:
    /// Lower corner of the cell that holds a point, and the point's place in it, 0...1 along each axis.
    struct Cell {
        std::array<std::size_t, 3> index;
        Vector3 fraction;
        Vector3 clamped;  ///< the point, moved to the grid's border when it lies outside [m]
    };
    Cell find_cell(const Vector3& x) const;
    double at(std::size_t i, std::size_t j, std::size_t k) const { return values_[(k * counts_[1] + j) * counts_[0] + i]; }

    Vector3 origin_ = Vector3::Zero();
    double spacing_ = 0.0;
    std::array<std::size_t, 3> counts_{};
    std::vector<double> values_;
};

}  // namespace musim::lsdem
