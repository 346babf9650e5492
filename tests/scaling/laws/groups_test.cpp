#include "scaling/laws/groups.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "scaling/angle.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/scaling/expected.hpp"
#include "tests/scaling/paper_towers.hpp"

namespace musim::scaling::tests {

namespace {

const Length kBlockHeight = 4.25 * si::meter;

Length half_diagonal(double width) { return Length::from_value(0.5 * std::hypot(width, kBlockHeight.value())); }

}  // namespace

TEST_CASE("rocking groups of the prototype block agree with their reference values") {
    CHECK_EXPECTED(half_diagonal(1.36).value(), "2.2311");
    CHECK_EXPECTED(groups::frequency_parameter(kStandardGravity, half_diagonal(1.36)).value(), "1.8156");
    CHECK_EXPECTED(std::pow(groups::rocking_restitution(kThin), 2), "0.7407");
    CHECK_EXPECTED(groups::frequency_parameter(kStandardGravity, half_diagonal(2.82)).value(), "1.6982");
    CHECK_EXPECTED(std::pow(groups::rocking_restitution(kWide), 2), "0.2932");
    CHECK_EXPECTED(groups::rocking_frequency(3.6312 / si::seconds, kStandardGravity, half_diagonal(1.36)), "2.000");
    CHECK_EXPECTED(groups::rocking_demand(0.32 * kStandardGravity, kStandardGravity, kThin), 1.0);
}

TEST_CASE("friction over slenderness decides the regime of each material") {
    CHECK_EXPECTED(groups::regime(0.59, kThin), "1.844");
    CHECK_EXPECTED(groups::regime(0.59, kWide), "0.889");
    CHECK_EXPECTED(groups::regime(0.63, kThin), "1.969");
    CHECK_EXPECTED(groups::regime(0.63, kWide), "0.949");
    CHECK_EXPECTED(groups::regime(0.18, kThin), 0.5625);
    CHECK_EXPECTED(groups::regime(0.18, kWide), "0.271");
}

TEST_CASE("contact rigidity, wave speed and base overlap of wood and concrete agree with their reference values") {
    // wood 1:107, measured 12.710 x 26.355 x 39.780 mm, 10.6604 g, 30 MN/m
    const Length wood_height = 39.780e-3 * si::meter;
    const Mass wood_mass = 10.6604e-3 * si::kilogram;
    const Stiffness wood_stiffness = Stiffness::from_value(30e6);
    const Density wood_density = 800.0 * si::kilograms_per_cubic_meter;
    CHECK_EXPECTED(groups::contact_rigidity(wood_stiffness, wood_density, kStandardGravity, wood_height), "2.416e6");
    CHECK_EXPECTED(groups::stack_wave_speed(wood_height, wood_stiffness, wood_mass).value(), "2110");
    CHECK_EXPECTED(groups::overlap_over_height_deviation(38, wood_mass, kStandardGravity, wood_stiffness, 0.155e-3 * si::meter), "8.5e-4");

    // a velocity equal to the wave speed has Cauchy number 1
    const Velocity speed = groups::stack_wave_speed(wood_height, wood_stiffness, wood_mass);
    CHECK_EXPECTED(groups::cauchy_number(speed, wood_height, wood_stiffness, wood_mass), 1.0);
}

TEST_CASE("contact rigidity and base overlap of aluminium, concrete and the prototype agree with their reference values") {
    const Density concrete = 2320.0 * si::kilograms_per_cubic_meter;
    const Length model_height = 170.53e-3 * si::meter;
    const Stiffness model = Stiffness::from_value(1.05e9);  // [Harmon23] Table 3
    CHECK_EXPECTED(groups::contact_rigidity(model, concrete, kStandardGravity, model_height), "1.587e6");
    CHECK_EXPECTED(groups::overlap_over_height_deviation(38, Mass::from_value(2.42771), kStandardGravity, model, 0.5e-3 * si::meter),
                   "1.7e-3");

    const Stiffness aluminium = Stiffness::from_value(51e6);
    CHECK_EXPECTED(groups::contact_rigidity(aluminium, 2632.0 * si::kilograms_per_cubic_meter, kStandardGravity, 39.67e-3 * si::meter),
                   "1.256e6");

    // the prototype of the same concrete: stiffness and height deviation 25 times the model's
    const Stiffness prototype = 25.0 * model;
    CHECK_EXPECTED(groups::contact_rigidity(prototype, concrete, kStandardGravity, kBlockHeight), "6.388e4");
    CHECK_EXPECTED(groups::overlap_over_height_deviation(38, Mass::from_value(37815.07), kStandardGravity, prototype, 12.5e-3 * si::meter),
                   "0.043");
}

TEST_CASE("slenderness angles and radii of the prototype block agree with their reference values, and p scales by the root of g/l") {
    CHECK_EXPECTED(std::atan(kThin) / kDegree, "17.745");
    CHECK_EXPECTED(std::atan(kWide) / kDegree, "33.565");
    CHECK_EXPECTED(half_diagonal(2.82).value(), "2.5502");

    const Similitude centrifuge = make_similitude("froude", {.length = 1.0 / 25.0, .gravity = 9.0});
    const Frequency prototype = groups::frequency_parameter(kStandardGravity, half_diagonal(1.36));
    const Frequency model = groups::frequency_parameter(9.0 * kStandardGravity, centrifuge.to_model(half_diagonal(1.36)));
    CHECK_EXPECTED(model / prototype, 15.0);
    CHECK_EXPECTED(centrifuge.frequency(), 15.0);
}

TEST_CASE("the structural speed number of the 1:25 concrete model and of its prototype agree with their reference values") {
    // measured model: 170.53 mm, 2.42771 kg, 1000 MN/m; by its own height it stands for 4.25 m at 1:24.92
    const Length model_height = 170.53e-3 * si::meter;
    const Mass model_mass = Mass::from_value(2.42771);
    const Stiffness model_stiffness = Stiffness::from_value(1e9);
    CHECK_EXPECTED(groups::structural_speed_number(model_stiffness, model_height, 38, 0.59, model_mass, kStandardGravity), "565.2");

    // face springs of the same solid scale with length (Cauchy), masses with its cube
    const Similitude same_solid = make_similitude("cauchy", {.length = model_height / kBlockHeight});
    CHECK_EXPECTED(groups::structural_speed_number(same_solid.to_prototype(model_stiffness), kBlockHeight, 38, 0.59,
                                                   same_solid.to_prototype(model_mass), kStandardGravity),
                   "113.2");
}

TEST_CASE("the mu number is the Froude number over the root of friction") {
    const Velocity v = 0.424 * si::meters_per_second;
    const Length l = 161.5 * si::meter;
    const double mu_number = groups::mu_number(v, 0.59, kStandardGravity, l);
    CHECK_EXPECTED(mu_number, groups::froude_number(v, kStandardGravity, l) / std::sqrt(0.59));
    CHECK_EXPECTED(groups::sliding_time(l / v, 0.59, kStandardGravity, l), 1.0 / mu_number);
}

}  // namespace musim::scaling::tests
