#include "scaling/rational_dimension.hpp"

#include <limits>

namespace musim::scaling {

namespace {

/// Twice the exponent when that is a whole number of a size that an int holds.
std::optional<int> twice(const Rational& exponent) {
    const Rational doubled = exponent * 2;
    constexpr std::int64_t kLargest = std::numeric_limits<int>::max();
    if (!doubled.is_whole() || doubled.numerator() > kLargest || doubled.numerator() < -kLargest) return std::nullopt;
    return static_cast<int>(doubled.numerator());
}

}  // namespace

std::string_view to_string(BaseDimension base) {
    constexpr std::array<std::string_view, kBaseDimensions.size()> kNames = {
        "length", "mass", "time", "temperature", "current", "amount of substance", "luminous intensity"};
    return kNames[static_cast<std::size_t>(base)];
}

std::optional<Dimension> to_halves(const RationalDimension& dimension) {
    RationalDimension mechanical;
    for (const BaseDimension base : {BaseDimension::length, BaseDimension::mass, BaseDimension::time}) mechanical[base] = dimension[base];
    const auto length = twice(dimension[BaseDimension::length]);
    const auto mass = twice(dimension[BaseDimension::mass]);
    const auto time = twice(dimension[BaseDimension::time]);
    if (mechanical != dimension || !length || !mass || !time) return std::nullopt;
    return Dimension{*length, *mass, *time};
}

}  // namespace musim::scaling
