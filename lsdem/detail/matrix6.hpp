#pragma once

#include <Eigen/Core>

namespace musim::lsdem::detail {

/// Matrix over the motions of a block: three translations, then three rotations.
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// The largest eigenvalue of a symmetric matrix, in its unit. Compiled once, since Eigen's solver takes ten seconds to compile.
double largest_eigenvalue(const Matrix6& matrix);

}  // namespace musim::lsdem::detail
