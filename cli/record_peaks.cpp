#include "cli/record_peaks.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/named_values.hpp"
#include "cli/output.hpp"
#include "records/intensity.hpp"

namespace musim::cli {

ComponentPeaks find_peaks(const records::GroundMotion& motion, const records::Component& component) {
    const records::Intensity intensity = records::compute_intensity(component.series, motion.integration_corner);
    ComponentPeaks peaks{.dt = component.series.dt().value(),
                         .duration = component.series.duration().value(),
                         .pga_g = {},
                         .pgv_cm_s = {},
                         .highpass_hz = {}};
    if (motion.integration_corner) peaks.highpass_hz = motion.integration_corner->value();
    if (intensity.pga) peaks.pga_g = std::abs(intensity.pga->value.value()) / scaling::kStandardGravity.value();
    if (intensity.pgv) peaks.pgv_cm_s = 100.0 * std::abs(intensity.pgv->value.value());
    return peaks;
}

nlohmann::json to_json(const ComponentPeaks& peaks) {
    nlohmann::json object{{"dt_s", peaks.dt}, {"duration_s", peaks.duration}, {"pga_g", nullptr}, {"pgv_cm_s", nullptr}};
    if (peaks.pga_g) object["pga_g"] = *peaks.pga_g;
    object["highpass_hz"] = or_null(peaks.highpass_hz);
    if (peaks.pgv_cm_s) object["pgv_cm_s"] = *peaks.pgv_cm_s;
    return object;
}

std::string describe_integration(const std::optional<double>& highpass_hz) {
    return highpass_hz ? fmt::format("high-pass {:g} Hz", *highpass_hz) : "as it stands";
}

void print_peaks_heading() {
    print("{:<10} {:<10} {:>12} {:>12} {:>10} {:>11}  {}\n", "", "component", "dt [ms]", "length [s]", "PGA [g]", "PGV [cm/s]",
          "integrated");
}

void print_peaks(const std::string& what, const std::string& component, const ComponentPeaks& peaks) {
    print("{:<10} {:<10} {:>12.7g} {:>12.7g} {:>10} {:>11}  {}\n", what, component, 1e3 * peaks.dt, peaks.duration, or_dash(peaks.pga_g, 5),
          or_dash(peaks.pgv_cm_s, 5), describe_integration(peaks.highpass_hz));
}

}  // namespace musim::cli
