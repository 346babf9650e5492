#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/study/ensemble_bands.hpp"
#include "lsdem/study/response.hpp"

namespace musim::lsdem::report {

/// A stored run, and how it stands to the others beside it.
struct ReportedRun {
    std::string label;  ///< its folder
    std::filesystem::path folder;
    study::StoredRun run;
    std::optional<study::Response> response;                        ///< nothing when it cannot be measured
    nlohmann::json summary;                                         ///< summary.json
    std::string scene_name, material;                               ///< as its scene says; empty when it says nothing
    double length = 1.0, time = 1.0, velocity = 1.0, energy = 1.0;  ///< λ of it to its prototype; 1 for a run of its own
};

/// What the runs of a report have to do with each other.
enum class ReportKind {
    run,       ///< one
    runs,      ///< several that were named together
    pair,      ///< a prototype and its models
    sequence,  ///< stages on the same structure
    ensemble,  ///< seeds of one scene; one of its members stands for them
    nothing,   ///< no run at all, only remarks
};

/// Everything that a report shows, read.
struct ReportContent {
    ReportKind kind = ReportKind::nothing;
    std::string title;
    std::vector<ReportedRun> runs;
    nlohmann::json summary;            ///< pair.json, sequence.json or ensemble.json
    std::string picture;               ///< of an ensemble: its bands as SVG
    std::vector<std::string> remarks;  ///< what is missing or cannot be read, each with what would help
};

/// Reads what lies in folders of `musim run`, `pair`, `sequence` and `ensemble`, or in several of runs. What cannot be read becomes a
/// remark. Throws study::ResultError when nothing at all can be shown.
ReportContent read_content(const std::vector<std::filesystem::path>& folders);

}  // namespace musim::lsdem::report
