#include "scaling/rational.hpp"

#include <doctest/doctest.h>

#include <boost/units/pow.hpp>
#include <boost/units/systems/si/plane_angle.hpp>
#include <boost/units/systems/si/temperature.hpp>
#include <cstdint>

#include "scaling/pi_quantity.hpp"
#include "scaling/quantity_text.hpp"
#include "scaling/rational_dimension.hpp"
#include "scaling/units.hpp"

namespace musim::scaling::tests {

TEST_CASE("fractions are exact and in lowest terms") {
    CHECK(Rational(2, -4) == Rational(-1, 2));
    CHECK(Rational(1, 3) + Rational(1, 6) == Rational(1, 2));
    CHECK(Rational(1, 3) - Rational(1, 3) == 0);
    CHECK(Rational(2, 3) * Rational(3, 4) == Rational(1, 2));
    CHECK(Rational(2, 3) / Rational(-4, 3) == Rational(-1, 2));
    CHECK(to_string(Rational(-3, 6)) == "-1/2");
    CHECK(power_text(Rational(1, 2)) == "^(1/2)");
    CHECK(power_text(1) == "");
}

TEST_CASE("fractions that leave 64 bits throw, they never wrap") {
    const std::int64_t largest = INT64_MAX;
    CHECK_THROWS_AS(Rational(largest) + 1, SimilitudeError);
    CHECK_THROWS_AS(Rational(largest) * 2, SimilitudeError);
    CHECK_THROWS_AS(Rational(1, largest) + Rational(1, largest - 1), SimilitudeError);
    CHECK_THROWS_AS(Rational(INT64_MIN), SimilitudeError);
    CHECK_THROWS_AS(Rational(1, 0), SimilitudeError);
    CHECK_THROWS_AS(Rational(1) / Rational(0), SimilitudeError);
    // crosswise reduction: a product that fits is found
    CHECK(Rational(largest, 3) * Rational(3, largest) == 1);
}

TEST_CASE("dimensions come from quantity types, halves or any fraction, angles as plain numbers") {
    CHECK(rational_dimension_of<Velocity>() == RationalDimension(dimension_of<Velocity>()));
    CHECK(rational_dimension_of<Stiffness>() == RationalDimension(dimension_of<Stiffness>()));
    CHECK(rational_dimension_of<units::quantity<si::plane_angle>>().is_dimensionless());
    CHECK(rational_dimension_of<units::quantity<si::temperature>>() == RationalDimension::of(BaseDimension::temperature));
    using CubeRoot = units::root_typeof_helper<Length, units::static_rational<3>>::type;
    CHECK(rational_dimension_of<CubeRoot>() == RationalDimension::of(BaseDimension::length, {1, 3}));
    CHECK(to_halves(rational_dimension_of<Damping>()) == dimension_of<Damping>());
    CHECK_FALSE(to_halves(rational_dimension_of<CubeRoot>()).has_value());
    CHECK_FALSE(to_halves(RationalDimension::of(BaseDimension::current)).has_value());
}

TEST_CASE("constants hold proper fractions") {
    // GCC 12 once left all zero bits, denominators too
    static const RationalDimension kConstant = dimension_of<Length>();
    for (const BaseDimension base : kBaseDimensions) CHECK(kConstant[base].denominator() == 1);
}

TEST_CASE("units of all seven base dimensions and fractional powers are read") {
    const auto dimension = [](const char* unit) { return make_pi_quantity("x", unit).dimension; };
    const auto of = [](BaseDimension base, Rational exponent = 1) { return RationalDimension::of(base, exponent); };
    CHECK(dimension("mK") == of(BaseDimension::temperature));
    CHECK(dimension("mol/cd") == of(BaseDimension::amount) / of(BaseDimension::luminous_intensity));
    CHECK(dimension("ohm") == dimension("kg m^2 s^-3 A^-2"));
    CHECK(dimension("V C") == dimension("J"));
    CHECK(dimension("W/(m K)") == dimension("kg*m/s^3/K"));
    CHECK(dimension("m^(1/3)") == of(BaseDimension::length, {1, 3}));
    CHECK(dimension("m^-0.5") == of(BaseDimension::length, {-1, 2}));
    CHECK(dimension("(m/s)^(3/2)") == dimension("m^1.5 s^-1.5"));
    // fracture toughness: 1 MPa √mm = 1e6 · √1e-3; two roundings
    CHECK(*make_pi_quantity("K", "MPa mm^0.5", "2").value == doctest::Approx(2e6 * 0.0316227766016837933).epsilon(1e-15));
    CHECK_THROWS_AS(dimension("m^(1/0)"), ParseError);
    CHECK_THROWS_AS(dimension("m^(1/2"), ParseError);
    CHECK_THROWS_AS(dimension("m^0.333"), ParseError);
}

TEST_CASE("another dimension than mechanics wants is named") {
    try {
        parse_quantity<Length>("3 K");
        FAIL("3 K is no length");
    } catch (const ParseError& error) {
        CHECK(std::string(error.what()) == "\"3 K\": a length is wanted (such as \"4.25 m\"), this is in K");
    }
}

}  // namespace musim::scaling::tests
