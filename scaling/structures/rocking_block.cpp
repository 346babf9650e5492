#include "scaling/structures/rocking_block.hpp"

#include <algorithm>
#include <cmath>

#include "scaling/laws/groups.hpp"

namespace musim::scaling {

double RockingBlock::slenderness() const { return (width / height).value(); }

double RockingBlock::angle() const { return std::atan(slenderness()); }

Length RockingBlock::half_diagonal() const { return Length::from_value(0.5 * std::hypot(width.value(), height.value())); }

Frequency RockingBlock::frequency_parameter(Acceleration gravity) const { return groups::frequency_parameter(gravity, half_diagonal()); }

double RockingBlock::angular_restitution() const { return groups::rocking_restitution(slenderness()); }

double RockingBlock::energy_restitution() const { return angular_restitution() * angular_restitution(); }

std::string_view to_string(FirstMotion motion) {
    constexpr std::string_view kNames[] = {"rests", "slides", "rocks", "slides and rocks"};
    return kNames[static_cast<std::size_t>(motion)];
}

double find_friction_to_rock(double acceleration_over_gravity, double slenderness) {
    // q: acceleration of the mass centre along the shaking and relative to the base, over g
    const double relative = 0.75 / (1.0 + slenderness * slenderness) * (acceleration_over_gravity - slenderness);
    return (acceleration_over_gravity - relative) / (1.0 + relative * slenderness);
}

FirstMotion find_first_motion(double acceleration_over_gravity, double friction, double slenderness) {
    if (acceleration_over_gravity <= std::min(friction, slenderness)) return FirstMotion::rest;
    if (friction <= slenderness) return FirstMotion::slide;
    return friction < find_friction_to_rock(acceleration_over_gravity, slenderness) ? FirstMotion::slide_rock : FirstMotion::rock;
}

}  // namespace musim::scaling
