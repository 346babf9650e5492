#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/report/html.hpp"
#include "lsdem/report/report_content.hpp"
#include "lsdem/report/report_figure.hpp"

/// A page and its sections, each made from what was read.
namespace musim::lsdem {

/// A part of a report under a heading of its own.
struct ReportSection {
    std::string id;  ///< of the heading, for links
    std::string title;
    std::string html = {};  ///< before the figures
    std::vector<ReportFigure> figures = {};
    bool figures_beside = false;  ///< where the page is wide: beside what is before them
};

/// One HTML page that needs nothing else: no network, no server. `version` of the program that made it.
std::string make_page(const ReportContent& content, const std::vector<ReportSection>& sections, const std::string& version);
/// The sections of a report in their order: verdict first.
std::vector<ReportSection> make_sections(const ReportContent& content);

/// The main result in a sentence or two with its numbers: of a pair, a sequence or the runs together; of each ensemble. Empty when there is
/// no run.
std::vector<Statement> make_headlines(const ReportContent& content);
/// Verdict, which one should know first: the main result, then warnings and what is missing; folded below them how each run ended.
ReportSection make_verdict_section(const ReportContent& content);

/// The runs' blocks in 3D, side by side in the time of the first, with all that steers them; what is rounded, and by how much. Without
/// three.js on this machine only a line that says so.
ReportSection make_tower_section(const ReportContent& content);
/// The scripts that the section needs, three.js first; empty when that is not on this machine.
std::string make_tower_scripts();

/// Scenes, materials, scales, steps, times and versions of the runs.
ReportSection make_overview_section(const ReportContent& content);
/// Velocities of the spine, of a pair with the band of its twins, and how far runs are from the first.
std::vector<ReportFigure> make_spine_figures(const ReportContent& content);
/// Largest forces of loads, and their force over displacement. Nothing for a first run without loads.
std::optional<ReportSection> make_load_section(const std::vector<ReportedRun>& runs);
/// Profiles and energies of all runs, loads where there are any, and speeds where they were found.
std::vector<ReportSection> make_run_sections(const std::vector<ReportedRun>& runs);
/// Peaks of the sensors of all runs, histories of the first. Nothing where none has any.
std::optional<ReportSection> make_sensor_section(const std::vector<ReportedRun>& runs);

/// Factors of the models to their prototype, and the groups they distort, by colour and word.
ReportSection make_scale_section(const ReportContent& content);
/// The stages of a sequence: what each did, and what all have left.
ReportSection make_sequence_section(const ReportContent& content);
/// The members of each ensemble, and how far the ensembles agree.
ReportSection make_ensemble_section(const ReportContent& content);
/// The bands of their motion; none when no ensemble has one.
std::vector<ReportFigure> make_ensemble_figures(const std::vector<ReportedEnsemble>& ensembles);

/// Records as files hold them: histories, peaks, spectra, one figure a file.
ReportSection make_record_section(const ReportContent& content);
/// Base motion of each run, and its source: the motion divided by the factors that its scene applied to the record, with
/// histories and spectra of both. Accelerations are means between two samples of the run. Nothing for runs whose base stands.
std::optional<ReportSection> make_base_motion_section(const ReportContent& content);

/// Prepared structures: blocks, tilts and contact forces, level by level [Harmon23, Fig. 6].
ReportSection make_specimen_section(const ReportContent& content);
/// Specimens as runs that stand, for pictures of their blocks.
std::vector<ReportedRun> make_standing_runs(const std::vector<ReportedSpecimen>& specimens);

/// Output that musim scale, pi, design, record and others printed with --json: everything in it, as tables.
ReportSection make_document_section(const ReportedDocument& document, std::size_t number);
/// Distortion of the document's model in a sentence; that the document was read, if it has none.
std::string make_document_verdict(const ReportedDocument& document);
/// Any JSON as tables: an object's plain values under `caption`, lists of objects with a column per key, what is inside below under
/// captions of its own.
std::string to_html(const nlohmann::json& json, const std::string& caption);

}  // namespace musim::lsdem
