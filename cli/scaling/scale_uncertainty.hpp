#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "cli/options.hpp"
#include "cli/uncertain_options.hpp"
#include "scaling/text_table.hpp"
#include "scaling/uncertainty/uncertain_similitude.hpp"

namespace musim::cli {

/// What uncertain options of `musim scale` give. Throws scaling::SimilitudeError.
scaling::UncertainReport find_uncertain_scale(const SimilitudeOptions& factors, const UncertainStructureOptions& structure,
                                              const scaling::UncertainMotion& motion, const scaling::ModelProperties& properties,
                                              const std::optional<scaling::MonteCarloSettings>& monte_carlo);

/// Adds "structure" and "measures" with the values at both scales, if there are any, and "uncertainty" if there is one.
void add_to_json(nlohmann::json& object, const scaling::UncertainReport& report);

/// Tables of inputs, factors and groups with their uncertainties.
std::string make_uncertain_factors(const scaling::UncertainReport& report, scaling::ReportStyle style);

/// Tables of groups and measures at both scales, if there are any.
std::string make_structure_and_measures(const scaling::UncertainReport& report, scaling::ReportStyle style);

}  // namespace musim::cli
