#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "cli/records/record_spectra.hpp"

namespace musim::cli {

/// {"spectra": [...], "rotd": [...]}: file, component, damping, and a list of numbers for the period and every column.
nlohmann::json to_json(const std::vector<SpectrumTable>& tables);

/// A table on stdout.
void print_table(const SpectrumTable& table);

/// One row per table and period; a column that a table has not is empty in its rows.
std::string make_csv(const std::vector<SpectrumTable>& tables);

/// PSA over period on logarithmic axes, one curve per component, RotD and damping ratio.
std::string make_svg(const std::vector<SpectrumTable>& tables);

}  // namespace musim::cli
