#include "scaling/quantity_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "scaling/detail/dimension_names.hpp"
#include "scaling/detail/number_text.hpp"
#include "scaling/detail/unit_text.hpp"
#include "scaling/shorten.hpp"

namespace musim::scaling {

namespace {

/// The unit in the reading of "g" that fits the wanted dimension.
detail::Unit parse_unit_for(std::string_view unit_text, Dimension wanted, std::string_view text) {
    const detail::Unit unit = detail::parse_unit(unit_text, detail::GramOrGravity::gram, text);
    if (unit.dimension == RationalDimension(wanted)) return unit;
    const detail::Unit with_gravity = detail::parse_unit(unit_text, detail::GramOrGravity::gravity, text);
    if (with_gravity.dimension == RationalDimension(wanted)) return with_gravity;
    throw ParseError(
        fmt::format("\"{}\": {}, this is {}", shorten(text, kEchoed), detail::describe_wish(wanted), detail::describe(unit.dimension)));
}

}  // namespace

double parse_si(std::string_view text, Dimension wanted) {
    const detail::NumberText number = detail::split_number(text);
    if (number.rest.empty()) return detail::to_double(number, 0, text);
    const detail::Unit unit = parse_unit_for(number.rest, wanted, text);
    const double value = detail::to_double(number, unit.decimal_exponent, text) * unit.numerator / unit.denominator;
    if (!std::isfinite(value))
        throw ParseError(fmt::format("\"{}\": the value is too large for a double; check number and unit", shorten(text, kEchoed)));
    return value;
}

double parse_si_with_unit(std::string_view text, Dimension wanted) {
    const double value = parse_si(text, wanted);
    if (wanted == Dimension{} || !detail::split_number(text).rest.empty()) return value;
    throw ParseError(fmt::format("\"{}\": {}", shorten(text, kEchoed), refuse_plain_number(wanted)));
}

std::string refuse_plain_number(const RationalDimension& wanted) {
    return fmt::format("the unit is missing; {}", detail::describe_wish(wanted));
}

std::string format_si(double value, Dimension dimension, int digits) { return format_si_like(value, value, dimension, digits); }

std::string si_unit(const RationalDimension& dimension) { return dimension.is_dimensionless() ? "1" : detail::base_units(dimension); }

std::string format_si_like(double value, double like, const RationalDimension& dimension, int digits) {
    const detail::DimensionName* known = detail::find_dimension_name(dimension);
    if (known == nullptr) return fmt::format("{:.{}g} {}", value, digits, detail::base_units(dimension));

    // zero has no size of its own: print it in the largest unit not above the SI unit
    const double size = like == 0.0 ? 1.0 : std::abs(like);
    const detail::DisplayUnit* chosen = &known->display_units.front();
    for (const detail::DisplayUnit& unit : known->display_units) {
        if (size >= unit.from) chosen = &unit;
    }
    return fmt::format("{:.{}g}{}{}", value / chosen->size, digits, chosen->name.empty() ? "" : " ", chosen->name);
}

}  // namespace musim::scaling
