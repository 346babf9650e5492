#pragma once

#include "records/design/candidate.hpp"
#include "scaling/laws/scale_law_catalogue.hpp"

/// The papers' tower and materials (shared similitude.md, sections 4 and 8).
namespace musim::records {

namespace si = scaling::si;

inline Material make_material(const char* name, double density, double friction, double restitution, double deviation) {
    return {.name = name,
            .density = density * si::kilograms_per_cubic_meter,
            .friction = friction,
            .restitution = restitution,
            .deviation = deviation * si::meters};
}

/// A law that comes with musim.
inline DesignLaw by(const char* name) { return scaling::load_scale_law(name); }

inline Material wood() { return make_material("wood", 800.0, 0.63, 0.3, 0.155e-3); }
inline Material concrete() { return make_material("concrete", 2320.0, 0.59, 0.5, 0.5e-3); }
inline Material aluminium() { return make_material("aluminium", 2632.0, 0.18, 0.5, 0.155e-3); }

/// Axis x without a limit.
inline records::TableAxis free_axis() {
    records::TableAxis axis;
    axis.name = "x";
    return axis;
}

/// The concrete tower, the shaking of 0.424 m/s, 0.511 g and 10 Hz on `axis`, and no other limit.
inline Setting make_setting(const records::TableAxis& axis) {
    Setting setting;
    setting.design.prototype = {.block = {1.36 * si::meters, 2.82 * si::meters, 4.25 * si::meters},
                                .height = 161.5 * si::meters,
                                .density = 2320.0 * si::kilograms_per_cubic_meter,
                                .friction = 0.59,
                                .mass = 2.701509e8 * si::kilograms,
                                .mass_center = 80.75 * si::meters,
                                .restitution = 0.5,
                                .deviation = 12.5e-3 * si::meters};
    setting.design.materials = {concrete()};
    setting.design.laws = {by("mu")};
    setting.design.groups = default_groups();
    setting.loads = {{axis,
                      {0.2 * si::meters, 0.2 * si::meters, 0.424 * si::meters_per_second, 0.511 * scaling::kStandardGravity,
                       0.1 / si::seconds, 10.0 / si::seconds}}};
    return setting;
}

}  // namespace musim::records
