#include "scaling/uncertain.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <string>

#include "scaling/detail/number_text.hpp"
#include "scaling/number.hpp"
#include "scaling/pi_quantity.hpp"
#include "scaling/quantity_text.hpp"
#include "scaling/shorten.hpp"

namespace musim::scaling {

namespace {

/// A text in two at its first "+/-" or "±".
struct Marked {
    std::string_view value;
    std::string_view uncertainty;
};

std::optional<Marked> split_at_mark(std::string_view text) {
    for (const std::string_view mark : {std::string_view("+/-"), std::string_view("±")}) {
        const std::size_t at = text.find(mark);
        if (at != std::string_view::npos) return Marked{text.substr(0, at), text.substr(at + mark.size())};
    }
    return std::nullopt;
}

[[noreturn]] void fail(std::string_view text, std::string_view why) {
    throw ParseError(fmt::format("\"{}\": {}", shorten(text, kEchoed), why));
}

/// Text behind the mark: a number, perhaps "%", perhaps a unit.
struct UncertaintyText {
    double number = 0.0;
    bool is_share = false;  ///< a percentage, already divided by 100
    std::string_view unit;
};

UncertaintyText read_uncertainty(std::string_view uncertainty, std::string_view text) {
    detail::NumberText number;
    try {
        number = detail::split_number(uncertainty);
    } catch (const ParseError&) {
        fail(text, fmt::format("the uncertainty \"{}\" is not a finite number; write one such as 0.03 or 5%", detail::trim(uncertainty)));
    }
    if (!number.denominator.empty()) {
        fail(text, "it is not clear what is divided; put brackets around both, such as (0.63+/-0.03)/(0.59+/-0.02)");
    }
    UncertaintyText read{.number = detail::to_double(number, 0, text), .is_share = number.rest.starts_with('%'), .unit = number.rest};
    if (read.is_share) {
        read.number /= 100.0;
        read.unit = detail::trim(read.unit.substr(1));
    }
    return read;
}

/// Value and uncertainty if they can be that.
Uncertain make_uncertain(double value, double uncertainty, std::string_view text) {
    if (!(value > 0.0)) fail(text, fmt::format("the value is {:g} (must be positive to carry an uncertainty); correct it", value));
    if (!(uncertainty >= 0.0)) fail(text, fmt::format("the uncertainty is {:g} (must not be negative); drop the sign", uncertainty));
    if (!std::isfinite(uncertainty)) fail(text, "the uncertainty is too large for a double; check it");
    return {value, uncertainty};
}

/// The text between "(" and its ")", which is `text` without them; what follows goes to `rest`.
std::string_view take_brackets(std::string_view part, std::string_view& rest, std::string_view text) {
    const std::size_t end = part.find(')');
    if (end == std::string_view::npos) fail(text, "a closing bracket is missing");
    rest = detail::trim(part.substr(end + 1));
    return part.substr(1, end - 1);
}

/// One side of a fraction, with or without brackets.
Uncertain parse_side(std::string_view side, std::string_view text) {
    std::string_view inside = detail::trim(side);
    if (inside.starts_with('(')) {
        std::string_view rest;
        inside = take_brackets(inside, rest, text);
        if (!rest.empty()) fail(text, fmt::format("unexpected \"{}\" behind the fraction", rest));
    }
    return parse_uncertain(inside);
}

UncertainRatio make_ratio(const Uncertain& numerator, const Uncertain& denominator, std::string_view text) {
    if (denominator.value == 0.0) fail(text, "division by zero; give a nonzero denominator");
    return {numerator, denominator};
}

/// A quantity by `read`, which turns number and unit into SI, with its uncertainty; with a unit unless a plain number is wanted.
Uncertain parse_with_unit(std::string_view text, const std::function<double(std::string_view)>& read, const RationalDimension& wanted) {
    const bool wants_unit = !wanted.is_dimensionless();
    const auto with_unit = [](std::string_view number, std::string_view unit) { return fmt::format("{} {}", detail::trim(number), unit); };
    const auto marked = split_at_mark(text);
    if (!marked) {
        const double value = read(text);
        if (wants_unit && detail::split_number(text).rest.empty()) fail(text, refuse_plain_number(wanted));
        return {value, 0.0};
    }

    // brackets around both numbers: the unit of both follows
    std::string_view value = detail::trim(marked->value);
    std::string_view behind = marked->uncertainty;
    std::string_view unit;
    const bool bracketed = value.starts_with('(');
    if (bracketed) {
        const std::size_t end = behind.find(')');
        if (end == std::string_view::npos) fail(text, "a closing bracket is missing");
        value.remove_prefix(1);
        unit = detail::trim(behind.substr(end + 1));
        behind = behind.substr(0, end);
    }

    // else it stands behind the uncertainty, or behind each
    const UncertaintyText uncertainty = read_uncertainty(behind, text);
    const std::string_view own_unit = detail::split_number(value).rest;
    if (bracketed && !(own_unit.empty() && uncertainty.unit.empty())) fail(text, "the unit belongs behind the brackets");
    if (!bracketed) unit = uncertainty.unit;
    if (uncertainty.is_share && !own_unit.empty() && !unit.empty()) fail(text, "there are two units; a percentage needs none of its own");
    if (!uncertainty.is_share && !own_unit.empty() && unit.empty()) fail(text, "the uncertainty has no unit; give it one, or a percentage");
    if (wants_unit && own_unit.empty() && unit.empty()) fail(text, refuse_plain_number(wanted));

    const double si = read(own_unit.empty() ? with_unit(value, unit) : std::string(value));
    if (uncertainty.is_share) return make_uncertain(si, uncertainty.number * si, text);
    return make_uncertain(si, read(bracketed ? with_unit(behind, unit) : std::string(behind)), text);
}

}  // namespace

bool is_marked_uncertain(std::string_view text) { return split_at_mark(text).has_value(); }

Uncertain parse_uncertain(std::string_view text) {
    const auto marked = split_at_mark(text);
    if (!marked) return {parse_number(text), 0.0};
    const double value = parse_number(marked->value);
    const UncertaintyText uncertainty = read_uncertainty(marked->uncertainty, text);
    if (!uncertainty.unit.empty()) {
        fail(text, fmt::format("unexpected \"{}\" after the uncertainty; a plain number has no unit", uncertainty.unit));
    }
    return make_uncertain(value, uncertainty.is_share ? uncertainty.number * value : uncertainty.number, text);
}

UncertainRatio parse_uncertain_ratio(std::string_view text) {
    const std::string_view trimmed = detail::trim(text);
    if (trimmed.starts_with('(')) {
        std::string_view rest;
        const std::string_view inside = take_brackets(trimmed, rest, text);
        if (rest.empty()) return {parse_uncertain(inside)};
        if (!rest.starts_with('/')) {
            fail(text, fmt::format("unexpected \"{}\" after the bracket; a fraction is wanted, such as (0.63+/-5%)/(0.59+/-5%)", rest));
        }
        return make_ratio(parse_uncertain(inside), parse_side(rest.substr(1), text), text);
    }
    const std::size_t bracket = trimmed.find('(');
    if (bracket == std::string_view::npos) return {parse_uncertain(trimmed)};
    const std::string_view before = detail::trim(trimmed.substr(0, bracket));
    if (!before.ends_with('/') || before.ends_with("+/")) fail(text, "a bracket must begin the number or follow a \"/\"");
    return make_ratio(parse_uncertain(before.substr(0, before.size() - 1)), parse_side(trimmed.substr(bracket), text), text);
}

Uncertain parse_uncertain_si(std::string_view text, Dimension wanted) {
    return parse_with_unit(
        text, [wanted](std::string_view quantity) { return parse_si(quantity, wanted); }, wanted);
}

Uncertain parse_uncertain_value(std::string_view text, const PiQuantity& quantity) {
    return parse_with_unit(
        text, [&quantity](std::string_view value) { return parse_value(value, quantity); }, quantity.dimension);
}

}  // namespace musim::scaling
