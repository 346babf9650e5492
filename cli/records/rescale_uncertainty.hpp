#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/options.hpp"
#include "cli/uncertain_options.hpp"
#include "records/ground_motion.hpp"
#include "scaling/uncertainty/uncertain_similitude.hpp"

namespace musim::cli {

/// What is uncertain about a rescaled record, by component.
struct UncertainRescale {
    std::vector<std::string> components;
    std::vector<scaling::UncertainReport> reports;  ///< one for each; they differ in structure and measures only
};

/// Propagates the factors' uncertainties to PGA, PGV, PGD, Arias intensity, duration and time step of every component, and to the groups of
/// the structure that `structure` gives; a vertical component has a_vertical/g alone. Empty when nothing is uncertain and no structure is
/// given. Throws scaling::SimilitudeError.
UncertainRescale find_uncertain_rescale(const records::GroundMotion& prototype, const SimilitudeOptions& factors,
                                        const UncertainStructureOptions& structure,
                                        const std::optional<scaling::MonteCarloSettings>& monte_carlo);

/// Adds "uncertainty" to a JSON object, unless there is nothing to give.
void add_to_json(nlohmann::json& object, const UncertainRescale& rescale);

/// Tables of inputs, measures and groups, unless there is nothing to give.
void print_uncertain_rescale(const UncertainRescale& rescale);

}  // namespace musim::cli
