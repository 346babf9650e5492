#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "records/design/design.hpp"
#include "records/design/properties.hpp"
#include "scaling/uncertainty/uncertain_reading.hpp"

namespace musim::records {

/// Reads {"schema": "musim-properties/1", "name",
///   "prototype", "model": {"preset": "concrete", "name", "block": [b, w, H], "layers", "density", "friction", "restitution", "modulus" or
///     "normal_stiffness" of a face, "shear_modulus" or "shear_stiffness", "stiffness_block": [b, w, H], "height_deviation", "gap",
///     "edge_radius", "blocks_per_layer", "ground_friction", "kinetic_friction", "gravity"},
///   "motion", "model_motion": {"acceleration", "velocity", "displacement", "vertical_acceleration", "predominant_period", "pulse_period",
///     "duration", "step", "lowest_frequency", "highest_frequency", "direction"} or {"file", "component", "vertical", "high_pass"},
///   "table": {"lowest_frequency", "highest_frequency"} or {"file", "axis"},
///   "law": a name, a law file beside this one, or {"law", "set", "hold"}}.
///
/// Keys and values mean what they mean in musim-design/1, but "gravity" is an acceleration (default g0). Density and friction may come from
/// a preset, whose values others in the same object replace; its stiffness is fitted to the block (k = E A/H). A face stiffness is that of
/// "stiffness_block", by default of the block. The model's default block is the prototype's times `length`, λ_l, and its layers are the
/// prototype's. "motion" is the prototype's, "model_motion" what the model was given; the latter needs the former. Throws ReadError
/// `source: place: what (why); what to do` for anything else, unknown keys included. `reading` takes values with standard uncertainties
/// (scaling/uncertain.hpp), which are refused without it, and where a value is chosen: "high_pass".
Properties parse_properties(std::string_view json, const std::string& source, const std::vector<Material>& presets, double length,
                            scaling::UncertainReading* reading = nullptr);

/// The two halves of parse_properties(), for a text that is read with many readings: its JSON, whose schema is checked, and the properties
/// in it.
nlohmann::ordered_json parse_properties_text(std::string_view json, const std::string& source);
Properties read_properties(const nlohmann::ordered_json& object, const std::string& source, const std::vector<Material>& presets,
                           double length, scaling::UncertainReading* reading);

}  // namespace musim::records
