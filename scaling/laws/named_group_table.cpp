#include "scaling/laws/named_groups.hpp"
#include "scaling/units.hpp"

namespace musim::scaling {

namespace {

using enum RoleCheck;

constexpr RationalDimension kRatio = dimension_of<Ratio>();
constexpr RationalDimension kLength = dimension_of<Length>();
constexpr RationalDimension kTime = dimension_of<Time>();
constexpr RationalDimension kRate = dimension_of<Frequency>();
constexpr RationalDimension kVelocity = dimension_of<Velocity>();
constexpr RationalDimension kAcceleration = dimension_of<Acceleration>();
constexpr RationalDimension kMass = dimension_of<Mass>();
constexpr RationalDimension kDensity = dimension_of<Density>();
constexpr RationalDimension kForce = dimension_of<Force>();
constexpr RationalDimension kStress = dimension_of<Stress>();
constexpr RationalDimension kStiffness = dimension_of<Stiffness>();
constexpr RationalDimension kEnergy = dimension_of<Energy>();
constexpr RationalDimension kArea = dimension_of<Area>();
constexpr RationalDimension kKinematicViscosity = kLength * kVelocity;
constexpr RationalDimension kViscosity = kStress * kTime;

/// The roles that many groups share.
GroupRole velocity(Rational exponent) { return {"v", kVelocity, exponent, dimension, {}}; }
GroupRole length(Rational exponent) { return {"l", kLength, exponent, dimension, {}}; }
GroupRole density(Rational exponent) { return {"rho", kDensity, exponent, dimension, {}}; }
GroupRole gravity(Rational exponent) { return {"g", kAcceleration, exponent, hinted, {"g", "gravity", "g0", "gn"}}; }
GroupRole friction_coefficient(Rational exponent) { return {"mu", kRatio, exponent, named, {"mu", "μ", "friction"}}; }
GroupRole strength(Rational exponent) {
    return {"mu g", kAcceleration, exponent, named, {"mu g", "mug", "mu_g", "μg", "μ g", "strength", "a_y", "ay"}};
}
GroupRole slenderness(Rational exponent) {
    return {"tan(alpha)", kRatio, exponent, named, {"tan_alpha", "tan alpha", "slenderness", "tan α"}};
}
GroupRole tension(Rational exponent) { return {"sigma", kStiffness, exponent, hinted, {"sigma", "gamma", "σ", "γ", "surface_tension"}}; }
GroupRole slip(Rational exponent) { return {"u", kLength, exponent, named, {"u", "slip", "D_slip", "displacement"}}; }
GroupRole modulus(Rational exponent) { return {"E", kStress, exponent, hinted, {"E", "modulus", "Y", "G", "K"}}; }
GroupRole pressure(Rational exponent) {
    return {"p", kStress, exponent, hinted, {"p", "P", "dp", "Dp", "delta_p", "Delta_p", "Δp", "pressure", "pressure_drop"}};
}
GroupRole drag(Rational exponent) { return {"F", kForce, exponent, hinted, {"F", "D", "R", "drag", "resistance", "FD"}}; }
GroupRole rate(Rational exponent) { return {"f", kRate, exponent, dimension, {}}; }
GroupRole viscosity(Rational exponent) { return {"eta", kViscosity, exponent, dimension, {}}; }
GroupRole kinematic_viscosity(Rational exponent) {
    return {"nu", kKinematicViscosity, exponent, hinted, {"nu", "ν", "viscosity", "kinematic_viscosity"}};
}

const Rational kHalf(1, 2);

std::vector<NamedGroup> make_named_groups() {
    return {
        // sliding
        {"mu number", "v/sqrt(mu*g*l)", {velocity(1), friction_coefficient(-kHalf), gravity(-kHalf), length(-kHalf)}},
        {"mu number", "v/sqrt((mu g)*l)", {velocity(1), strength(-kHalf), length(-kHalf)}},
        {"sliding demand", "a/(mu*g)", {{"a", kAcceleration, 1, dimension, {}}, friction_coefficient(-1), gravity(-1)}},
        {"sliding demand", "a/(mu g)", {{"a", kAcceleration, 1, dimension, {}}, strength(-1)}},
        {"Newmark slip", "u*mu*g/v^2", {slip(1), friction_coefficient(1), gravity(1), velocity(-2)}},
        {"Newmark slip", "u*(mu g)/v^2", {slip(1), strength(1), velocity(-2)}},
        {"sliding time", "t*sqrt(mu*g/l)", {{"t", kTime, 1, dimension, {}}, friction_coefficient(kHalf), gravity(kHalf), length(-kHalf)}},
        {"sliding time", "t*sqrt((mu g)/l)", {{"t", kTime, 1, dimension, {}}, strength(kHalf), length(-kHalf)}},
        {"regime", "mu/tan(alpha)", {friction_coefficient(1), slenderness(-1)}},
        // weight
        {"Froude", "v/sqrt(g*l)", {velocity(1), gravity(-kHalf), length(-kHalf)}},
        {"gravity time", "t*sqrt(g/l)", {{"t", kTime, 1, dimension, {}}, gravity(kHalf), length(-kHalf)}},
        {"acceleration in g", "a/g", {{"a", kAcceleration, 1, dimension, {}}, {"g", kAcceleration, -1, named, gravity(-1).names}}},
        // rocking; the number 3/4 of p^2 = 3 g/(4 R) is left out
        {"Housner p", "omega*sqrt(R/g)", {rate(1), {"R", kLength, kHalf, hinted, {"R", "half_diagonal"}}, gravity(-kHalf)}},
        {"rocking demand", "a/(g*tan(alpha))", {{"a", kAcceleration, 1, dimension, {}}, gravity(-1), slenderness(-1)}},
        // elasticity
        {"Cauchy", "v*sqrt(rho/E)", {velocity(1), density(kHalf), modulus(-kHalf)}},
        {"kappa", "k/(rho*g*l^2)", {{"k", kStiffness, 1, hinted, {"k", "kn", "ks", "stiffness"}}, density(-1), gravity(-1), length(-2)}},
        {"kappa",
         "k*l/(m*g)",
         {{"k", kStiffness, 1, hinted, {"k", "kn", "ks", "stiffness"}}, length(1), {"m", kMass, -1, dimension, {}}, gravity(-1)}},
        {"E/(rho*g*l)", "E/(rho*g*l)", {modulus(1), density(-1), gravity(-1), length(-1)}},
        {"spring number",
         "v/(l*sqrt(k/m))",
         {velocity(1), length(-1), {"k", kStiffness, -kHalf, hinted, {"k", "kn", "ks", "stiffness"}}, {"m", kMass, kHalf, dimension, {}}}},
        // flow
        {"Reynolds", "rho*v*l/eta", {density(1), velocity(1), length(1), viscosity(-1)}},
        {"Reynolds", "v*l/nu", {velocity(1), length(1), kinematic_viscosity(-1)}},
        {"Weber", "rho*v^2*l/sigma", {density(1), velocity(2), length(1), tension(-1)}},
        {"Bond", "rho*g*l^2/sigma", {density(1), gravity(1), length(2), tension(-1)}},
        {"capillary number", "eta*v/sigma", {viscosity(1), velocity(1), tension(-1)}},
        {"Ohnesorge", "eta/sqrt(rho*sigma*l)", {viscosity(1), density(-kHalf), tension(-kHalf), length(-kHalf)}},
        {"Mach", "v/c", {velocity(1), {"c", kVelocity, -1, named, {"c", "sound_speed", "speed_of_sound"}}}},
        {"Euler", "p/(rho*v^2)", {pressure(1), density(-1), velocity(-2)}},
        {"Strouhal", "f*l/v", {rate(1), length(1), velocity(-1)}},
        {"drag coefficient", "F/(rho*v^2*l^2)", {drag(1), density(-1), velocity(-2), length(-2)}},
        {"drag coefficient", "F/(rho*v^2*A)", {drag(1), density(-1), velocity(-2), {"A", kArea, -1, dimension, {}}}},
        {"Galilei", "g*l^3/nu^2", {gravity(1), length(3), kinematic_viscosity(-2)}},
        {"Taylor blast", "E*t^2/(rho*R^5)", {{"E", kEnergy, 1, dimension, {}}, {"t", kTime, 2, dimension, {}}, density(-1), length(-5)}},
    };
}

}  // namespace

const std::vector<NamedGroup>& named_groups() {
    static const std::vector<NamedGroup> kGroups = make_named_groups();
    return kGroups;
}

}  // namespace musim::scaling
