#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "records/measures/intensity.hpp"
#include "records/shake_table/drive_motion.hpp"
#include "records/shake_table/table_correction.hpp"

namespace musim::cli {

/// Uses of all limits; with the length scales that each of them leaves where they are given.
nlohmann::json to_json(const std::vector<records::ComponentUse>& uses, const std::vector<records::LimitScales>& scales = {});
nlohmann::json to_json(const records::ScaleRange& range);
nlohmann::json to_json(const records::Correction& correction, const scaling::ModelScales& scales);

/// One row for each limit of each component: what is asked, what the table can do, how far it is used, which length scales it leaves.
void print_uses(const std::vector<records::ComponentUse>& uses, const std::vector<records::LimitScales>& scales);

/// Which length scales the table can do, and what governs others.
void print_scales(const std::vector<records::ScaleRange>& ranges);

/// Correction in one line.
void print_correction(const records::Correction& correction, const scaling::ModelScales& scales);

/// Effect of a correction on the response spectra, at some of its periods, the prototype's and the model's.
void print_spectra(const records::Correction& correction, const scaling::ModelScales& scales);

/// Effect of filters, amplitude, step and end at rest on one component of a model's record.
struct DriveEffect {
    std::string component;
    records::ComponentChange change;
    std::optional<double> mean_psa_factor;  ///< exp of the mean |ln| of the ratio of 5 % PSA; of accelerations
};

/// Effects of make_drive_recipe(), one per component, over periods of the model.
std::vector<DriveEffect> find_drive_effects(const records::GroundMotion& model, const records::DriveSettings& settings,
                                            std::span<const scaling::Time> periods);

/// Prints what is done and what it changes.
void print_drive_effects(const std::vector<DriveEffect>& effects);

/// Warns of components whose PGA or PGV are not those of the record, see records::kChangedPeak.
void warn_of_drive_effects(const std::string& record, const std::vector<DriveEffect>& effects);

/// [{"component", "pga_g", "pgv_cm_s", "pgd_cm": [record, table], "largest_difference": {the same three}, "mean_psa_factor"}, ...].
nlohmann::json to_json(const std::vector<DriveEffect>& effects);

}  // namespace musim::cli
