#include "scaling/detail/unit_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "scaling/error.hpp"
#include "scaling/units.hpp"

namespace musim::scaling::detail {

namespace {

/// Longest unit text that is read [characters]; longer ones are mistakes, and a bound keeps nested brackets shallow.
constexpr std::size_t kLongestUnit = 64;

/// Largest power, and largest exponent that powers of brackets may build; mechanics needs 5 (inertia in kg m^5).
constexpr int kLargestPower = 9;
constexpr int kLargestExponent = 100;

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

const std::array<Symbol, 22> kSymbols{{
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

/// Edit distance [Levenshtein66]: 1 for another case of the same letter, 2 for any other change.
int edit_distance(std::string_view a, std::string_view b) {
    std::vector<int> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = 2 * static_cast<int>(j);
    for (const char letter : a) {
        int diagonal = row[0];
        row[0] += 2;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const bool same_letter = std::tolower(static_cast<unsigned char>(letter)) == std::tolower(static_cast<unsigned char>(b[j]));
            const int substitution = letter == b[j] ? 0 : same_letter ? 1 : 2;
            const int best = std::min({diagonal + substitution, row[j] + 2, row[j + 1] + 2});
            diagonal = row[j + 1];
            row[j + 1] = best;
        }
    }
    return row[b.size()];
}

/// The known unit, with or without prefix, that is spelled most like `name`; empty when none shares a letter with it.
std::string find_nearest_unit(std::string_view name) {
    int smallest = 2 * static_cast<int>(name.size());
    std::string nearest;
    const auto consider = [&](std::string candidate) {
        const int distance = edit_distance(name, candidate);
        if (distance >= smallest) return;
        smallest = distance;
        nearest = std::move(candidate);
    };
    for (const Symbol& symbol : kSymbols) {
        consider(std::string(symbol.name));
        if (!symbol.takes_prefix) continue;
        for (const Prefix& prefix : kPrefixes) consider(fmt::format("{}{}", prefix.name, symbol.name));
    }
    return nearest;
}

void multiply(Unit& product, const Unit& factor) {
    product.dimension.length += factor.dimension.length;
    product.dimension.mass += factor.dimension.mass;
    product.dimension.time += factor.dimension.time;
    product.decimal_exponent += factor.decimal_exponent;
    product.numerator *= factor.numerator;
    product.denominator *= factor.denominator;
}

Unit inverse(const Unit& unit) {
    const Dimension& d = unit.dimension;
    return {{-d.length, -d.mass, -d.time}, -unit.decimal_exponent, unit.denominator, unit.numerator};
}

/// Recursive descent over `product := [/] factor {[* / · . blank] factor}`, `factor := (1 | symbol | "(" product ")") [power]`.
class UnitReader {
  public:
    UnitReader(std::string_view unit, GramOrGravity g, std::string_view text) : rest_(unit), g_(g), text_(text) {}

    Unit read() {
        if (rest_.size() > kLongestUnit) fail("the unit is too long");
        const Unit unit = read_product();
        if (!rest_.empty()) fail("a closing bracket without an opening one");
        return unit;
    }

  private:
    [[noreturn]] void fail(std::string_view why) const {
        throw ParseError(fmt::format("\"{}\": {}; write a unit such as \"m\", \"MN/m\" or \"kN*s/m\"", text_, why));
    }

    bool skip(std::string_view token) {
        if (!rest_.starts_with(token)) return false;
        rest_.remove_prefix(token.size());
        return true;
    }

    void skip_blanks() {
        while (skip(" ") || skip("\t")) continue;
    }

    Unit read_product() {
        Unit product;
        bool divide = skip("/");
        skip_blanks();
        while (true) {
            const Unit factor = read_factor();
            multiply(product, divide ? inverse(factor) : factor);
            skip_blanks();
            if (rest_.empty() || rest_.front() == ')') return product;
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

    /// The power behind a unit: ^2, ^-1, **2, 2, -2, ² or ³; 1 when there is none.
    int read_power() {
        if (skip("²")) return 2;
        if (skip("³")) return 3;
        const bool marked = skip("^") || skip("**");
        const bool negative = rest_.starts_with('-');
        if (negative) rest_.remove_prefix(1);
        if (rest_.empty() || std::isdigit(static_cast<unsigned char>(rest_.front())) == 0) {
            if (marked || negative) fail("a power must be a whole number");
            return 1;
        }
        int power = 0;
        while (!rest_.empty() && std::isdigit(static_cast<unsigned char>(rest_.front())) != 0) {
            power = 10 * power + (rest_.front() - '0');
            if (power > kLargestPower) fail("the power is too large");
            rest_.remove_prefix(1);
        }
        return negative ? -power : power;
    }

    Unit raise(const Unit& unit, int power) const {
        const Unit base = power < 0 ? inverse(unit) : unit;
        Unit result;
        for (int i = 0; i < std::abs(power); ++i) multiply(result, base);
        const Dimension& d = result.dimension;
        if (std::max({std::abs(d.length), std::abs(d.mass), std::abs(d.time), std::abs(result.decimal_exponent)}) > kLargestExponent) {
            fail("the powers are too large");
        }
        return result;
    }

    std::string_view rest_;
    GramOrGravity g_;
    std::string_view text_;
};

}  // namespace

Unit parse_unit(std::string_view unit, GramOrGravity g, std::string_view text) { return UnitReader(unit, g, text).read(); }

}  // namespace musim::scaling::detail
