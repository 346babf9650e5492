#include "lsdem/detail/matrix6.hpp"

#include <Eigen/Eigenvalues>

namespace musim::lsdem::detail {

double largest_eigenvalue(const Matrix6& matrix) {
    return Eigen::SelfAdjointEigenSolver<Matrix6>(matrix, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

}  // namespace musim::lsdem::detail
