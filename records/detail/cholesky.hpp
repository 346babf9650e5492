#pragma once

#include <cstddef>
#include <vector>

namespace musim::records::detail {

/// A square matrix, row by row.
struct SquareMatrix {
    explicit SquareMatrix(std::size_t n) : size(n), values(n * n, 0.0) {}

    double& at(std::size_t row, std::size_t column) { return values[row * size + column]; }
    double at(std::size_t row, std::size_t column) const { return values[row * size + column]; }

    std::size_t size;
    std::vector<double> values;
};

/// x of M x = b by M = L Lᵀ, for a symmetric positive definite M, of which the lower half is read.
std::vector<double> solve_cholesky(SquareMatrix matrix, std::vector<double> right);

}  // namespace musim::records::detail
