#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "design/candidate.hpp"
#include "scaling/text_table.hpp"

namespace musim::cli {

/// The ranking, what conflicts where nothing is feasible, and for each candidate the limits used and the groups distorted at the ends and
/// at the length in mind.
std::string make_design_report(const design::Design& design, const std::vector<design::Candidate>& candidates, scaling::ReportStyle style);

/// The same as JSON, in SI units.
nlohmann::json to_json(const design::Design& design, const std::vector<design::Candidate>& candidates);

}  // namespace musim::cli
