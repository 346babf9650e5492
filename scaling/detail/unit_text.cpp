#include "scaling/detail/unit_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>

#include "scaling/detail/text_cursor.hpp"
#include "scaling/error.hpp"
#include "scaling/nearest_name.hpp"
#include "scaling/shorten.hpp"
#include "scaling/units.hpp"

namespace musim::scaling::detail {

namespace {

/// Longest unit text that is read [characters]; longer ones are mistakes, and a bound keeps nested brackets shallow.
constexpr std::size_t kLongestUnit = 64;

/// Largest power, and largest exponent, numerator and denominator, that powers of brackets may build; mechanics needs 5 (inertia in kg
/// m^5).
constexpr int kLargestPower = 9;
constexpr int kLargestUnitExponent = 100;

struct Symbol {
    std::string_view name;
    Unit unit;
    bool takes_prefix = false;
};

struct Prefix {
    std::string_view name;
    int decimal_exponent = 0;
};

constexpr Dimension kMassDimension = dimension_of<Mass>();
constexpr Dimension kAccelerationDimension = dimension_of<Acceleration>();
constexpr RationalDimension kCurrent = RationalDimension::of(BaseDimension::current);
constexpr RationalDimension kCharge = kCurrent * RationalDimension(dimension_of<Time>());
constexpr RationalDimension kVoltage = RationalDimension(dimension_of<Power>()) / kCurrent;

const std::array<Symbol, 29> kSymbols{{
    {"m", {dimension_of<Length>()}, true},
    {"g", {kMassDimension, -3}, true},
    {"s", {dimension_of<Time>()}, true},
    {"N", {dimension_of<Force>()}, true},
    {"Pa", {dimension_of<Stress>()}, true},
    {"J", {dimension_of<Energy>()}, true},
    {"W", {dimension_of<Power>()}, true},
    {"Hz", {dimension_of<Frequency>()}, true},
    {"rad", {dimension_of<Ratio>()}, true},
    {"gal", {kAccelerationDimension, -2}, true},
    {"Gal", {kAccelerationDimension, -2}, true},
    {"bar", {dimension_of<Stress>(), 5}, true},
    {"K", {RationalDimension::of(BaseDimension::temperature)}, true},
    {"A", {kCurrent}, true},
    {"mol", {RationalDimension::of(BaseDimension::amount)}, true},
    {"cd", {RationalDimension::of(BaseDimension::luminous_intensity)}, true},
    {"C", {kCharge}, true},
    {"V", {kVoltage}, true},
    {"ohm", {kVoltage / kCurrent}, true},
    {"sec", {dimension_of<Time>()}},
    {"min", {dimension_of<Time>(), 0, 60.0}},
    {"h", {dimension_of<Time>(), 0, 3600.0}},
    {"t", {kMassDimension, 3}},
    {"gn", {kAccelerationDimension, 0, kStandardGravity.value()}},
    {"deg", {dimension_of<Ratio>(), 0, std::numbers::pi, 180.0}},
    {"°", {dimension_of<Ratio>(), 0, std::numbers::pi, 180.0}},
    {"%", {dimension_of<Ratio>(), -2}},
    {"in", {dimension_of<Length>(), 0, 0.0254}},
    {"ft", {dimension_of<Length>(), 0, 0.3048}},
}};

// U+00B5 (micro sign) and U+03BC (Greek mu) look the same
constexpr std::array<Prefix, 11> kPrefixes{
    {{"n", -9}, {"u", -6}, {"\u00B5", -6}, {"\u03BC", -6}, {"m", -3}, {"c", -2}, {"d", -1}, {"k", 3}, {"M", 6}, {"G", 9}, {"T", 12}}};

/// The known unit, with or without prefix, that is spelled most like `name`; empty when none shares a letter with it.
std::string find_nearest_unit(std::string_view name) {
    std::vector<std::string> known;
    for (const Symbol& symbol : kSymbols) {
        known.emplace_back(symbol.name);
        if (!symbol.takes_prefix) continue;
        for (const Prefix& prefix : kPrefixes) known.push_back(fmt::format("{}{}", prefix.name, symbol.name));
    }
    // half of the letters may be wrong: "GPx", but nothing for "furlong"
    return find_nearest(name, known, [&](const auto&) { return static_cast<int>(name.size()) / 2 + 2; });
}

void multiply(Unit& product, const Unit& factor) {
    product.dimension = product.dimension * factor.dimension;
    product.decimal_exponent += factor.decimal_exponent;
    product.numerator *= factor.numerator;
    product.denominator *= factor.denominator;
}

Unit inverse(const Unit& unit) { return {pow(unit.dimension, -1), -unit.decimal_exponent, unit.denominator, unit.numerator}; }

/// Recursive descent over `product := [/] factor {[* / · . blank] factor}`, `factor := (1 | symbol | "(" product ")") [power]`.
class UnitReader : private TextCursor {
  public:
    UnitReader(std::string_view unit, GramOrGravity g, std::string_view text) : TextCursor(unit), g_(g), text_(text) {}

    Unit read() {
        if (rest_.size() > kLongestUnit) fail("the unit is too long");
        const Unit unit = read_product();
        if (!rest_.empty()) fail("a closing bracket without an opening one");
        return unit;
    }

  private:
    [[noreturn]] void fail(std::string_view why) const {
        throw ParseError(fmt::format("\"{}\": {}; write a unit such as \"m\", \"MN/m\" or \"kN*s/m\"", shorten(text_, kEchoed), why));
    }

    Unit read_product() {
        Unit product;
        bool divide = skip("/");
        skip_blanks();
        while (true) {
            const Unit factor = read_factor();
            multiply(product, divide ? inverse(factor) : factor);
            skip_blanks();
            if (at_end()) return product;
            divide = skip("/");
            if (!divide && !skip("*") && !skip("·")) skip(".");
            skip_blanks();
        }
    }

    Unit read_factor() {
        Unit unit;
        if (skip("(")) {
            skip_blanks();
            unit = read_product();
            if (!skip(")")) fail("a closing bracket is missing");
        } else if (skip("1")) {
            return unit;
        } else {
            unit = read_symbol();
        }
        return raise(unit, read_power());
    }

    Unit read_symbol() {
        // letters, % and every byte of a character outside ASCII, except the middle dot and superscript digits
        std::size_t length = 0;
        while (length < rest_.size()) {
            const std::string_view here = rest_.substr(length);
            if (here.starts_with("·") || here.starts_with("²") || here.starts_with("³")) break;
            const auto byte = static_cast<unsigned char>(here.front());
            if (byte < 0x80 && std::isalpha(byte) == 0 && byte != '%') break;
            ++length;
        }
        if (length == 0) fail(rest_.empty() ? "a unit is missing at the end" : fmt::format("unexpected \"{}\" in the unit", rest_));
        const std::string_view name = rest_.substr(0, length);
        rest_.remove_prefix(length);
        return find_unit(name);
    }

    Unit find_unit(std::string_view name) const {
        if (g_ == GramOrGravity::gravity && (name == "g" || name == "mg")) {
            return {kAccelerationDimension, name == "g" ? 0 : -3, kStandardGravity.value()};
        }
        for (const Symbol& symbol : kSymbols) {
            if (symbol.name == name) return symbol.unit;
        }
        for (const Symbol& symbol : kSymbols) {
            if (!symbol.takes_prefix || !name.ends_with(symbol.name)) continue;
            for (const Prefix& prefix : kPrefixes) {
                if (name.substr(0, name.size() - symbol.name.size()) != prefix.name) continue;
                Unit unit = symbol.unit;
                unit.decimal_exponent += prefix.decimal_exponent;
                return unit;
            }
        }
        const std::string nearest = find_nearest_unit(name);
        fail(fmt::format("unknown unit \"{}\"{}", name, nearest.empty() ? "" : fmt::format(" (did you mean \"{}\"?)", nearest)));
    }

    /// Digits at the front as a number; `limit` is the largest.
    int read_digits(int limit) {
        int number = 0;
        while (at_digit()) {
            number = 10 * number + (rest_.front() - '0');
            if (number > limit) fail("the power is too large");
            rest_.remove_prefix(1);
        }
        return number;
    }

    /// The power behind a unit: ^2, ^-1, **2, 2, -2, ², ³, ^0.5 or ^(1/2); 1 when there is none.
    Rational read_power() {
        if (skip("²")) return 2;
        if (skip("³")) return 3;
        const bool marked = skip("^") || skip("**");
        const bool bracketed = marked && skip("(");
        const bool negative = skip("-");
        if (!at_digit()) {
            if (marked || negative) fail("a power must be a whole number or a fraction such as ^(1/2)");
            return 1;
        }
        Rational power = read_digits(kLargestPower);
        if (bracketed) {
            if (skip("/")) {
                const int denominator = read_digits(kLargestPower);
                if (denominator == 0) fail("a fraction as a power needs a denominator");
                power = power / denominator;
            }
            if (!skip(")")) fail("a closing bracket is missing");
        } else if (marked && rest_.size() > 1 && rest_[0] == '.' && std::isdigit(static_cast<unsigned char>(rest_[1])) != 0) {
            rest_.remove_prefix(1);
            const std::size_t before = rest_.size();
            const int decimals = read_digits(kLargestUnitExponent - 1);
            int size = 1;
            for (std::size_t i = rest_.size(); i < before && size <= kLargestUnitExponent; ++i) size *= 10;
            if (size > kLargestUnitExponent) fail("a power has too many digits; use a fraction such as ^(1/3)");
            power = power + Rational(decimals, size);
        }
        return negative ? -power : power;
    }

    Unit raise(const Unit& unit, const Rational& power) const {
        const Unit base = power.numerator() < 0 ? inverse(unit) : unit;
        Unit result;
        for (std::int64_t i = 0; i < std::abs(power.numerator()); ++i) multiply(result, base);
        if (!power.is_whole()) result = take_root(result, power.denominator());
        for (const BaseDimension of : kBaseDimensions) {
            const Rational& exponent = result.dimension[of];
            if (std::abs(exponent.numerator()) > kLargestUnitExponent || exponent.denominator() > kLargestUnitExponent) {
                fail("the powers are too large");
            }
        }
        if (std::abs(result.decimal_exponent) > kLargestUnitExponent) fail("the powers are too large");
        return result;
    }

    /// Root of a unit: the part of the decimal exponent that the root does not divide goes into the factor, rounded.
    static Unit take_root(const Unit& unit, std::int64_t degree) {
        const int n = static_cast<int>(degree);
        const double root = 1.0 / n;
        return {pow(unit.dimension, {1, degree}), unit.decimal_exponent / n,
                std::pow(unit.numerator, root) * std::pow(10.0, unit.decimal_exponent % n * root), std::pow(unit.denominator, root)};
    }

    GramOrGravity g_;
    std::string_view text_;
};

}  // namespace

Unit parse_unit(std::string_view unit, GramOrGravity g, std::string_view text) { return UnitReader(unit, g, text).read(); }

}  // namespace musim::scaling::detail
