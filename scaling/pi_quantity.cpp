#include "scaling/pi_quantity.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <set>

#include "scaling/detail/edit_distance.hpp"
#include "scaling/detail/number_text.hpp"
#include "scaling/detail/unit_text.hpp"

namespace musim::scaling {

namespace {

/// A product that neither overflows nor underflows on the way: mantissa · 2^exponent.
struct Scaled {
    double mantissa = 1.0;
    std::int64_t exponent = 0;

    void multiply(const Scaled& factor) {
        int shift = 0;
        mantissa = std::frexp(mantissa * factor.mantissa, &shift);
        exponent += factor.exponent + shift;
    }
};

Scaled power(double value, std::int64_t n) {
    Scaled square;
    square.multiply({value, 0});
    Scaled result;
    for (; n > 0; n /= 2) {
        if (n % 2 == 1) result.multiply(square);
        square.multiply(square);
    }
    return result;
}

}  // namespace

PiQuantity make_pi_quantity(std::string_view name, std::string_view unit_text, std::optional<std::string_view> value) {
    PiQuantity quantity{.name = std::string(name), .dimension = {}, .value = std::nullopt, .is_angle = false};
    detail::Unit unit;
    if (!unit_text.empty() && unit_text != "-") unit = detail::parse_unit(unit_text, detail::GramOrGravity::gram, unit_text);
    quantity.dimension = unit.dimension;
    quantity.is_angle = unit.dimension.is_dimensionless() && (unit_text.find("rad") != std::string_view::npos ||
                                                              unit_text.find("deg") != std::string_view::npos || unit_text == "°");
    if (!value) return quantity;
    const detail::NumberText number = detail::split_number(*value);
    if (!number.rest.empty()) throw ParseError(fmt::format("\"{}\": a number is wanted; its unit stands in \"unit\"", *value));
    quantity.value = detail::to_double(number, unit.decimal_exponent, *value) * unit.numerator / unit.denominator;
    if (!std::isfinite(*quantity.value)) throw ParseError(fmt::format("\"{}\": too large for a double; check number and unit", *value));
    return quantity;
}

void check_quantities(const std::vector<PiQuantity>& quantities) {
    if (quantities.empty()) throw PiError("no quantities; list those that the problem depends on");
    std::set<std::string_view> names;
    for (const PiQuantity& quantity : quantities) {
        const std::string& name = quantity.name;
        if (name.empty()) throw PiError("a quantity has an empty name; give it one");
        const auto first = static_cast<unsigned char>(name.front());
        const bool is_word = std::isdigit(first) == 0 && std::isspace(first) == 0 && name.back() != ' ' &&
                             name.find_first_of("*/^(),\t\n\r\"\\") == std::string::npos;
        if (!is_word) {
            throw PiError(fmt::format("\"{}\" is no name for a product (digit or blank at its ends, operator in it); rename it", name));
        }
        if (!names.insert(name).second) throw PiError(fmt::format("\"{}\" is there twice; rename one", name));
    }
}

std::size_t find_quantity(const std::vector<PiQuantity>& quantities, std::string_view name) {
    std::string_view nearest;
    int smallest = 2 * static_cast<int>(name.size());
    for (std::size_t i = 0; i < quantities.size(); ++i) {
        if (quantities[i].name == name) return i;
        const int distance = detail::edit_distance(name, quantities[i].name);
        if (distance >= smallest) continue;
        smallest = distance;
        nearest = quantities[i].name;
    }
    throw PiError(nearest.empty() ? fmt::format("\"{}\" is no quantity of the problem; correct the name", name)
                                  : fmt::format("\"{}\" is no quantity of the problem; did you mean \"{}\"?", name, nearest));
}

std::optional<double> group_value(const PiGroup& group, const std::vector<PiQuantity>& quantities) {
    Scaled numerator;
    Scaled denominator;
    for (std::size_t i = 0; i < quantities.size(); ++i) {
        if (group[i] == 0) continue;
        if (!quantities[i].value) return std::nullopt;
        const double value = *quantities[i].value;
        if (group[i] > 0) numerator.multiply(power(value, group[i]));
        if (group[i] < 0) denominator.multiply(power(value, -group[i]));
    }
    const std::int64_t exponent = numerator.exponent - denominator.exponent;
    if (denominator.mantissa == 0.0 || std::abs(exponent) > 4000) return std::nullopt;
    const double value = std::ldexp(numerator.mantissa / denominator.mantissa, static_cast<int>(exponent));
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

}  // namespace musim::scaling
