#include "lsdem/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lsdem/report/json_parts.hpp"
#include "lsdem/report/run_plots.hpp"

namespace musim::lsdem {
namespace {

/// Speeds of the runs in which any method found one; nothing where none did.
std::optional<ReportSection> make_speed_section(const std::vector<ReportedRun>& runs) {
    ReportSection section{.id = "speed", .title = "Structural speed"};
    HtmlTable table{.caption = "Speed of travel up the structure; S^N = speed over √(μ g l)",
                    .heads = {"run", "method", "speed [m/s]", "± [m/s]", "S^N", "levels"}};
    for (const ReportedRun& run : runs) {
        if (!run.response) continue;
        const double sliding = run.response->scales.sliding_speed();
        for (const SpeedEstimate& estimate : run.response->speeds) {
            if (!estimate.speed) continue;
            table.rows.push_back({{.text = run.label},
                                  {.text = estimate.method},
                                  number_cell(*estimate.speed),
                                  number_cell(estimate.speed_error, 2),
                                  number_cell(sliding > 0.0 ? *estimate.speed / sliding : std::nan("")),
                                  number_cell(static_cast<double>(estimate.height.size()))});
        }
    }
    if (table.rows.empty()) return std::nullopt;
    section.html = to_html(table);
    for (const ReportedRun& run : runs) {
        std::optional<ReportFigure> figure = make_lag_figure(run);
        if (!figure) continue;
        section.figures.push_back(std::move(*figure));
        break;
    }
    return section;
}

ReportSection make_energy_section(const std::vector<ReportedRun>& runs) {
    ReportSection section{.id = "energy", .title = "Energy"};
    HtmlTable table{.caption = "Energy at the end; gravitational energy from the start [J]",
                    .heads = {"run", "kinetic", "gravitational", "elastic", "friction", "dashpots", "work of the base", "closes to"}};
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

ReportSection make_overview_section(const ReportContent& content) {
    HtmlTable table{.caption = "Runs",
                    .heads = {"run", "scene", "material", "scale λ_l", "blocks", "simulated [s]", "steps", "step [s]", "wall time [s]",
                              "musim", "state hash"}};
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

std::vector<ReportFigure> make_spine_figures(const ReportContent& content) {
    std::vector<ReportFigure> figures;
    std::optional<ReportFigure> departure = make_departure_figure(content.runs, content.summary, content.title);
    if (!departure) departure = make_difference_figure(content.runs);
    for (std::optional<ReportFigure>& figure : std::array{make_spine_figure(content.runs, content.summary), std::move(departure)}) {
        if (figure) figures.push_back(std::move(*figure));
    }
    return figures;
}

std::vector<ReportSection> make_run_sections(const std::vector<ReportedRun>& runs) {
    ReportSection profiles{.id = "profiles", .title = "What it left, level by level", .figures = make_profile_figures(runs)};
    std::vector<ReportSection> sections{std::move(profiles)};
    if (std::optional<ReportSection> loads = make_load_section(runs)) sections.push_back(std::move(*loads));
    if (std::optional<ReportSection> speed = make_speed_section(runs)) sections.push_back(std::move(*speed));
    sections.push_back(make_energy_section(runs));
    if (std::optional<ReportSection> sensors = make_sensor_section(runs)) sections.push_back(std::move(*sensors));
    return sections;
}

}  // namespace musim::lsdem
