#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "scaling/structures/regime_report.hpp"
#include "scaling/text_table.hpp"
#include "scaling/uncertainty/uncertain_regimes.hpp"

namespace musim::cli {

/// Report of `musim scale --properties`.
struct PropertiesReport {
    std::string name;
    scaling::PairProperties properties;  ///< with the model's motion, given or by the law
    scaling::Similitude similitude;
    scaling::RegimeReport report;
    scaling::UncertainRegimes uncertain = {};
};

/// Distortions with effect and sources, regimes, groups of both, structural speeds and what the model would need, blocks that rock, and
/// what the properties do not give; with uncertain properties, these, factors with u, and coverage intervals of the groups, those of the
/// samples if there are any, and the share of samples in which each regime is another.
std::string make_properties_report(const PropertiesReport& report, scaling::ReportStyle style);

/// One JSON object: what `musim scale` prints ("law", "factors", "groups", "distortions" of group, factor, severity, effect), where a
/// distortion has "direction", "prototype", "model", "required" and "sources" too, and "properties": {"name", "prototype", "model",
/// "groups", "regimes", "motion", "speeds", "rocking", "untold"}; quantities there have "prototype", "model", "required" by the law,
/// "factor" and "required_factor", in SI units that their keys name. A factor from zero is null. Uncertain properties add "uncertainty" of
/// inputs and factors, "uncertainty" of each group ("prototype", "model", "factor") and "limit_within_uncertainty" of each regime; samples
/// add "monte_carlo" to each of these, and "share_elsewhere" to regimes.
nlohmann::json to_json(const PropertiesReport& report);

}  // namespace musim::cli
