#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace musim::records {

/// Quantity of a series' samples: of a translation, or of a rotation about an axis (positive by the right hand).
enum class SampleQuantity { acceleration, velocity, displacement, angular_acceleration, angular_velocity, angle };

/// "acceleration", "velocity", "displacement", "angular acceleration", "angular velocity" or "angle".
std::string_view to_string(SampleQuantity quantity);

/// The quantity called `name`, as to_string() calls it, any case, with a blank, "_" or "-" between words; nothing for any other name.
std::optional<SampleQuantity> find_sample_quantity(std::string_view name);

/// Every name of a quantity, "acceleration, velocity, ...", for messages.
std::string sample_quantity_names();

/// SI unit of a quantity's samples: "m/s^2", "m/s", "m", "rad/s^2", "rad/s" or "rad".
std::string_view si_unit_name(SampleQuantity quantity);

/// True for angles, their rates and accelerations.
bool is_rotation(SampleQuantity quantity);

/// Number of time derivatives of a displacement or an angle that the quantity is: 2 of accelerations, 1 of velocities, 0.
int derivative_order(SampleQuantity quantity);

/// The quantity of a translation or rotation with that many derivatives (0, 1 or 2): (true, 1) is the angular velocity.
SampleQuantity find_quantity(bool of_rotation, int derivatives);

/// A unit that record files use, and what it is worth.
struct SampleUnit {
    std::string_view name;                                   ///< as messages spell it, e.g. "cm/s^2"
    SampleQuantity quantity = SampleQuantity::acceleration;  ///< the quantity it measures
    double si = 1.0;                                         ///< SI value of one unit: sample_si = sample · si
};

/// Text of a unit in small ASCII letters, without brackets around it: "(cm/s²)" → "cm/s2", "µg" → "ug", "°C" → "degc".
std::string plain_unit_text(std::string_view text);

/// The unit spelled `text` in a record file: "g" (9.80665 m/s²), "mg", "%g", "gal", "cm/s2", "cm s⁻²", "cm/sec/sec", "(CM/S)", "ips", "mm",
/// "meters per second", "deg", "mrad", "dps", "rad/sec^2", ...; nothing if unknown.
std::optional<SampleUnit> find_sample_unit(std::string_view text);

/// Every known name of a unit of translations, "m/s^2, g, mg, ...", for messages.
std::string sample_unit_names();

/// The same with those of rotations, "..., rad, mrad, ..., deg/s^2".
std::string all_sample_unit_names();

}  // namespace musim::records
