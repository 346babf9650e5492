#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "scaling/text_table.hpp"
#include "scaling/uncertainty/uncertain_law.hpp"

namespace musim::cli {

/// Inputs, and of every uncertain factor, product, value and addition its uncertainty, and what the samples say.
std::string make_uncertainty_report(const scaling::SolvedLaw& solved, const scaling::UncertainLawReport& report,
                                    scaling::ReportStyle style);

/// "inputs", "factors", "groups", "groups_as_shaken" and "monte_carlo" as in `musim scale` of the four laws; "values" of quantities whose
/// prototype is known, at both scales, and "additions" ("factor", and "model" where it is known), in SI.
nlohmann::json to_json(const scaling::SolvedLaw& solved, const scaling::UncertainLawReport& report);

}  // namespace musim::cli
