#include "scaling/detail/integer_matrix.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace musim::scaling::detail {

namespace {

/// Divides a row by the greatest common divisor of its entries.
void reduce(IntegerRow& row) {
    Integer divisor = 0;
    for (const Integer& entry : row) divisor = boost::multiprecision::gcd(divisor, entry);
    if (divisor <= 1) return;
    for (Integer& entry : row) entry /= divisor;
}

}  // namespace

IntegerMatrix dimensional_matrix(const std::vector<PiQuantity>& quantities, const std::vector<std::size_t>& columns) {
    IntegerMatrix matrix;
    for (const BaseDimension base : kBaseDimensions) {
        Integer common = 1;
        for (const std::size_t j : columns) {
            common = boost::multiprecision::lcm(common, Integer(quantities[j].dimension[base].denominator()));
        }
        IntegerRow row;
        for (const std::size_t j : columns) {
            const Rational& exponent = quantities[j].dimension[base];
            row.emplace_back(common / exponent.denominator() * exponent.numerator());
        }
        matrix.push_back(std::move(row));
    }
    return matrix;
}

IntegerMatrix transpose(const IntegerMatrix& matrix, std::size_t rows) {
    IntegerMatrix result(rows);
    for (const IntegerRow& row : matrix) {
        for (std::size_t j = 0; j < rows; ++j) result[j].push_back(row[j]);
    }
    return result;
}

bool Echelon::is_pivot(std::size_t column) const { return std::binary_search(pivots.begin(), pivots.end(), column); }

IntegerRow Echelon::kernel_vector(std::size_t column) const {
    // the least multiple of the column that the pivots make up in whole numbers
    Integer multiple = 1;
    for (std::size_t k = 0; k < rank(); ++k) {
        const Integer& pivot = rows[k][pivots[k]];
        multiple = boost::multiprecision::lcm(multiple, Integer(pivot / boost::multiprecision::gcd(pivot, rows[k][column])));
    }
    IntegerRow vector(columns, 0);
    vector[column] = multiple;
    for (std::size_t k = 0; k < rank(); ++k) vector[pivots[k]] = -multiple * rows[k][column] / rows[k][pivots[k]];
    return vector;
}

Echelon eliminate(IntegerMatrix matrix, std::size_t columns) {
    Echelon echelon;
    echelon.columns = columns;
    for (std::size_t column = 0; column < columns && echelon.rank() < matrix.size(); ++column) {
        const std::size_t k = echelon.rank();
        const auto pivot_row = std::find_if(matrix.begin() + static_cast<std::ptrdiff_t>(k), matrix.end(),
                                            [column](const IntegerRow& row) { return row[column] != 0; });
        if (pivot_row == matrix.end()) continue;
        std::swap(matrix[k], *pivot_row);
        if (matrix[k][column] < 0) {
            for (Integer& entry : matrix[k]) entry = -entry;
        }
        reduce(matrix[k]);
        const Integer pivot = matrix[k][column];
        for (std::size_t i = 0; i < matrix.size(); ++i) {
            if (i == k || matrix[i][column] == 0) continue;
            const Integer entry = matrix[i][column];
            for (std::size_t j = 0; j < columns; ++j) matrix[i][j] = matrix[i][j] * pivot - entry * matrix[k][j];
            reduce(matrix[i]);
        }
        echelon.pivots.push_back(column);
    }
    matrix.resize(echelon.rank());
    echelon.rows = std::move(matrix);
    return echelon;
}

std::vector<std::size_t> all_columns(const std::vector<PiQuantity>& quantities) {
    std::vector<std::size_t> columns(quantities.size());
    std::iota(columns.begin(), columns.end(), std::size_t{0});
    return columns;
}

std::int64_t to_int64(const Integer& integer) {
    constexpr std::int64_t kLargest = std::numeric_limits<std::int64_t>::max();
    if (integer > kLargest || integer < -kLargest) {
        throw PiError("an exponent of a group does not fit 64 bits; check the powers of the units");
    }
    return static_cast<std::int64_t>(integer);
}

Rational make_rational(const Integer& numerator, const Integer& denominator) {
    const Integer divisor = boost::multiprecision::gcd(numerator, denominator);
    return {to_int64(numerator / divisor), to_int64(denominator / divisor)};
}

Integer common_denominator(const std::vector<Rational>& numbers) {
    Integer common = 1;
    for (const Rational& number : numbers) common = boost::multiprecision::lcm(common, Integer(number.denominator()));
    return common;
}

}  // namespace musim::scaling::detail
