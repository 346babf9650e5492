#pragma once

#include <boost/multiprecision/cpp_int.hpp>

#include <cstddef>
#include <vector>

#include "scaling/pi_quantity.hpp"

/// Linear algebra of small integer matrices without rounding or overflow. For sources only: the header of Boost.Multiprecision is heavy.
namespace musim::scaling::detail {

using Integer = boost::multiprecision::cpp_int;
using IntegerRow = std::vector<Integer>;
using IntegerMatrix = std::vector<IntegerRow>;

/// Rows of base dimensions, columns of the quantities listed in `columns`. Each row is multiplied by the denominators in it, which changes
/// neither its kernel nor its rank.
IntegerMatrix dimensional_matrix(const std::vector<PiQuantity>& quantities, const std::vector<std::size_t>& columns);

/// Rows and columns exchanged; `rows` of the result, for a matrix without rows.
IntegerMatrix transpose(const IntegerMatrix& matrix, std::size_t rows);

/// A matrix brought to diagonal form in its pivot columns, by row operations.
struct Echelon {
    IntegerMatrix rows;               ///< one per pivot, its entry in that pivot's column positive, in other pivots' zero; gcd 1
    std::vector<std::size_t> pivots;  ///< the first independent columns, lexicographically
    std::size_t columns = 0;

    std::size_t rank() const { return pivots.size(); }
    bool is_pivot(std::size_t column) const;
    /// The dependence of a column that is no pivot on the pivots: whole numbers with gcd 1, positive in that column.
    IntegerRow kernel_vector(std::size_t column) const;
};

/// Gauss-Jordan elimination without fractions.
Echelon eliminate(IntegerMatrix matrix, std::size_t columns);

/// Every column.
std::vector<std::size_t> all_columns(const std::vector<PiQuantity>& quantities);

/// Throws PiError when it does not fit.
std::int64_t to_int64(const Integer& integer);

/// numerator/denominator in lowest terms; throws as to_int64().
Rational make_rational(const Integer& numerator, const Integer& denominator);

/// The least number that makes all of them whole.
Integer common_denominator(const std::vector<Rational>& numbers);

}  // namespace musim::scaling::detail
