#include "lsdem/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lsdem/report/run_plots.hpp"
#include "scaling/angle.hpp"

namespace musim::lsdem {
namespace {

/// Bins of the distribution of forces, from 0 to the largest.
constexpr int kBins = 40;

ReportFigure make_force_figure(const std::vector<ReportedSpecimen>& specimens) {
    LinePlot plot{.title = "Forces between blocks of two layers",
                  .subtitle = "share of the contacts that bear more",
                  .x_label = "vertical force over the weight of a block",
                  .y_label = "contacts [%]",
                  .y_from_zero = true};
    for (const ReportedSpecimen& reported : specimens) {
        std::vector<double> force = reported.specimen.force;
        if (force.empty()) continue;
        std::sort(force.begin(), force.end());
        PlotSeries series{.label = reported.label};
        for (int k = 0; k <= kBins; ++k) {
            const double level = force.back() * k / kBins;
            const auto above = force.end() - std::upper_bound(force.begin(), force.end(), level);
            series.x.push_back(level);
            series.y.push_back(100.0 * static_cast<double>(above) / static_cast<double>(force.size()));
        }
        plot.series.push_back(std::move(series));
    }
    return make_figure("contact_forces", plot);
}

}  // namespace

ReportSection make_specimen_section(const ReportContent& content) {
    ReportSection section{.id = "specimens", .title = "Specimens"};
    HtmlTable table{.caption = "Prepared structures",
                    .heads = {"file", "blocks", "layers", "mean tilt [°]", "largest tilt [°]", "contacts", "mean force over weight",
                              "largest", "musim"}};
    for (const ReportedSpecimen& reported : content.specimens) {
        const StoredSpecimen& specimen = reported.specimen;
        const auto mean = [](const std::vector<double>& values) {
            double sum = 0.0;
            for (const double value : values) sum += value;
            return values.empty() ? std::nan("") : sum / static_cast<double>(values.size());
        };
        const auto most = [](const std::vector<double>& values) {
            return values.empty() ? std::nan("") : *std::max_element(values.begin(), values.end());
        };
        table.rows.push_back({{.text = reported.label},
                              number_cell(static_cast<double>(specimen.layer.size()), 9),
                              number_cell(specimen.layer.empty() ? 0.0 : *std::max_element(specimen.layer.begin(), specimen.layer.end())),
                              number_cell(mean(specimen.tilt) / scaling::kDegree),
                              number_cell(most(specimen.tilt) / scaling::kDegree),
                              number_cell(static_cast<double>(specimen.force.size()), 9),
                              number_cell(mean(specimen.force)),
                              number_cell(most(specimen.force)),
                              {.text = specimen.program_version}});
    }
    section.html = to_html(table);
    for (const ReportedSpecimen& reported : content.specimens) {
        section.figures.push_back(make_tilt_figure(fmt::format("tilt_{}", section.figures.size() + 1), reported.label,
                                                   reported.specimen.layer, reported.specimen.tilt));
    }
    section.figures.push_back(make_force_figure(content.specimens));
    return section;
}

std::vector<ReportedRun> make_standing_runs(const std::vector<ReportedSpecimen>& specimens) {
    std::vector<ReportedRun> runs;
    for (const ReportedSpecimen& reported : specimens) {
        ReportedRun& standing = runs.emplace_back();
        standing.label = reported.label;
        standing.stands = true;
        standing.run.blocks.size = reported.specimen.size;
        standing.run.blocks.shapes = reported.specimen.shapes;
        standing.run.blocks.layer = reported.specimen.layer;
        standing.run.initial = standing.run.final = reported.specimen.places;
        standing.run.history.time = {0.0};
        standing.run.history.base = {BaseState{}};
    }
    return runs;
}

}  // namespace musim::lsdem
