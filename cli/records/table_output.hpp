#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

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

/// What is changed, in one line.
void print_correction(const records::Correction& correction, const scaling::ModelScales& scales);

/// What a correction does to the response spectra, at some of its periods, the prototype's and the model's.
void print_spectra(const records::Correction& correction, const scaling::ModelScales& scales);

}  // namespace musim::cli
