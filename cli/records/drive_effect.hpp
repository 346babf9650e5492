#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "records/measures/intensity.hpp"
#include "records/shake_table/drive_motion.hpp"

namespace musim::cli {

/// What taper, filters and the correction to rest do to one component of a model's record.
struct DriveEffect {
    std::string component;
    records::Intensity before, after;
    std::optional<double> mean_psa_factor;  ///< exp of the mean |ln| of the ratio of 5 % PSA; of accelerations
};

/// Effects of make_drive_recipe(), one per component, over periods of the model.
std::vector<DriveEffect> find_drive_effects(const records::GroundMotion& model, const records::DriveSettings& settings,
                                            std::span<const scaling::Time> periods);

/// Says what is done and what it changes.
void print_drive_effects(const std::vector<DriveEffect>& effects);

/// [{"component", "pga_g", "pgv_cm_s", "pgd_cm": [before, after], "mean_psa_factor"}, ...].
nlohmann::json to_json(const std::vector<DriveEffect>& effects);

}  // namespace musim::cli
