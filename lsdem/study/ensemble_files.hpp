#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "lsdem/plot/plot.hpp"
#include "lsdem/results/write_results.hpp"
#include "lsdem/study/ensemble.hpp"

namespace musim::lsdem {

/// The summary but for its histories, in one JSON object; layout in docs/user/file_formats.md. What a sample cannot give (the deviation of
/// one member) is null. Holds nothing that differs from one computation of the same members to the next, such as run times.
nlohmann::json to_json(const EnsembleSummary& summary, const std::string& version);

/// One member as in the list of to_json.
nlohmann::json to_json(const MemberResult& member);

/// Spine velocities along the main motion, one row per level, mean over the members and the band mean ± sd: v/√(μ g l) over t √(μ g/l), or
/// dimensional without friction or gravity. As Fig. 8 of [Harmon23].
StackedPlot make_ensemble_plot(const EnsembleSummary& summary);

/// Adds ensemble.json, ensemble.h5, ensemble.csv and ensemble.svg to a folder; those of histories only when a member is a result. Layouts
/// in docs/user/file_formats.md. Throws records::WriteError.
void add_ensemble(ResultFolder& folder, const EnsembleSummary& summary, const std::string& version);

}  // namespace musim::lsdem
