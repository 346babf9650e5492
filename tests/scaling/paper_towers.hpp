#pragma once

#include "scaling/structures/structure_properties.hpp"

/// The papers' tower and its models: measured blocks and face stiffnesses of [Harmon23] and what follows (shared similitude.md).
namespace musim::scaling::tests {

/// Width over height of a block, on its thin and its wide side.
inline constexpr double kThin = 1.36 / 4.25;
inline constexpr double kWide = 2.82 / 4.25;

/// Friction of aluminium over that of concrete.
inline constexpr double kAluminiumFriction = 0.18 / 0.59;

/// N = 38; sizes [mm], density [kg/m³], stiffnesses [MN/m], deviation [mm].
inline StructureProperties make_tower(const char* name, std::array<double, 3> block, double density, double friction, double restitution,
                                      double normal, double shear, double deviation) {
    return {.name = name,
            .block = {block[0] * 1e-3 * si::meters, block[1] * 1e-3 * si::meters, block[2] * 1e-3 * si::meters},
            .layers = 38,
            .density = density * si::kilograms_per_cubic_meter,
            .friction = friction,
            .restitution = restitution,
            .normal_stiffness = Stiffness::from_value(normal * 1e6),
            .shear_stiffness = Stiffness::from_value(shear * 1e6),
            .height_deviation = deviation * 1e-3 * si::meters};
}

/// Concrete: k of the prototype is that of the 1:25 model times 25, the same solid; its σ_H/H that of the model.
inline StructureProperties concrete_prototype() {
    return make_tower("concrete", {1360.0, 2820.0, 4250.0}, 2320.0, 0.59, 0.5, 26250.0, 25000.0, 12.5);
}
inline StructureProperties concrete_1_25() {
    return make_tower("concrete 1:25", {1360.0 / 25.0, 2820.0 / 25.0, 170.0}, 2320.0, 0.59, 0.5, 1050.0, 1000.0, 0.5);
}
inline StructureProperties wood_1_107() { return make_tower("wood 1:107", {12.710, 26.355, 39.780}, 800.0, 0.63, 0.3, 30.0, 26.0, 0.155); }
inline StructureProperties aluminium_1_107() {
    return make_tower("aluminium 1:107", {1360.0 / 107.0, 2820.0 / 107.0, 4250.0 / 107.0}, 2632.0, 0.18, 0.5, 510.0, 480.0, 0.155);
}

/// Ridgecrest, component 360: PGA 0.511 g, PGV 42.4 cm/s; the period is made.
inline MotionProperties ridgecrest() {
    return {.acceleration = 0.511 * kStandardGravity, .velocity = 0.424 * si::meters_per_second, .predominant_period = 0.5 * si::seconds};
}

}  // namespace musim::scaling::tests
