#include "lsdem/report/run_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "lsdem/report/document_sections.hpp"
#include "lsdem/report/json_parts.hpp"
#include "lsdem/report/run_plots.hpp"
#include "lsdem/results/fallen_blocks.hpp"
#include "scaling/angle.hpp"

namespace musim::lsdem {
namespace {

/// Energy that appears from nowhere beyond this share of what is in play is doubtful; runs call themselves so from a tenth on.
constexpr double kGoodClosure = 0.01;

std::string describe_status(const ReportedRun& run) {
    if (run.run.status == RunStatus::diverged) return "diverged: " + run.run.divergence;
    if (!run.run.is_status_known) return "how it ended is not known";
    if (run.run.collapse_time) return fmt::format("collapsed at {:.4g} s", *run.run.collapse_time);
    return "ran to its end";
}

Tone find_tone(RunStatus status) {
    switch (status) {
        case RunStatus::completed:
            return Tone::good;
        case RunStatus::collapsed:
            return Tone::warning;
        case RunStatus::diverged:
            return Tone::bad;
    }
    return Tone::plain;
}

std::string make_run_verdict(const ReportedRun& run) {
    std::string text = run.label + ": " + describe_status(run);
    if (run.response) {
        const Damage& damage = run.response->damage;
        text += fmt::format("; {} of {} blocks fallen, damage index {:.3g}", damage.fallen, damage.blocks, damage.index);
        if (run.response->failure) text += "; " + describe(*run.response->failure);
    }
    std::string html = make_statement(run.run.is_status_known ? find_tone(run.run.status) : Tone::note, text);
    const double closure = find_number(run.summary, "energy_closure");
    if (std::isfinite(closure)) {
        html += make_statement(closure < kGoodClosure ? Tone::good : Tone::warning,
                               fmt::format("{}: energy balance closes to {:.2g} of the energy in play", run.label, closure));
    }
    for (const std::string& doubt : run.run.doubts) html += make_statement(Tone::warning, run.label + ": " + doubt);
    return html;
}

std::string make_pair_verdict(const nlohmann::json& pair) {
    const std::string agreement = find_text(pair, "agreement");
    Tone tone = agreement == "agree" ? Tone::good : agreement == "differ" ? Tone::bad : Tone::warning;
    std::string html;
    for (const nlohmann::json& line : find_list(pair, "verdict")) {
        if (!line.is_string()) continue;
        html += make_statement(tone, line.get<std::string>());
        tone = Tone::note;
    }
    for (const nlohmann::json& model : find_list(pair, "pairs")) {
        const std::string label = find_text(model, "label", "model");
        if (find_flag(model, "bitwise_identical")) {
            html += make_statement(Tone::good, label + ": the same as the prototype, bit for bit");
        } else if (find_text(model, "materials") == "own") {
            html += make_statement(Tone::warning,
                                   fmt::format("{}: made of its own material and distorted; velocities of the spine differ by {:.3g} (rms)",
                                               label, find_number(model, "rms_relative_velocity_difference")));
        }
    }
    return html;
}

/// How many of the members ended how.
std::string make_ensemble_verdict(const ReportedEnsemble& ensemble) {
    std::map<std::string, int> count;
    int members = 0;
    for (const nlohmann::json& member : find_list(ensemble.summary, "members")) {
        ++count[find_text(member, "status", "failed")];
        ++members;
    }
    std::string text = fmt::format("{}: {} members", ensemble.label, members);
    for (const auto& [status, number] : count) text += fmt::format(", {} {}", number, status);
    const bool all_completed = count["completed"] == members && members > 0;
    const bool all_ended = count["completed"] + count["collapsed"] == members && members > 0;
    return make_statement(all_completed ? Tone::good : all_ended ? Tone::warning : Tone::bad, text);
}

std::string make_specimen_verdict(const ReportedSpecimen& reported) {
    const StoredSpecimen& specimen = reported.specimen;
    const double largest = specimen.tilt.empty() ? 0.0 : *std::max_element(specimen.tilt.begin(), specimen.tilt.end());
    const std::size_t fallen = count_fallen(specimen.size, specimen.layer, specimen.places);
    const std::string what = fmt::format("{}: {} blocks prepared, at rest", reported.label, specimen.layer.size());
    if (fallen > 0) return make_statement(Tone::warning, fmt::format("{}, but {} of them fell from their layers", what, fallen));
    return make_statement(Tone::good, fmt::format("{}; the largest tilt is {:.3g}°", what, largest / scaling::kDegree));
}

ReportSection make_spine_section(const ReportContent& content) {
    ReportSection section{.id = "spine", .title = "Motion of the spine", .html = {}};
    std::optional<ReportFigure> departure = make_departure_figure(content.summary, content.title);
    if (!departure) departure = make_difference_figure(content.runs);
    for (std::optional<ReportFigure>& figure : std::array{make_spine_figure(content.runs, content.summary), std::move(departure)}) {
        if (figure) section.figures.push_back(std::move(*figure));
    }
    return section;
}

ReportSection make_speed_section(const std::vector<ReportedRun>& runs) {
    ReportSection section{.id = "speed", .title = "Structural speed", .html = {}};
    HtmlTable table{.caption = "Speed of travel up the structure; S^N = speed over √(μ g l)",
                    .heads = {"run", "method", "speed [m/s]", "± [m/s]", "S^N", "levels"},
                    .rows = {}};
    for (const ReportedRun& run : runs) {
        if (!run.response) continue;
        const double sliding = run.response->scales.sliding_speed();
        for (const SpeedEstimate& estimate : run.response->speeds) {
            if (!estimate.speed) {
                table.rows.push_back({{.text = run.label}, {.text = estimate.method}, {.text = "none: " + estimate.why}});
                continue;
            }
            table.rows.push_back({{.text = run.label},
                                  {.text = estimate.method},
                                  number_cell(*estimate.speed),
                                  number_cell(estimate.speed_error, 2),
                                  number_cell(sliding > 0.0 ? *estimate.speed / sliding : std::nan("")),
                                  number_cell(static_cast<double>(estimate.height.size()))});
        }
    }
    if (!table.rows.empty()) section.html = to_html(table);
    if (std::optional<ReportFigure> figure = make_lag_figure(runs.front())) section.figures.push_back(std::move(*figure));
    return section;
}

ReportSection make_energy_section(const std::vector<ReportedRun>& runs) {
    ReportSection section{.id = "energy", .title = "Energy", .html = {}};
    HtmlTable table{.caption = "Energy at the end; gravitational energy from the start [J]",
                    .heads = {"run", "kinetic", "gravitational", "elastic", "friction", "dashpots", "work of the base", "closes to"},
                    .rows = {}};
    for (const ReportedRun& run : runs) {
        const std::vector<Energy>& energy = run.run.history.energy;
        if (energy.empty()) continue;
        const Energy& last = energy.back();
        table.rows.push_back({{.text = run.label},
                              number_cell(last.kinetic),
                              number_cell(last.gravitational - energy.front().gravitational),
                              number_cell(last.elastic_normal + last.elastic_shear),
                              number_cell(last.friction_loss),
                              number_cell(last.damping_loss),
                              number_cell(last.base_work),
                              number_cell(compute_energy_closure(energy), 2)});
    }
    section.html =
        to_html(table) +
        "<p class=\"small\">Kinetic energy is centred in time, ½ m v(t − Δt/2)·v(t + Δt/2), as the energy balance of the scheme asks: "
        "where blocks turn back it can be slightly negative.</p>\n";
    if (!runs.front().run.history.energy.empty()) section.figures.push_back(make_energy_figure(runs.front()));
    if (std::optional<ReportFigure> figure = make_loss_figure(runs)) section.figures.push_back(std::move(*figure));
    return section;
}

}  // namespace

ReportSection make_verdict_section(const ReportContent& content) {
    ReportSection section{.id = "verdict", .title = "Verdict", .html = {}};
    if (content.kind == ReportKind::pair) section.html += make_pair_verdict(content.summary);
    for (const ReportedEnsemble& ensemble : content.ensembles) section.html += make_ensemble_verdict(ensemble);
    for (const ReportedRun& run : content.runs) section.html += make_run_verdict(run);
    for (const ReportedSpecimen& specimen : content.specimens) section.html += make_specimen_verdict(specimen);
    for (const ReportedRecord& record : content.records) {
        section.html += make_statement(Tone::good, fmt::format("{}: read as {}, {} components ({})", record.label, record.motion.format,
                                                               record.motion.components.size(), record.motion.component_names()));
    }
    for (const ReportedDocument& document : content.documents) section.html += make_document_verdict(document);
    for (const std::string& remark : content.remarks) section.html += make_statement(Tone::note, remark);
    return section;
}

ReportSection make_overview_section(const ReportContent& content) {
    HtmlTable table{.caption = "Runs",
                    .heads = {"run", "scene", "material", "scale λ_l", "blocks", "simulated [s]", "steps", "step [s]", "wall time [s]",
                              "musim", "state hash"},
                    .rows = {}};
    for (const ReportedRun& run : content.runs) {
        const auto number = [&](const char* key, int digits) { return number_cell(find_number(run.summary, key), digits); };
        table.rows.push_back(
            {{.text = run.label},
             {.text = run.scene_name},
             {.text = run.material},
             {.text = run.run.similitude.length() == 1.0 ? "1" : fmt::format("1:{:.4g}", 1.0 / run.run.similitude.length()),
              .is_number = true},
             number("blocks", 9),
             number("duration_s", 5),
             number("steps", 12),
             number("dt_s", 4),
             number("wall_s", 4),
             {.text = find_text(run.summary, "program_version", "-")},
             {.text = run.run.state_hash}});
    }
    return {.id = "runs", .title = "What was run", .html = to_html(table)};
}

std::vector<ReportSection> make_run_sections(const ReportContent& content) {
    const std::vector<ReportedRun>& runs = content.runs;
    ReportSection profiles{.id = "profiles", .title = "What it left, level by level", .html = {}, .figures = make_profile_figures(runs)};
    return {make_spine_section(content), make_speed_section(runs), std::move(profiles), make_energy_section(runs)};
}

}  // namespace musim::lsdem
