#include "records/detail/cholesky.hpp"

#include <cmath>

namespace musim::records::detail {

std::vector<double> solve_cholesky(SquareMatrix matrix, std::vector<double> right) {
    // L in the lower half, row by row
    for (std::size_t i = 0; i < matrix.size; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            double rest = matrix.at(i, j);
            for (std::size_t k = 0; k < j; ++k) rest -= matrix.at(i, k) * matrix.at(j, k);
            matrix.at(i, j) = i == j ? std::sqrt(rest) : rest / matrix.at(j, j);
        }
    }

    // L y = b downwards, Lᵀ x = y upwards
    for (std::size_t i = 0; i < matrix.size; ++i) {
        for (std::size_t k = 0; k < i; ++k) right[i] -= matrix.at(i, k) * right[k];
        right[i] /= matrix.at(i, i);
    }
    for (std::size_t i = matrix.size; i-- > 0;) {
        for (std::size_t k = i + 1; k < matrix.size; ++k) right[i] -= matrix.at(k, i) * right[k];
        right[i] /= matrix.at(i, i);
    }
    return right;
}

}  // namespace musim::records::detail
