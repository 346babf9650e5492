#pragma once

#include <boost/units/dimension.hpp>
#include <boost/units/get_dimension.hpp>
#include <boost/units/physical_dimensions/length.hpp>
#include <boost/units/physical_dimensions/mass.hpp>
#include <boost/units/physical_dimensions/time.hpp>
#include <boost/units/static_rational.hpp>
#include <boost/units/units_fwd.hpp>
#include <type_traits>

namespace musim::scaling {

/// Run-time image of a quantity type's dimension: L^(length/2) M^(mass/2) T^(time/2). Halves, so that a square root stays exact.
struct Dimension {
    int length = 0;  ///< twice the exponent of length
    int mass = 0;    ///< twice the exponent of mass
    int time = 0;    ///< twice the exponent of time

    friend constexpr bool operator==(const Dimension&, const Dimension&) = default;
};

namespace detail {

template <class T>
inline constexpr bool kHasUnit = false;
template <class Unit, class Number>
inline constexpr bool kHasUnit<boost::units::quantity<Unit, Number>> = true;

/// Adds the exponent of one `boost::units::dim` to the dimension; refuses anything but halves of length, mass and time.
template <class Tag, class Exponent>
constexpr void add_exponent(Dimension& dimension) {
    constexpr auto kDenominator = Exponent::Denominator;
    static_assert(kDenominator == 1 || kDenominator == 2, "similitude handles whole and half-integer exponents only");
    constexpr int kHalves = static_cast<int>(Exponent::Numerator * (2 / kDenominator));
    constexpr bool kIsLength = std::is_same_v<Tag, boost::units::length_base_dimension>;
    constexpr bool kIsMass = std::is_same_v<Tag, boost::units::mass_base_dimension>;
    constexpr bool kIsTime = std::is_same_v<Tag, boost::units::time_base_dimension>;
    static_assert(kIsLength || kIsMass || kIsTime, "similitude is mechanical: only length, mass and time; write angles as plain numbers");
    if constexpr (kIsLength) dimension.length += kHalves;
    if constexpr (kIsMass) dimension.mass += kHalves;
    if constexpr (kIsTime) dimension.time += kHalves;
}

/// Walks the type list that Boost.Units keeps for a dimension.
template <class List>
constexpr void add_exponents(Dimension& dimension) {
    if constexpr (!std::is_same_v<List, boost::units::dimensionless_type>) {
        add_exponent<typename List::item::tag_type, typename List::item::value_type>(dimension);
        add_exponents<typename List::next>(dimension);
    }
}

}  // namespace detail

/// A number with a unit (a dimensionless Ratio too), such as Length: what has a dimension and can be scaled. A double has none of it.
template <class T>
concept QuantityWithUnit = detail::kHasUnit<T>;

/// Dimension of a `boost::units::quantity` type, e.g. dimension_of<Velocity>() = {2, 0, -2}. Does not compile for a quantity with
/// another base dimension (temperature, angle, ...).
template <QuantityWithUnit Quantity>
constexpr Dimension dimension_of() {
    Dimension dimension;
    detail::add_exponents<typename boost::units::get_dimension<Quantity>::type>(dimension);
    return dimension;
}

}  // namespace musim::scaling
