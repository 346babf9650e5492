#include "records/measures/strongest_component.hpp"

#include <algorithm>
#include <cmath>

#include "records/measures/intensity.hpp"

namespace musim::records {

const Component& find_strongest_horizontal(const GroundMotion& motion) {
    const auto& all = motion.components;
    const bool directions_known = std::any_of(all.begin(), all.end(), [](const auto& c) { return c.azimuth_deg.has_value(); });
    const auto strength = [&](const Component& component) {
        return directions_known && !component.azimuth_deg
                   ? -1.0
                   : std::abs(find_peak_acceleration(level_uncorrected(component.series, motion.integration_corner)).value.value());
    };
    return *std::max_element(all.begin(), all.end(), [&](const auto& a, const auto& b) { return strength(a) < strength(b); });
}

}  // namespace musim::records
