#pragma once

#include <string>
#include <string_view>

#include "scaling/dimension.hpp"
#include "scaling/error.hpp"
#include "scaling/rational_dimension.hpp"

namespace musim::scaling {

/// SI value of a quantity written as text, checked against the wanted dimension.
///
/// Text is a number or fraction (parse_number) and a unit: "30 MN/m", "4.25/107 m", "0.511 g", "9.80665 m/s2", "2 kN*s/m", "5 N/(m s)".
/// Without unit the number is SI. Units combine by `*`, `·`, blank and `/` (from left to right: "cm/s/s") and carry powers ("m^2", "m2",
/// "s^-2", "m^0.5", "m^(1/3)"). Beside mechanics K, A, mol, cd, C, V and ohm are known. "g" is gravity (9.80665 m/s²) where that fits the
/// wanted dimension and gram otherwise; "kg" is always kilogram. Angles are plain numbers: "deg" is π/180, "rad" is 1, "Hz" is 1/s.
/// Prefixes n u m c d k M G T and powers of ten shift the decimal point before the number is rounded, so "12.710 mm" and "0.012710 m" are
/// the same double. Throws ParseError: no number, unknown unit (names the nearest one), wrong dimension (says what is wanted, with an
/// example).
double parse_si(std::string_view text, Dimension wanted);

/// parse_si() for what people write: a number without unit is refused unless a plain number is wanted.
double parse_si_with_unit(std::string_view text, Dimension wanted);

/// Fault of a plain number where a dimension is wanted: "the unit is missing; a stress is wanted (such as "3.5 GPa")".
std::string refuse_plain_number(const RationalDimension& wanted);

/// parse_si() for the dimension of `Quantity`, e.g. parse_quantity<Stiffness>("30 MN/m").
template <QuantityWithUnit Quantity>
Quantity parse_quantity(std::string_view text) {
    return Quantity::from_value(parse_si(text, dimension_of<Quantity>()));
}

/// SI value in the unit an engineer would write for its dimension and size: "30 MN/m", "42.4 cm/s", "0.511 g", "12.71 mm", "10.4 us".
/// `digits` are significant digits. parse_si() reads the text back. Moments share the dimension of energies and print in joules.
std::string format_si(double value, Dimension dimension, int digits = 6);

/// An SI value of any dimension in the unit that format_si() takes for `like`, so that an uncertainty stands in the unit of its value:
/// "42.4 cm/s" and "0.15 cm/s"; in base units where the dimension has none of its own.
std::string format_si_like(double value, double like, const RationalDimension& dimension, int digits = 6);

/// The SI unit of a dimension in base units: "kg m^-1 s^-2"; "1" for a plain number.
std::string si_unit(const RationalDimension& dimension);

/// format_si() for a typed quantity.
template <QuantityWithUnit Quantity>
std::string format_quantity(Quantity quantity, int digits = 6) {
    return format_si(quantity.value(), dimension_of<Quantity>(), digits);
}

}  // namespace musim::scaling
