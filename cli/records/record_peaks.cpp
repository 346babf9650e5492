#include "cli/records/record_peaks.hpp"

#include <fmt/format.h>

#include "cli/output.hpp"
#include "records/error.hpp"
#include "records/measures/intensity.hpp"
#include "scaling/angle.hpp"

namespace musim::cli {

NamedValues list_rotation_peaks(const records::Intensity& intensity) {
    return {{"peak_angular_acceleration_rad_s2", "alpha [rad/s2]", or_null(size_of(intensity.angular_acceleration, 1.0)), ".4g", 14},
            {"peak_angular_velocity_rad_s", "omega [rad/s]", or_null(size_of(intensity.angular_velocity, 1.0)), ".4g", 13},
            {"peak_angle_rad", {}, or_null(size_of(intensity.angle, 1.0))},
            {{}, "angle [deg]", or_null(size_of(intensity.angle, scaling::kDegree)), ".4g", 11}};
}

NamedValues find_peaks(const records::GroundMotion& motion, const records::Component& component) {
    const records::Intensity intensity = records::compute_intensity(component.series, motion.integration_corner);
    const double dt = component.series.dt().value();
    NamedValues values{{{}, "component", component.name, "", -10},
                       {"dt_s", {}, dt},
                       {{}, "dt [ms]", 1e3 * dt, ".7g", 12},
                       {"duration_s", "length [s]", component.series.duration().value(), ".7g", 12}};
    const NamedValues peaks =
        records::is_rotation(component)
            ? list_rotation_peaks(intensity)
            : NamedValues{{"pga_g", "PGA [g]", or_null(size_of(intensity.pga, scaling::kStandardGravity.value())), ".5g", 10},
                          {"pgv_cm_s", "PGV [cm/s]", or_null(size_of(intensity.pgv, 0.01)), ".5g", 11}};
    values.insert(values.end(), peaks.begin(), peaks.end());
    values.push_back({"highpass_hz", {}, or_null(in_si(motion.integration_corner))});
    values.push_back({{}, "integrated", describe_integration(motion.integration_corner), "", -1});
    return values;
}

void print_peak_titles(const records::GroundMotion& motion, std::size_t component, const NamedValues& values) {
    const auto& all = motion.components;
    if (component == 0 || records::is_rotation(all[component]) != records::is_rotation(all[component - 1])) print_titles("", values);
}

records::GroundMotion keep_translations(records::GroundMotion motion, const std::string& file, std::string_view not_done) {
    const std::string all = motion.component_names();
    for (const records::Component& component : motion.components) {
        if (records::is_rotation(component)) {
            note_at_end(
                fmt::format("musim: note: {}: component {} is a rotation and {} (found of accelerations)", file, component.name, not_done));
        }
    }
    std::erase_if(motion.components, [](const records::Component& component) { return records::is_rotation(component); });
    if (motion.components.empty()) {
        throw records::ReadError(
            fmt::format("{}: no component is a translation (present: {}); name a record with accelerations", file, all));
    }
    return motion;
}

std::string describe_integration(const std::optional<scaling::Frequency>& corner) {
    return corner ? fmt::format("high-pass {:g} Hz", corner->value()) : "no filter";
}

}  // namespace musim::cli
