#include "cli/records/record_peaks.hpp"

#include <fmt/format.h>

#include "records/measures/intensity.hpp"

namespace musim::cli {

NamedValues find_peaks(const records::GroundMotion& motion, const records::Component& component) {
    const records::Intensity intensity = records::compute_intensity(component.series, motion.integration_corner);
    const double dt = component.series.dt().value();
    std::optional<double> pgv;  // [cm/s]
    if (intensity.pgv) pgv = 100.0 * std::abs(intensity.pgv->value.value());
    return {{{}, "component", component.name, "", -10},
            {"dt_s", {}, dt},
            {{}, "dt [ms]", 1e3 * dt, ".7g", 12},
            {"duration_s", "length [s]", component.series.duration().value(), ".7g", 12},
            {"pga_g", "PGA [g]", or_null(size_of(intensity.pga, scaling::kStandardGravity.value())), ".5g", 10},
            {"pgv_cm_s", "PGV [cm/s]", or_null(pgv), ".5g", 11},
            {"highpass_hz", {}, or_null(in_si(motion.integration_corner))},
            {{}, "integrated", describe_integration(motion.integration_corner), "", -1}};
}

std::string describe_integration(const std::optional<scaling::Frequency>& corner) {
    return corner ? fmt::format("high-pass {:g} Hz", corner->value()) : "no filter";
}

}  // namespace musim::cli
