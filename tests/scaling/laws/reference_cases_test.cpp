#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "scaling/laws/groups.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/scaling/expected.hpp"

// The tower of [Andrade22] and [Harmon23]: concrete prototype (mu 0.59, 2320 kg/m3, 38 x 4.25 m), wood and aluminium at 1:107, concrete
// at 1:25, shaken by Ridgecrest CI.CLC 360 (0.511 g, 42.4 cm/s).
namespace musim::scaling::tests {

namespace {

constexpr double kFrictionOfConcrete = 0.59;
constexpr double kFrictionOfWood = 0.63;
constexpr double kFrictionOfAluminium = 0.18;

const Length kTowerHeight = 161.5 * si::meter;
const Velocity kPeakVelocity = 0.424 * si::meters_per_second;
const Acceleration kPeakAcceleration = 0.511 * kStandardGravity;

const ScaleFactors kWood{.length = 1.0 / 107.0, .friction = kFrictionOfWood / kFrictionOfConcrete, .density = 800.0 / 2320.0};
const ScaleFactors kAluminium{.length = 1.0 / 107.0, .friction = kFrictionOfAluminium / kFrictionOfConcrete};
const ScaleFactors kConcrete{.length = 1.0 / 25.0};
const ScaleFactors kCentrifuge{.length = 1.0 / 25.0, .gravity = 25.0};

struct KinematicCase {
    std::string name;
    Similitude similitude;
    double friction_model;
    Expected time, inverse_time, velocity, acceleration, peak_velocity_cm_s, peak_acceleration_g, mu_number, sliding_demand;
};

std::vector<KinematicCase> kinematic_cases() {
    return {
        {"prototype", Similitude(), kFrictionOfConcrete, 1.0, 1.0, 1.0, 1.0, 42.4, 0.511, "0.01387054", "0.8661017"},
        {"1:107, mu unchanged", make_similitude("froude", {.length = 1.0 / 107.0}), kFrictionOfConcrete, "0.0966736", "10.34408",
         "0.0966736", 1.0, "4.098963", 0.511, "0.01387054", "0.8661017"},
        {"1:107 wood, mu law", make_similitude("mu", kWood), kFrictionOfWood, "0.09355432", "10.68898", "0.09989698", "1.0677966",
         "4.235632", "0.5456441", "0.01387054", "0.8661017"},
        {"1:107 wood, Froude input", make_similitude("froude", kWood), kFrictionOfWood, "0.0966736", "10.34408", "0.0966736", 1.0,
         "4.098963", 0.511, "0.01342298", "0.8111111"},
        {"1:107 aluminium, mu law", make_similitude("mu", kAluminium), kFrictionOfAluminium, "0.1750241", "5.713499", "0.05339718",
         "0.3050847", "2.264041", "0.1558983", "0.01387054", "0.8661017"},
        {"1:107 aluminium, Froude input", make_similitude("froude", kAluminium), kFrictionOfAluminium, "0.0966736", "10.34408", "0.0966736",
         1.0, "4.098963", 0.511, "0.02511210", "2.838889"},
        {"1:25 concrete", make_similitude("mu", kConcrete), kFrictionOfConcrete, 0.2, 5.0, 0.2, 1.0, 8.48, 0.511, "0.01387054",
         "0.8661017"},
        {"1:25 centrifuge", make_similitude("exact", kCentrifuge), kFrictionOfConcrete, 0.04, 25.0, 1.0, 25.0, 42.4, 12.775, "0.01387054",
         "0.8661017"},
    };
}

struct DynamicCase {
    std::string name;
    Similitude similitude;
    Expected mass, force, force_vertical, stress_vertical, energy, energy_potential, inertia, stiffness, damping;
};

std::vector<DynamicCase> dynamic_cases() {
    return {
        {"1:107 wood, mu law", make_similitude("mu", kWood), "2.81482e-7", "3.00566e-7", "2.81482e-7", "3.22269e-3", "2.80902e-9",
         "2.63067e-9", "2.45857e-11", "3.21605e-5", "3.00876e-6"},
        {"1:107 wood, Froude input", make_similitude("froude", kWood), "2.81482e-7", "2.81482e-7", "2.81482e-7", "3.22269e-3", "2.63067e-9",
         "2.63067e-9", "2.45857e-11", "3.01186e-5", "2.91167e-6"},
        {"1:25 concrete", make_similitude("mu", kConcrete), 6.4e-5, 6.4e-5, 6.4e-5, 0.04, 2.56e-6, 2.56e-6, 1.024e-7, 1.6e-3, 3.2e-4},
        {"centrifuge 25", make_similitude("exact", kCentrifuge), 6.4e-5, 1.6e-3, 1.6e-3, 1.0, 6.4e-5, 6.4e-5, 1.024e-7, 0.04, 1.6e-3},
    };
}

}  // namespace

TEST_CASE("kinematic factors and scaled peaks of the papers' models agree with the reference table") {
    for (const KinematicCase& row : kinematic_cases()) {
        CAPTURE(row.name);
        const Similitude& similitude = row.similitude;
        CHECK_EXPECTED(similitude.time(), row.time);
        CHECK_EXPECTED(1.0 / similitude.time(), row.inverse_time);
        CHECK_EXPECTED(similitude.velocity(), row.velocity);
        CHECK_EXPECTED(similitude.acceleration(), row.acceleration);

        const Velocity peak_velocity = similitude.to_model(kPeakVelocity);
        const Acceleration peak_acceleration = similitude.to_model(kPeakAcceleration);
        const Acceleration gravity_model = kStandardGravity * similitude.gravity();
        CHECK_EXPECTED(100.0 * peak_velocity.value(), row.peak_velocity_cm_s);
        CHECK_EXPECTED(peak_acceleration / kStandardGravity, row.peak_acceleration_g);
        CHECK_EXPECTED(groups::mu_number(peak_velocity, row.friction_model, gravity_model, similitude.to_model(kTowerHeight)),
                       row.mu_number);
        CHECK_EXPECTED(groups::sliding_demand(peak_acceleration, row.friction_model, gravity_model), row.sliding_demand);
    }
}

TEST_CASE("dynamic factors of the papers' models agree with the reference table") {
    for (const DynamicCase& row : dynamic_cases()) {
        CAPTURE(row.name);
        CHECK_EXPECTED(row.similitude.mass(), row.mass);
        CHECK_EXPECTED(row.similitude.force(), row.force);
        CHECK_EXPECTED(row.similitude.force_vertical(), row.force_vertical);
        CHECK_EXPECTED(row.similitude.stress_vertical(), row.stress_vertical);
        CHECK_EXPECTED(row.similitude.energy(), row.energy);
        CHECK_EXPECTED(row.similitude.energy_potential(), row.energy_potential);
        CHECK_EXPECTED(row.similitude.inertia(), row.inertia);
        CHECK_EXPECTED(row.similitude.stiffness(), row.stiffness);
        CHECK_EXPECTED(row.similitude.damping(), row.damping);
    }
}

TEST_CASE("groups of the prototype under Ridgecrest and Denali agree with the reference table") {
    CHECK_EXPECTED(groups::froude_number(kPeakVelocity, kStandardGravity, kTowerHeight), "0.01065416");
    CHECK_EXPECTED(groups::mu_number(kPeakVelocity, kFrictionOfConcrete, kStandardGravity, 160.0 * si::meter), "0.01393540");

    const Velocity denali_velocity = 1.618 * si::meters_per_second;
    CHECK_EXPECTED(groups::mu_number(denali_velocity, kFrictionOfConcrete, kStandardGravity, kTowerHeight), "0.05293049");
    CHECK_EXPECTED(groups::sliding_demand(0.33 * kStandardGravity, kFrictionOfConcrete, kStandardGravity), "0.5593220");
    CHECK_EXPECTED(100.0 * make_similitude("mu", kConcrete).to_model(denali_velocity).value(), "32.36");
}

TEST_CASE("record steps and durations of the models agree with the reference table") {
    const Time step = 0.005 * si::seconds;
    const Time duration = 40.0 * si::seconds;
    CHECK_EXPECTED(1e3 * make_similitude("mu", kWood).to_model(step).value(), "0.4677716");
    CHECK_EXPECTED(make_similitude("mu", kWood).to_model(duration).value(), "3.742173");
    CHECK_EXPECTED((1e3 * make_similitude("froude", kWood).to_model(step).value()), "0.4833682");
    CHECK_EXPECTED((make_similitude("froude", kWood).to_model(duration).value()), "3.866946");
    CHECK_EXPECTED(make_similitude("mu", kConcrete).to_model(step).value(), 1e-3);
    CHECK_EXPECTED(make_similitude("mu", kConcrete).to_model(duration).value(), 8.0);
}

TEST_CASE("steps of the models' records at the papers' time steps agree with the reference table") {
    // [Harmon23] Table 4: a camera's period, 1/4800 s or 1/2000 s, over a whole number
    const Time wood_step = 1.0 / (4800.0 * 20.0) * si::seconds;
    const Time aluminium_step = 1.0 / (4800.0 * 80.0) * si::seconds;
    const Time concrete_step = 1.0 / (2000.0 * 34.0) * si::seconds;
    const Time duration = 40.0 * si::seconds;
    const auto steps = [&](const Similitude& similitude, const Time& step) { return similitude.to_model(duration) / step; };
    CHECK_EXPECTED(steps(make_similitude("mu", kWood), wood_step), "359249");
    CHECK_EXPECTED(steps(make_similitude("froude", kWood), wood_step), "371227");
    CHECK_EXPECTED(steps(make_similitude("froude", kAluminium), aluminium_step), "1484907");
    CHECK_EXPECTED(steps(make_similitude("mu", kConcrete), concrete_step), 544000.0);
    // no whole number of steps fits a sample of the record
    CHECK_EXPECTED(make_similitude("froude", kWood).to_model(0.005 * si::seconds) / wood_step, "46.4");
}

TEST_CASE("masses of blocks and towers, and the energy stored in the full tower, agree with the reference values") {
    struct Case {
        double density, width, depth, height;  // [kg/m³], [m]
        Expected block_mass, tower_mass;       // [kg]
    };
    constexpr double kBlocks = 38.0 * 188.0;
    // measured heights of the models' blocks [Harmon23]
    for (const Case& c : {Case{2320.0, 1.36, 2.82, 4.25, "37815.07", "2.701509e8"},
                          Case{800.0, 1.36 / 107.0, 2.82 / 107.0, 39.78e-3, "0.0106604", "76.158"},
                          Case{2632.0, 1.36 / 107.0, 2.82 / 107.0, 39.67e-3, "0.0349759", "249.87"},
                          Case{2320.0, 1.36 / 25.0, 2.82 / 25.0, 170.53e-3, "2.42771", "17343.6"}}) {
        CAPTURE(c.density);
        const double mass = c.density * c.width * c.depth * c.height;
        CHECK_EXPECTED(mass, c.block_mass);
        CHECK_EXPECTED(kBlocks * mass, c.tower_mass);
    }
    const Energy stored = 2.701509e8 * si::kilograms * kStandardGravity * kTowerHeight / 2.0;
    CHECK_EXPECTED(stored.value() / 3.6e9, "59.42");
}

TEST_CASE("a true replica at 1:25 needs a modulus of 1.167 GPa") {
    // bar wave speed of concrete 3546 m/s, density 2320 kg/m³
    const Stress modulus = Stress::from_value(2320.0 * 3546.0 * 3546.0);
    CHECK_EXPECTED(1e-9 * make_similitude("exact", kConcrete).to_model(modulus).value(), "1.167");
}

TEST_CASE("equation (4) of Harmon et al. is a misprint: the mu law gives 0.546 g in wood, not 0.0048 g") {
    const Acceleration model = make_similitude("mu", kWood).to_model(kPeakAcceleration);
    CHECK_EXPECTED(model / kStandardGravity, "0.546");
    CHECK_EXPECTED(kPeakAcceleration * kWood.length / kStandardGravity, "0.0048");
}

}  // namespace musim::scaling::tests
