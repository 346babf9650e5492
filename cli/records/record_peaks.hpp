#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "cli/named_values.hpp"
#include "records/ground_motion.hpp"
#include "records/measures/intensity.hpp"

namespace musim::cli {

/// The size of a peak in a unit [SI], where there is one.
template <class Peak>
std::optional<double> size_of(const std::optional<Peak>& peak, double unit) {
    return peak ? std::optional(std::abs(peak->value.value()) / unit) : std::nullopt;
}

/// Step, length and peaks of one component, as commands that turn one record into another give them; and the corner of the high-pass before
/// the velocity was found, of an uncorrected record.
NamedValues find_peaks(const records::GroundMotion& motion, const records::Component& component);

/// Peaks of a rotation in rad and degrees, those that its quantity does not give missing.
NamedValues list_rotation_peaks(const records::Intensity& intensity);

/// Prints the titles of a component's values where it is the first, or of another kind than the one before it: rotations have other peaks.
void print_peak_titles(const records::GroundMotion& motion, std::size_t component, const NamedValues& values);

/// The motion's translations, for what is found of accelerations alone; rotations are named in a note at the end, with what is not done
/// with them ("not drawn"). Throws ReadError when nothing is left.
records::GroundMotion keep_translations(records::GroundMotion motion, const std::string& file, std::string_view not_done);

/// "high-pass 0.05 Hz", or "no filter": how a record is integrated.
std::string describe_integration(const std::optional<scaling::Frequency>& corner);

}  // namespace musim::cli
