#pragma once

#include <optional>
#include <string_view>

#include "scaling/dimension.hpp"
#include "scaling/error.hpp"

namespace musim::scaling {

struct PiQuantity;

/// A positive value and its standard uncertainty u [JCGM100], in the unit of the value; u = 0: taken as exact.
struct Uncertain {
    double value = 1.0;
    double uncertainty = 0.0;

    bool is_uncertain() const { return uncertainty > 0.0; }
    double relative() const { return uncertainty / value; }
};

/// A ratio of two independent values such as the friction coefficients of model and prototype, or one value alone.
struct UncertainRatio {
    Uncertain numerator;
    std::optional<Uncertain> denominator = {};  ///< of a fraction with brackets

    double value() const { return denominator ? numerator.value / denominator->value : numerator.value; }
    bool is_uncertain() const { return numerator.is_uncertain() || (denominator && denominator->is_uncertain()); }
};

/// A quantity and its standard uncertainty.
template <QuantityWithUnit Quantity>
struct UncertainQuantity {
    Quantity value;
    Quantity uncertainty = {};

    /// Both in SI.
    Uncertain si() const { return {value.value(), uncertainty.value()}; }
};

/// Whether a text has a "+/-" or "±" in it.
bool is_marked_uncertain(std::string_view text);

/// A number or fraction as parse_number() reads it, with or without its standard uncertainty: "0.63+/-0.03", "0.63 +/- 5%", "0.63±0.03",
/// "1/107+/-1%". Behind a fraction the uncertainty is that of the quotient; a percentage is of the value.
///
/// Throws ParseError, which quotes the text: no number; an uncertainty that is negative or not finite; a value that carries an uncertainty
/// and is not positive.
Uncertain parse_uncertain(std::string_view text);

/// parse_uncertain(), or a fraction with brackets: "(0.63+/-5%)/(0.59+/-5%)", "(0.63+/-5%)/0.59", "0.63/(0.59+/-0.02)". Throws ParseError.
UncertainRatio parse_uncertain_ratio(std::string_view text);

/// A quantity with unit, with or without its standard uncertainty, in SI: "42.4+/-0.5 cm/s", "42.4 +/- 1% cm/s", "(42.4+/-0.5) cm/s",
/// "0.511 g +/- 2%", "4.25 m +/- 2 mm"; units as parse_si() reads them. A number without unit is refused unless a plain number is wanted.
/// Throws ParseError as parse_uncertain() and parse_si() do.
Uncertain parse_uncertain_si(std::string_view text, Dimension wanted);

/// A value of any quantity, with or without its standard uncertainty, in the same forms; units as parse_value() reads them, but a number
/// without unit is refused, too, unless a plain number is wanted. Throws ParseError.
Uncertain parse_uncertain_value(std::string_view text, const PiQuantity& quantity);

/// parse_uncertain_si() for the dimension of `Quantity`, e.g. parse_uncertain_quantity<Velocity>("42.4+/-0.5 cm/s").
template <QuantityWithUnit Quantity>
UncertainQuantity<Quantity> parse_uncertain_quantity(std::string_view text) {
    const Uncertain si = parse_uncertain_si(text, dimension_of<Quantity>());
    return {Quantity::from_value(si.value), Quantity::from_value(si.uncertainty)};
}

}  // namespace musim::scaling
