#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "cli/records/design_uncertainty_output.hpp"
#include "records/design/candidate.hpp"
#include "scaling/text_table.hpp"

namespace musim::cli {

/// The ranking, what conflicts where nothing is feasible, and for each candidate the limits used and the groups distorted at the ends and
/// at the length in mind; with uncertain inputs, these and coverage intervals, too, and what samples say of
/// ends and limits if they were drawn.
std::string make_design_report(const records::Design& design, const std::vector<records::Candidate>& candidates,
                               const DesignUncertainty& uncertainty, scaling::ReportStyle style);

/// The same as JSON, in SI units; "uncertainty" of the whole, of candidates, ranges and states only where something is uncertain;
/// "monte_carlo" of candidates where samples were drawn.
nlohmann::json to_json(const records::Design& design, const std::vector<records::Candidate>& candidates,
                       const DesignUncertainty& uncertainty);

}  // namespace musim::cli
