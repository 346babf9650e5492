#include "scaling/pi_quantity.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "scaling/detail/dimension_names.hpp"
#include "scaling/detail/number_text.hpp"
#include "scaling/detail/unit_text.hpp"
#include "scaling/detail/wide_product.hpp"
#include "scaling/nearest_name.hpp"
#include "scaling/quantity_text.hpp"
#include "scaling/shorten.hpp"

namespace musim::scaling {

PiQuantity make_pi_quantity(std::string_view name, std::string_view unit_text, std::optional<std::string_view> value) {
    PiQuantity quantity{.name = std::string(name), .dimension = {}, .value = std::nullopt, .is_angle = false};
    detail::Unit unit;
    if (!unit_text.empty() && unit_text != "-") unit = detail::parse_unit(unit_text, detail::GramOrGravity::gram, unit_text);
    quantity.dimension = unit.dimension;
    quantity.is_angle = unit.dimension.is_dimensionless() && (unit_text.find("rad") != std::string_view::npos ||
                                                              unit_text.find("deg") != std::string_view::npos || unit_text == "°");
    if (!value) return quantity;
    const detail::NumberText number = detail::split_number(*value);
    if (!number.rest.empty())
        throw ParseError(fmt::format("\"{}\": a number is wanted; its unit stands in \"unit\"", shorten(*value, kEchoed)));
    quantity.value = detail::to_double(number, unit.decimal_exponent, *value) * unit.numerator / unit.denominator;
    if (!std::isfinite(*quantity.value))
        throw ParseError(fmt::format("\"{}\": too large for a double; check number and unit", shorten(*value, kEchoed)));
    return quantity;
}

double parse_value(std::string_view text, const PiQuantity& quantity) {
    if (const auto halves = to_halves(quantity.dimension)) return parse_si(text, *halves);
    const detail::NumberText number = detail::split_number(text);
    const std::string_view digits = text.substr(0, static_cast<std::size_t>(number.rest.data() - text.data()));
    const std::string_view unit = number.rest.empty() ? "1" : number.rest;
    const PiQuantity read = make_pi_quantity(quantity.name, unit, number.rest.empty() ? text : digits);
    if (number.rest.empty() || read.dimension == quantity.dimension) return *read.value;
    throw ParseError(fmt::format("\"{}\": a quantity in {} is wanted, this is {}", shorten(text, kEchoed),
                                 detail::base_units(quantity.dimension), detail::describe(read.dimension)));
}

std::string format_value(double value, const PiQuantity& quantity, int digits) {
    return format_si_like(value, value, quantity.dimension, digits);
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
        if (quantity.value && !(std::isfinite(*quantity.value) && *quantity.value > 0.0)) {
            throw PiError(
                fmt::format("{} is {} (a value must be positive and finite: groups are products of powers); correct it or leave it out",
                            name, format_value(*quantity.value, quantity)));
        }
        if (!names.insert(name).second) throw PiError(fmt::format("\"{}\" is there twice; rename one", name));
    }
}

std::size_t find_quantity(const std::vector<PiQuantity>& quantities, std::string_view name, std::string_view owner) {
    const auto found = std::find_if(quantities.begin(), quantities.end(), [&](const PiQuantity& each) { return each.name == name; });
    if (found != quantities.end()) return static_cast<std::size_t>(found - quantities.begin());
    std::vector<std::string> names;
    names.reserve(quantities.size());
    for (const PiQuantity& quantity : quantities) names.push_back(quantity.name);
    const std::string nearest = detail::find_nearest(name, names, [&](const auto&) { return 2 * static_cast<int>(name.size()); });
    if (!nearest.empty()) throw PiError(fmt::format("\"{}\" is no quantity of {}; did you mean \"{}\"?", name, owner, nearest));
    throw PiError(fmt::format("\"{}\" is no quantity of {}; take one of {}", name, owner, fmt::join(names, ", ")));
}

RationalDimension dimension_of_product(const std::vector<Rational>& exponents, const std::vector<PiQuantity>& quantities) {
    RationalDimension dimension;
    for (std::size_t i = 0; i < quantities.size(); ++i) dimension = dimension * pow(quantities[i].dimension, exponents[i]);
    return dimension;
}

std::optional<double> group_value(const PiGroup& group, const std::vector<PiQuantity>& quantities) {
    detail::WideProduct product;
    for (std::size_t i = 0; i < quantities.size(); ++i) {
        if (group[i] == 0) continue;
        if (!quantities[i].value) return std::nullopt;
        product.multiply(*quantities[i].value, group[i]);
    }
    return product.value();
}

}  // namespace musim::scaling
