#pragma once

#include <optional>
#include <string>

#include "scaling/units.hpp"

/// Words on values that are hardly meant, for options and files alike: what the value says, and what may have been meant. They change no
/// result and refuse nothing; what is within the limits gets no word.
namespace musim::scaling {

/// A density below 50 kg/m³, less than cork and balsa have: g/cm³ or kN/m³ without their unit.
std::optional<std::string> describe_unlikely_density(Density density);

/// A friction coefficient above 5 and up to 90: an angle in degrees. Above, a contact is not to slip at all.
std::optional<std::string> describe_unlikely_friction(double friction);

/// A length factor above 1: 107 for 1/107. `option` stands before both numbers, such as "--length ".
std::optional<std::string> describe_unlikely_length_factor(double factor, const std::string& option = "");

/// An edge of a block above 25 m, more than the largest stones that were ever moved: millimetres without their unit.
std::optional<std::string> describe_unlikely_edge(Length edge);

}  // namespace musim::scaling
