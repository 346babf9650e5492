#pragma once

#include <nlohmann/json_fwd.hpp>

#include "scaling/scale_law.hpp"

namespace musim::cli {

/// One JSON object: "law" (can be given back as a law file), "chosen", "factors" by name (null while open), "quantities" (name, unit,
/// meaning, state, factor, formula, latex, exponents, needs, and prototype and model as text and in SI where the prototype's is known),
/// "free" (count, among), "groups" (δ by product), "held" and "watched" (product, name, delta, formula, latex), "distortions" (those of
/// them with δ other than 1), "additions", "overruled".
nlohmann::json to_json(const scaling::SolvedLaw& solved);

void print_text(const scaling::SolvedLaw& solved);
void print_markdown(const scaling::SolvedLaw& solved);

/// Align environments of amsmath: factors, then groups; remarks as comments.
void print_latex(const scaling::SolvedLaw& solved);

}  // namespace musim::cli
