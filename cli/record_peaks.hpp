#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "records/ground_motion.hpp"

namespace musim::cli {

/// Step, length and peaks of one component, as commands that turn one record into another tell them.
struct ComponentPeaks {
    double dt = 0.0, duration = 0.0;    ///< [s]
    std::optional<double> pga_g;        ///< [g]; of an acceleration
    std::optional<double> pgv_cm_s;     ///< [cm/s]
    std::optional<double> highpass_hz;  ///< [Hz]; corner of the high-pass before the velocity was found, of an uncorrected record
};

ComponentPeaks find_peaks(const records::GroundMotion& motion, const records::Component& component);
nlohmann::json to_json(const ComponentPeaks& peaks);

/// "high-pass 0.05 Hz", or "as it stands": how a record is integrated.
std::string describe_integration(const std::optional<double>& highpass_hz);

/// The heading of a table of such rows, and a row: `what` is the record, e.g. "prototype".
void print_peaks_heading();
void print_peaks(const std::string& what, const std::string& component, const ComponentPeaks& peaks);

}  // namespace musim::cli
