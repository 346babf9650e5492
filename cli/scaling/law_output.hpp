#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "scaling/text_table.hpp"
#include "scaling/uncertainty/uncertain_law.hpp"

namespace musim::cli {

/// One JSON object: "law" (can be given back as a law file), "chosen", "factors" by name (null while open), "quantities" (name, unit,
/// meaning, state, factor, formula, latex, exponents, needs, and prototype and model as text and in SI where the prototype's is known),
/// "free" (count, among), "groups" (δ by product), "held" and "watched" (product, name, delta, formula, latex), "distortions" (those of
/// them with δ other than 1), "additions", "overruled".
nlohmann::json to_json(const scaling::SolvedLaw& solved);

/// Factors, groups, what is to be added and what is free: tables as text or Markdown, or align environments of amsmath in LaTeX, with
/// remarks as comments.
std::string make_law_report(const scaling::SolvedLaw& solved, scaling::ReportStyle style);

/// "inputs", "factors", "groups", "groups_as_shaken" and "monte_carlo" as in `musim scale` of the four laws; "values" of quantities whose
/// prototype is known, at both scales, and "additions" ("factor", and "model" where it is known), in SI.
nlohmann::json to_json(const scaling::SolvedLaw& solved, const scaling::UncertainLawReport& report);

/// Inputs, and of every uncertain factor, product, value and addition its uncertainty, and what the samples say.
std::string make_uncertainty_report(const scaling::SolvedLaw& solved, const scaling::UncertainLawReport& report,
                                    scaling::ReportStyle style);

}  // namespace musim::cli
