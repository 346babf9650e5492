#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/response/response.hpp"
#include "lsdem/run/specimen_file.hpp"
#include "lsdem/study/compare_ensembles.hpp"
#include "records/ground_motion.hpp"

namespace musim::lsdem {

/// A stored run, and how it stands to the others beside it.
struct ReportedRun {
    std::string label;  ///< its folder
    std::filesystem::path folder;
    StoredRun run = {};
    std::optional<Response> response = {};       ///< nothing when it cannot be measured
    nlohmann::json summary = {};                 ///< summary.json
    std::string scene_name = {}, material = {};  ///< as its scene says; empty when it says nothing
    bool stands = false;                         ///< a specimen, whose blocks are shown as those of a run
};

/// A record of a motion.
struct ReportedRecord {
    std::string label;  ///< its file
    records::GroundMotion motion;
};

/// Output that another command has printed with --json, into a file.
struct ReportedDocument {
    std::string label;  ///< its file
    nlohmann::json json;
};

/// A prepared structure.
struct ReportedSpecimen {
    std::string label;  ///< its file
    StoredSpecimen specimen;
};

/// Seeds of one scene.
struct ReportedEnsemble {
    std::string label;  ///< its folder
    std::filesystem::path folder;
    nlohmann::json summary;                        ///< ensemble.json
    std::optional<DimensionlessBands> bands = {};  ///< nothing when no member is a result, or nothing makes them dimensionless
};

/// Relation of the runs of a report to each other.
enum class ReportKind {
    run,       ///< one
    runs,      ///< several that were named together
    pair,      ///< a prototype and its models
    sequence,  ///< stages on the same structure
    ensemble,  ///< seeds of one scene, or of several; a member of the first one stands for them
    nothing,   ///< no run at all
};

/// Everything that a report shows, read.
struct ReportContent {
    ReportKind kind = ReportKind::nothing;
    std::string title;
    std::vector<ReportedRun> runs;
    nlohmann::json summary;  ///< pair.json or sequence.json
    std::vector<ReportedEnsemble> ensembles;
    std::vector<ReportedSpecimen> specimens;
    std::vector<ReportedRecord> records;
    std::vector<ReportedDocument> documents;
    std::vector<std::string> remarks;  ///< what is missing or cannot be read, each with what would help
};

/// Reads a record file; throws records::ReadError.
using RecordReader = std::function<records::GroundMotion(const std::filesystem::path&)>;

/// Reads what lies in folders of `musim run`, `pair`, `sequence`, `ensemble` and `specimen`, or in several of runs; specimens, records and
/// what a command printed with --json as files of their own. What cannot be read becomes a remark. Throws ResultError when nothing
/// at all can be shown.
ReportContent read_content(const std::vector<std::filesystem::path>& places, const RecordReader& read_record);

}  // namespace musim::lsdem
