#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "lsdem/model.hpp"

namespace musim::lsdem {

/// PGA of the record, or of the formula, that one component of the base's motion was made from. The base itself may have another one: its
/// velocity is linear between samples, so that its acceleration is the mean of two samples, and records are cut and filtered.
struct SourcePga {
    double acceleration = 0.0;  ///< absolute [m/s²]; 0: none, or not known
    bool is_record = false;     ///< else a formula of the scene
    std::string why;            ///< what can make the base's another one, in a few words

    /// Is it known, and another number than that of the base [m/s²], in the four digits that are printed?
    bool differs_from(double base) const;
};

/// PGA of the three components of a motion that ran until `end` [s].
std::array<SourcePga, 3> find_source_pga(const std::array<BaseComponent, 3>& motion, double end);

/// "PGA 0.5 g", or both where they differ: "PGA 0.5055 g at the base (0.511 g in the record at this scale: velocity linear between
/// samples)". `base`: of the base [m/s²].
std::string describe_pga(double base, const SourcePga& source);

/// Along x, y and z: {"of": "record" or "scene", "pga_g", "why"}, or null where not known.
nlohmann::json to_json(const std::array<SourcePga, 3>& sources);

/// Inverse of to_json. Throws nlohmann::json::exception for anything else.
std::array<SourcePga, 3> parse_source_pga(const nlohmann::json& json);

}  // namespace musim::lsdem
