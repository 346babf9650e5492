#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "records/design/design.hpp"
#include "scaling/uncertainty/uncertain_reading.hpp"

namespace musim::records {

/// Reads {"schema": "musim-design/1", "name",
///   "prototype": {"block": [b, w, H], "height", "density", "friction", "mass", "mass_center", "restitution", "modulus" or
///     "normal_stiffness" of a face, "shear_modulus" or "shear_stiffness", "height_deviation"},
///   "table": "array.json", "record": {"file", "axes": {"360": "x"}, "high_pass"} or {"peaks": [{"axis", "acceleration", "velocity",
///     "displacement", "lowest_frequency", "highest_frequency"}, ...]},
///   "limits": {"hall_height", "deviation_ratio", "overlap_ratio", "camera": {"rate", "pictures"}},
///   "materials": ["wood", {"preset": "wood", "height_deviation": "0.155 mm"}, {"name", "density", "friction", "restitution", "modulus" or
///     "normal_stiffness" with "stiffness_block": [b, w, H], "shear_...", "height_deviation", "smallest_edge", "price"}, ...],
///   "laws": ["mu", "true_replica", "mine.json", {"law": "restoring_force", "set": {"F_R": "1/500"}, "hold": [products]}], "gravity": 1,
///   "length": "1/25", "groups": ["mu^N", ...]}.
/// Quantities are text with a unit, plain numbers may be text such as "0.63/0.59". A name among the materials is that of a preset, whose
/// values others in the same object replace. Defaults: mass of the prototype 0, its centre at half the height, law mu, groups
/// default_groups(). A record and a table need each other. Throws ReadError `source: place: what (why); what to do` for anything else,
/// unknown keys included. `reading` takes measured values and limits with standard uncertainties (scaling/uncertain.hpp), which are refused
/// without it, and where a value is chosen: "length", "high_pass", "pictures".
Design parse_design(std::string_view json, const std::string& source, const std::vector<Material>& presets,
                    scaling::UncertainReading* reading = nullptr);

}  // namespace musim::records
