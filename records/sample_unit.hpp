#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace musim::records {

/// Quantity of a series' samples.
enum class SampleQuantity { acceleration, velocity, displacement };

/// "acceleration", "velocity" or "displacement".
std::string_view to_string(SampleQuantity quantity);

/// The quantity called `name` ("acceleration", "velocity", "displacement", any case); nothing for any other name.
std::optional<SampleQuantity> find_sample_quantity(std::string_view name);

/// SI unit of a quantity's samples: "m/s^2", "m/s" or "m".
std::string_view si_unit_name(SampleQuantity quantity);

/// A unit that record files use, and what it is worth.
struct SampleUnit {
    std::string_view name;                                   ///< as messages spell it, e.g. "cm/s^2"
    SampleQuantity quantity = SampleQuantity::acceleration;  ///< the quantity it measures
    double si = 1.0;                                         ///< SI value of one unit: sample_si = sample · si
};

/// Text of a unit in small ASCII letters, without brackets around it: "(cm/s²)" → "cm/s2", "µg" → "ug", "°C" → "degc".
std::string plain_unit_text(std::string_view text);

/// The unit spelled `text` in a record file: "g" (9.80665 m/s²), "mg", "%g", "gal", "cm/s2", "cm s⁻²", "cm/sec/sec", "(CM/S)", "ips", "mm",
/// "meters per second", ...; nothing if unknown.
std::optional<SampleUnit> find_sample_unit(std::string_view text);

/// Every known unit name, "g, gal, m/s^2, ...", for messages.
std::string sample_unit_names();

}  // namespace musim::records
