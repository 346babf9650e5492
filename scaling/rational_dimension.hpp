#pragma once

#include <array>
#include <boost/units/physical_dimensions/amount.hpp>
#include <boost/units/physical_dimensions/current.hpp>
#include <boost/units/physical_dimensions/luminous_intensity.hpp>
#include <boost/units/physical_dimensions/plane_angle.hpp>
#include <boost/units/physical_dimensions/solid_angle.hpp>
#include <boost/units/physical_dimensions/temperature.hpp>
#include <cstddef>
#include <optional>
#include <string_view>

#include "scaling/dimension.hpp"
#include "scaling/rational.hpp"

namespace musim::scaling {

/// The base dimensions of SI, in the order in which they are kept.
enum class BaseDimension : std::size_t { length, mass, time, temperature, current, amount, luminous_intensity };

inline constexpr std::array kBaseDimensions = {BaseDimension::length,
                                               BaseDimension::mass,
                                               BaseDimension::time,
                                               BaseDimension::temperature,
                                               BaseDimension::current,
                                               BaseDimension::amount,
                                               BaseDimension::luminous_intensity};

/// "length", "mass", "time", "temperature", "current", "amount of substance", "luminous intensity".
std::string_view to_string(BaseDimension base);

/// Dimension known at run time, with any rational exponent of the seven base dimensions: what files and the Pi theorem need. Angles are
/// plain numbers. A Dimension (halves of length, mass, time) converts without loss.
class RationalDimension {
  public:
    constexpr RationalDimension() = default;
    constexpr RationalDimension(Dimension halves) {  // NOLINT(google-explicit-constructor): nothing is lost
        (*this)[BaseDimension::length] = {halves.length, 2};
        (*this)[BaseDimension::mass] = {halves.mass, 2};
        (*this)[BaseDimension::time] = {halves.time, 2};
    }

    /// A base dimension to a power.
    static constexpr RationalDimension of(BaseDimension base, Rational exponent = 1) {
        RationalDimension dimension;
        dimension[base] = exponent;
        return dimension;
    }

    constexpr const Rational& operator[](BaseDimension base) const { return exponents_[static_cast<std::size_t>(base)]; }
    constexpr Rational& operator[](BaseDimension base) { return exponents_[static_cast<std::size_t>(base)]; }

    constexpr bool is_dimensionless() const { return *this == RationalDimension(); }

    friend constexpr bool operator==(const RationalDimension&, const RationalDimension&) = default;

    /// Dimension of a product. Throws SimilitudeError when an exponent leaves 64 bits, as the following do.
    friend constexpr RationalDimension operator*(RationalDimension a, const RationalDimension& b) {
        for (const BaseDimension base : kBaseDimensions) a[base] = a[base] + b[base];
        return a;
    }
    /// Dimension of a quotient.
    friend constexpr RationalDimension operator/(const RationalDimension& a, const RationalDimension& b) { return a * pow(b, -1); }
    /// Dimension of a power.
    friend constexpr RationalDimension pow(RationalDimension dimension, const Rational& power) {
        for (const BaseDimension base : kBaseDimensions) dimension[base] = dimension[base] * power;
        return dimension;
    }

  private:
    // one by one: GCC 12 leaves the elements of `{}` all zero bits, denominators too, in constants
    std::array<Rational, kBaseDimensions.size()> exponents_ = {Rational(0), Rational(0), Rational(0), Rational(0),
                                                               Rational(0), Rational(0), Rational(0)};
};

/// The dimension in halves of length, mass and time, or none when it needs more.
std::optional<Dimension> to_halves(const RationalDimension& dimension);

namespace detail {

/// The base dimension of a Boost.Units tag; none for angles, which are plain numbers.
template <class Tag>
constexpr std::optional<BaseDimension> base_dimension_of() {
    if constexpr (std::is_same_v<Tag, boost::units::length_base_dimension>) {
        return BaseDimension::length;
    } else if constexpr (std::is_same_v<Tag, boost::units::mass_base_dimension>) {
        return BaseDimension::mass;
    } else if constexpr (std::is_same_v<Tag, boost::units::time_base_dimension>) {
        return BaseDimension::time;
    } else if constexpr (std::is_same_v<Tag, boost::units::temperature_base_dimension>) {
        return BaseDimension::temperature;
    } else if constexpr (std::is_same_v<Tag, boost::units::current_base_dimension>) {
        return BaseDimension::current;
    } else if constexpr (std::is_same_v<Tag, boost::units::amount_base_dimension>) {
        return BaseDimension::amount;
    } else if constexpr (std::is_same_v<Tag, boost::units::luminous_intensity_base_dimension>) {
        return BaseDimension::luminous_intensity;
    } else {
        constexpr bool kIsAngle =
            std::is_same_v<Tag, boost::units::plane_angle_base_dimension> || std::is_same_v<Tag, boost::units::solid_angle_base_dimension>;
        static_assert(kIsAngle, "the base dimensions are the seven of SI");
        return std::nullopt;
    }
}

/// Walks the type list that Boost.Units keeps for a dimension.
template <class List>
constexpr void add_rational_exponents(RationalDimension& dimension) {
    if constexpr (!std::is_same_v<List, boost::units::dimensionless_type>) {
        using Exponent = typename List::item::value_type;
        if (const auto base = base_dimension_of<typename List::item::tag_type>()) {
            dimension[*base] = Rational(Exponent::Numerator, Exponent::Denominator);
        }
        add_rational_exponents<typename List::next>(dimension);
    }
}

}  // namespace detail

/// Dimension of a `boost::units::quantity` type with any rational exponents; dimension_of() where halves of length, mass and time will do.
template <class Quantity>
constexpr RationalDimension rational_dimension_of() {
    RationalDimension dimension;
    detail::add_rational_exponents<typename boost::units::get_dimension<Quantity>::type>(dimension);
    return dimension;
}

}  // namespace musim::scaling
