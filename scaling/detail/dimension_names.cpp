#include "scaling/detail/dimension_names.hpp"

#include <fmt/format.h>

#include <utility>

#include "scaling/units.hpp"

namespace musim::scaling::detail {

namespace {

/// A display unit used from one of itself upwards. Others say from where: motions and sizes of blocks stay in cm/s and mm down to a
/// thousandth of them, as people write them.
DisplayUnit unit(std::string_view name, double size) { return {name, size, size}; }

std::vector<DimensionName> make_dimension_names() {
    return {
        {dimension_of<Ratio>(), "a plain number", "0.63", {unit("", 1.0)}},
        {dimension_of<Length>(),
         "a length",
         "4.25 m",
         {unit("nm", 1e-9), {"um", 1e-6, 1e-9}, {"mm", 1e-3, 1e-6}, unit("m", 1.0), unit("km", 1e3)}},
        {dimension_of<Area>(), "an area", "3.8 m^2", {unit("mm^2", 1e-6), unit("m^2", 1.0)}},
        {dimension_of<Volume>(), "a volume", "16.3 m^3", {unit("mm^3", 1e-9), unit("m^3", 1.0)}},
        {dimension_of<Time>(), "a time", "2.5 s", {unit("ns", 1e-9), unit("us", 1e-6), unit("ms", 1e-3), unit("s", 1.0)}},
        {dimension_of<Frequency>(), "a frequency", "4800 Hz", {unit("Hz", 1.0), unit("kHz", 1e3), unit("MHz", 1e6)}},
        {dimension_of<AngularAcceleration>(), "an angular acceleration", "5 rad/s^2", {unit("rad/s^2", 1.0)}},
        {dimension_of<Velocity>(), "a velocity", "42.4 cm/s", {unit("um/s", 1e-6), {"cm/s", 1e-2, 1e-5}, {"m/s", 1.0, 10.0}}},
        {dimension_of<Acceleration>(), "an acceleration", "0.511 g", {unit("g", kStandardGravity.value())}},
        {dimension_of<Mass>(), "a mass", "10.66 g", {unit("mg", 1e-6), unit("g", 1e-3), unit("kg", 1.0), unit("t", 1e3)}},
        {dimension_of<Density>(), "a density", "800 kg/m^3", {unit("kg/m^3", 1.0)}},
        {dimension_of<Momentum>(), "a momentum", "2 N*s", {unit("mN*s", 1e-3), unit("N*s", 1.0), unit("kN*s", 1e3)}},
        {dimension_of<Force>(), "a force", "2.5 kN", {unit("mN", 1e-3), unit("N", 1.0), unit("kN", 1e3), unit("MN", 1e6)}},
        {dimension_of<Stress>(), "a stress", "3.5 GPa", {unit("Pa", 1.0), unit("kPa", 1e3), unit("MPa", 1e6), unit("GPa", 1e9)}},
        {dimension_of<Energy>(),
         "an energy or moment",
         "1.5 kJ",
         {unit("uJ", 1e-6), unit("mJ", 1e-3), unit("J", 1.0), unit("kJ", 1e3), unit("MJ", 1e6), unit("GJ", 1e9)}},
        {dimension_of<Power>(), "a power", "2 kW", {unit("mW", 1e-3), unit("W", 1.0), unit("kW", 1e3), unit("MW", 1e6)}},
        {dimension_of<Stiffness>(), "a stiffness", "30 MN/m", {unit("N/m", 1.0), unit("kN/m", 1e3), unit("MN/m", 1e6)}},
        {dimension_of<StiffnessPerArea>(),
         "a stiffness per area",
         "89.6 GPa/m",
         {unit("Pa/m", 1.0), unit("kPa/m", 1e3), unit("MPa/m", 1e6), unit("GPa/m", 1e9)}},
        {dimension_of<Damping>(), "a damping coefficient", "2 kN*s/m", {unit("N*s/m", 1.0), unit("kN*s/m", 1e3), unit("MN*s/m", 1e6)}},
        {dimension_of<Inertia>(), "a moment of inertia", "0.1 kg*m^2", {unit("kg*mm^2", 1e-6), unit("kg*m^2", 1.0)}},
    };
}

}  // namespace

const DimensionName* find_dimension_name(const RationalDimension& dimension) {
    static const std::vector<DimensionName> kNames = make_dimension_names();
    const auto halves = to_halves(dimension);
    for (const DimensionName& entry : kNames) {
        if (halves && entry.dimension == *halves) return &entry;
    }
    return nullptr;
}

std::string describe(const RationalDimension& dimension) {
    const DimensionName* known = find_dimension_name(dimension);
    return known != nullptr ? std::string(known->name) : "in " + base_units(dimension);
}

std::string describe_wish(const RationalDimension& dimension) {
    const DimensionName* known = find_dimension_name(dimension);
    if (known == nullptr) return fmt::format("a quantity in {} is wanted", base_units(dimension));
    return fmt::format("{} is wanted (such as \"{}\")", known->name, known->example);
}

std::string base_units(const RationalDimension& dimension) {
    constexpr std::pair<std::string_view, BaseDimension> kUnits[] = {{"kg", BaseDimension::mass},
                                                                     {"m", BaseDimension::length},
                                                                     {"s", BaseDimension::time},
                                                                     {"K", BaseDimension::temperature},
                                                                     {"A", BaseDimension::current},
                                                                     {"mol", BaseDimension::amount},
                                                                     {"cd", BaseDimension::luminous_intensity}};
    std::string text;
    for (const auto& [name, base] : kUnits) {
        const Rational& exponent = dimension[base];
        if (exponent == 0) continue;
        if (!text.empty()) text += ' ';
        text += name;
        text += exponent.denominator() == 2 ? fmt::format("^{}", 0.5 * static_cast<double>(exponent.numerator())) : power_text(exponent);
    }
    return text;
}

}  // namespace musim::scaling::detail
