#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "cli/named_values.hpp"
#include "records/ground_motion.hpp"

namespace musim::cli {

/// The size of a peak in a unit [SI], where there is one.
template <class Peak>
std::optional<double> size_of(const std::optional<Peak>& peak, double unit) {
    return peak ? std::optional(std::abs(peak->value.value()) / unit) : std::nullopt;
}

/// Step, length and peaks of one component, as commands that turn one record into another give them; and the corner of the high-pass before
/// the velocity was found, of an uncorrected record.
NamedValues find_peaks(const records::GroundMotion& motion, const records::Component& component);

/// "high-pass 0.05 Hz", or "no filter": how a record is integrated.
std::string describe_integration(const std::optional<scaling::Frequency>& corner);

}  // namespace musim::cli
