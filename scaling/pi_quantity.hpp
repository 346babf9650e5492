#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scaling/error.hpp"
#include "scaling/rational_dimension.hpp"

namespace musim::scaling {

/// A problem that the Pi theorem cannot take: names, units, repeating variables, groups. One line that names the culprit.
class PiError : public SimilitudeError {
  public:
    using SimilitudeError::SimilitudeError;
};

/// A quantity that a physical problem depends on.
struct PiQuantity {
    std::string name;
    RationalDimension dimension;
    std::optional<double> value;  ///< [SI]
    bool is_angle = false;        ///< given in rad or deg: a plain number all the same
    double uncertainty = 0.0;     ///< standard, of the value [SI]; 0: taken as exact
};

/// Exponents of a dimensionless product, one per quantity of the problem and in its order: whole numbers without common divisor.
using PiGroup = std::vector<std::int64_t>;

/// A quantity from texts: a unit by the grammar of parse_si() ("MN/m", "kg m^-3", "MPa m^0.5", "W/(m K)"; empty, "1" or "-" for a plain
/// number; "g" is gram, "gn" gravity) and, if there is one, its value in that unit, a number or fraction. Throws PiError, ParseError.
PiQuantity make_pi_quantity(std::string_view name, std::string_view unit, std::optional<std::string_view> value = std::nullopt);

/// SI value of a text such as "29.2 GPa" for a quantity, by the grammar of parse_si(): "g" is gravity for an acceleration. Throws
/// ParseError.
double parse_value(std::string_view text, const PiQuantity& quantity);

/// An SI value of a quantity in the unit an engineer would write, or in base units where its dimension has none.
std::string format_value(double value, const PiQuantity& quantity, int digits = 6);

/// Throws PiError when there is no quantity, two have the same name, or a name cannot stand in a product: empty, a digit or blank first or
/// a blank last, or with one of * / ^ ( ) , in it; or when a value is not positive and finite.
void check_quantities(const std::vector<PiQuantity>& quantities);

/// Position of the quantity called `name`. Throws PiError, which names the nearest or else all; `owner` has them, for its message.
std::size_t find_quantity(const std::vector<PiQuantity>& quantities, std::string_view name, std::string_view owner = "the problem");

/// Dimension of Π quantities^exponents. Throws SimilitudeError when an exponent leaves 64 bits.
RationalDimension dimension_of_product(const std::vector<Rational>& exponents, const std::vector<PiQuantity>& quantities);

/// Value of a group; none when a quantity in it has no value, or the result none that a double can hold. Scaling SI units by powers of two
/// leaves the same bits.
std::optional<double> group_value(const PiGroup& group, const std::vector<PiQuantity>& quantities);

}  // namespace musim::scaling
