#include "scaling/quantity_text.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "scaling/units.hpp"

namespace musim::scaling::tests {

namespace {

template <class Quantity>
std::string quantity_message(std::string_view text) {
    try {
        parse_quantity<Quantity>(text);
    } catch (const ParseError& error) {
        return error.what();
    }
    return "";
}

template <class Quantity>
double si_value(std::string_view text) {
    return parse_quantity<Quantity>(text).value();
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("quantities of scene files and records are read to the last bit") {
    CHECK(si_value<Length>("4.25 m") == 4.25);
    CHECK(si_value<Stiffness>("30 MN/m") == 30e6);
    CHECK(si_value<StiffnessPerArea>("89.6 GPa/m") == 89.6e9);
    CHECK(si_value<Density>("800 kg/m^3") == 800.0);
    CHECK(si_value<Frequency>("4800 Hz") == 4800.0);
    CHECK(si_value<Frequency>("192 1/s") == 192.0);
    CHECK(si_value<Frequency>("192/s") == 192.0);
    CHECK(si_value<Acceleration>("9.80665 m/s^2") == 9.80665);
    CHECK(si_value<Acceleration>("1 cm/s/s") == 0.01);
    CHECK(si_value<Acceleration>("2.5 m/s2") == 2.5);
    CHECK(si_value<Acceleration>("2.5 m s^-2") == 2.5);
    CHECK(si_value<Acceleration>("2.5 m.s-2") == 2.5);
    CHECK(si_value<Acceleration>("2.5 m/s**2") == 2.5);
    CHECK(si_value<Acceleration>("2.5 m/s²") == 2.5);
    CHECK(si_value<Acceleration>("3920 gal") == 39.2);
    CHECK(si_value<Velocity>("42.4 cm/s") == 0.424);
    CHECK(si_value<Velocity>("42.4cm/sec") == 0.424);
    CHECK(si_value<Time>("10.4 us") == 10.4e-6);
    CHECK(si_value<Time>("10.4 µs") == 10.4e-6);  // micro sign
    CHECK(si_value<Time>("10.4 μs") == 10.4e-6);  // Greek mu
    CHECK(si_value<Time>("5 ms") == 5e-3);
    CHECK(si_value<Time>("2 min") == 120.0);
    CHECK(si_value<Damping>("2 kN*s/m") == 2e3);
    CHECK(si_value<Damping>("2 kN·s/m") == 2e3);
    CHECK(si_value<Damping>("2 kN s / m") == 2e3);
    CHECK(si_value<Damping>("2 kN/(m/s)") == 2e3);
    CHECK(si_value<Moment>("3 kN*m") == 3e3);
    CHECK(si_value<Stress>("3 bar") == 3e5);
    CHECK(si_value<Area>("2 (mm)^2") == 2e-6);
    CHECK(si_value<Volume>("2 mm³") == 2e-9);
    CHECK(si_value<Ratio>("0.63") == 0.63);
    CHECK(si_value<Ratio>("5 %") == 0.05);
    CHECK(si_value<Ratio>("3 mm/m") == 3e-3);
    CHECK(si_value<Ratio>("180 deg") == std::numbers::pi);
    CHECK(si_value<Ratio>("180°") == std::numbers::pi);
    CHECK(si_value<Velocity>("36 km/h") == 10.0);
    CHECK(si_value<Length>("1 in") == 0.0254);
}

TEST_CASE("g is gravity where an acceleration is wanted and gram where a mass is") {
    CHECK(parse_quantity<Acceleration>("0.511 g") == 0.511 * kStandardGravity);
    CHECK(parse_quantity<Acceleration>("1 gn") == kStandardGravity);
    CHECK(si_value<Acceleration>("2 mg") == 0.002 * 9.80665);
    CHECK(si_value<Mass>("10.6604 g") == 0.0106604);
    CHECK(si_value<Mass>("2 mg") == 2e-6);
    CHECK(si_value<Density>("0.8 g/cm^3") == 800.0);
    CHECK(si_value<Force>("2 kg*g") == 2.0 * 9.80665);
    CHECK(si_value<Force>("2 kg*m/s^2") == 2.0);
    CHECK(contains(quantity_message<Acceleration>("5 kg"), "an acceleration is wanted (such as \"0.511 g\"), this is a mass"));
}

TEST_CASE("powers of ten move the decimal point before rounding") {
    CHECK(si_value<Length>("12.710 mm") == 12.710 / 1000.0);
    CHECK(si_value<Length>("39.780 mm") == 0.039780);
    CHECK(si_value<Length>("12.710e1 mm") == 0.12710);
    // every hundredth of a millimeter up to a meter equals the same length written in meters
    for (int i = 1; i < 100'000; i += 7) {
        const std::string in_millimeters = std::to_string(i / 100) + "." + std::to_string(i / 10 % 10) + std::to_string(i % 10) + " mm";
        CHECK(si_value<Length>(in_millimeters) == i / 1e5);
    }
}

TEST_CASE("plain numbers are SI and fractions take a unit") {
    CHECK(si_value<Length>("0.5") == 0.5);
    CHECK(si_value<Stiffness>("30e6") == 30e6);
    CHECK(si_value<Length>("4.25/107 m") == 4.25 / 107.0);
    CHECK(si_value<Length>("1/107") == 1.0 / 107.0);
    CHECK(si_value<Time>("1/4800 s") == 1.0 / 4800.0);
}

TEST_CASE("a quantity of another dimension is refused with both dimensions") {
    CHECK(quantity_message<Stiffness>("30 MN") == "\"30 MN\": a stiffness is wanted (such as \"30 MN/m\"), this is a force");
    CHECK(contains(quantity_message<Length>("3 s"), "a length is wanted (such as \"4.25 m\"), this is a time"));
    CHECK(contains(quantity_message<Ratio>("3 s"), "a plain number is wanted (such as \"0.63\"), this is a time"));
    CHECK(contains(quantity_message<Length>("3 N^2"), "this is in kg^2 m^2 s^-4"));
}

TEST_CASE("an unknown unit is refused with the nearest one") {
    CHECK(contains(quantity_message<Stiffness>("30 Mn/m"), "unknown unit \"Mn\" (did you mean \"MN\"?)"));
    CHECK(contains(quantity_message<Length>("3 meter"), "unknown unit \"meter\""));
    CHECK(contains(quantity_message<Stress>("3 gpa"), "(did you mean \"GPa\"?)"));
    CHECK(contains(quantity_message<Frequency>("3 hz"), "(did you mean \"Hz\"?)"));
    CHECK(contains(quantity_message<Length>("3 x"), "unknown unit \"x\"; write"));
}

TEST_CASE("broken quantities are refused with the reason") {
    CHECK(contains(quantity_message<Length>(""), "does not begin with a finite number"));
    CHECK(contains(quantity_message<Length>("m"), "does not begin with a finite number"));
    CHECK(contains(quantity_message<Length>("nan m"), "does not begin with a finite number"));
    CHECK(contains(quantity_message<Length>("1/0 m"), "division by zero"));
    CHECK(contains(quantity_message<Length>("1e308 Mm"), "for a double"));
    CHECK(contains(quantity_message<Length>("1e2147483647 Mm"), "for a double"));
    CHECK(contains(quantity_message<Time>("1e308 h"), "too large for a double"));
    CHECK(contains(quantity_message<Damping>("1 N*"), "a unit is missing at the end"));
    CHECK(contains(quantity_message<Damping>("1 N//m"), "unexpected \"/m\" in the unit"));
    CHECK(contains(quantity_message<Damping>("1 (N*s"), "a closing bracket is missing"));
    CHECK(contains(quantity_message<Damping>("1 N)"), "a closing bracket without an opening one"));
    CHECK(contains(quantity_message<Area>("1 m^"), "a power must be a whole number"));
    CHECK(contains(quantity_message<Area>("1 m^x"), "a power must be a whole number"));
    CHECK(contains(quantity_message<Area>("1 m^99999999999"), "the power is too large"));
    CHECK(contains(quantity_message<Area>("1 (((m^9)^9)^9)^9"), "the powers are too large"));
    CHECK(contains(quantity_message<Area>("1 " + std::string(1000, '(')), "the unit is too long"));
    CHECK(contains(quantity_message<Length>("1 m 3"), "unexpected \"3\" in the unit"));
    CHECK(contains(quantity_message<Length>("12.7 mm 5 mm"), "unexpected \"5 mm\" in the unit"));
}

TEST_CASE("quantities print in the units engineers write") {
    CHECK(format_quantity(Stiffness::from_value(30e6)) == "30 MN/m");
    CHECK(format_quantity(Velocity::from_value(0.424)) == "42.4 cm/s");
    CHECK(format_quantity(Velocity::from_value(2110.0)) == "2110 m/s");
    CHECK(format_quantity(0.511 * kStandardGravity) == "0.511 g");
    CHECK(format_quantity(Length::from_value(0.01271)) == "12.71 mm");
    CHECK(format_quantity(Length::from_value(-4.25)) == "-4.25 m");
    CHECK(format_quantity(Length::from_value(0.0)) == "0 m");
    CHECK(format_quantity(Time::from_value(10.41667e-6), 3) == "10.4 us");
    CHECK(format_quantity(Mass::from_value(0.0106604)) == "10.6604 g");
    CHECK(format_quantity(Ratio::from_value(0.63)) == "0.63");
    CHECK(format_quantity(StiffnessPerArea::from_value(89.6e9)) == "89.6 GPa/m");
    CHECK(format_si(2.0, Dimension{.length = 1, .mass = 2, .time = -5}) == "2 kg m^0.5 s^-2.5");
}

TEST_CASE("an uncertainty prints in the unit of its value") {
    const Dimension velocity = dimension_of<Velocity>();
    CHECK(format_si(0.001498, velocity) == "0.1498 cm/s");
    CHECK(format_si(2e-6, velocity) == "2 um/s");
    CHECK(format_si(0.000155, dimension_of<Length>()) == "0.155 mm");
    CHECK(format_si(5e-7, dimension_of<Length>()) == "0.5 um");
    CHECK(format_si(2.039e6, dimension_of<Mass>()) == "2039 t");
    CHECK(format_si(0.0009355, dimension_of<Time>()) == "935.5 us");
    CHECK(format_si_like(0.001498, 0.0424, velocity, 2) == "0.15 cm/s");
    CHECK(format_si_like(0.0424, 0.0424, velocity) == "4.24 cm/s");
    CHECK(format_si_like(0.5, 0.0, dimension_of<Length>()) == "0.5 m");
    CHECK(format_si_like(0.5, 300.0, RationalDimension::of(BaseDimension::temperature)) == "0.5 K");
}

TEST_CASE("what is printed is read back as the same quantity") {
    // 17 digits name a double; unit conversion on the way out and gravity on the way back round once or twice
    const auto check = [](auto quantity) {
        using Quantity = decltype(quantity);
        CAPTURE(format_quantity(quantity, 17));
        CHECK(si_value<Quantity>(format_quantity(quantity, 17)) == doctest::Approx(quantity.value()).epsilon(1e-15));
    };
    for (const double value : {1.0 / 3e7, 1.0 / 3e4, 1.0 / 3.0, 1e4 / 3.0, 1e8 / 3.0}) {
        check(Ratio::from_value(value));
        check(Length::from_value(value));
        check(Area::from_value(value));
        check(Volume::from_value(value));
        check(Time::from_value(value));
        check(Frequency::from_value(value));
        check(AngularAcceleration::from_value(value));
        check(Velocity::from_value(value));
        check(Acceleration::from_value(value));
        check(Mass::from_value(value));
        check(Density::from_value(value));
        check(Momentum::from_value(value));
        check(Force::from_value(value));
        check(Stress::from_value(value));
        check(Energy::from_value(value));
        check(Power::from_value(value));
        check(Stiffness::from_value(value));
        check(StiffnessPerArea::from_value(value));
        check(Damping::from_value(value));
        check(Inertia::from_value(value));
    }
}

}  // namespace musim::scaling::tests
