#include <fmt/format.h>

#include <string>

#include "lsdem/report/report.hpp"
#include "lsdem/results/load_measures.hpp"

namespace musim::lsdem {
namespace {

/// Force of one load over the displacement of its point, of all runs that have it, scaled back to the first one's prototype.
ReportFigure make_load_figure(const std::vector<ReportedRun>& runs, std::size_t load) {
    LinePlot plot{.title = "Force over displacement: " + runs.front().run.loads[load],
                  .subtitle = runs.size() == 1 ? runs.front().label : fmt::format("{} runs, scaled back to the prototype", runs.size()),
                  .x_label = "displacement [mm]",
                  .y_label = "force [N]",
                  .y_from_zero = true,
                  .of_runs = true};
    for (std::size_t r = 0; r < runs.size(); ++r) {
        const RunData& run = runs[r].run;
        if (load >= run.loads.size()) continue;
        PlotSeries series{.label = runs[r].label, .style = static_cast<int>(r)};
        for (std::size_t k = load; k < run.history.load.size(); k += run.loads.size()) {
            series.x.push_back(1e3 * run.history.load[k].displacement / run.similitude.length());
            series.y.push_back(run.history.load[k].force / run.similitude.force());
        }
        plot.series.push_back(std::move(series));
    }
    return make_figure(fmt::format("load_{}", load), plot);
}

}  // namespace

std::optional<ReportSection> make_load_section(const std::vector<ReportedRun>& runs) {
    if (runs.front().run.loads.empty()) return std::nullopt;
    ReportSection section{.id = "loads", .title = "Loads"};
    HtmlTable table{.caption = "Largest force of each load, along its direction, and how far its point had moved by then",
                    .heads = {"run", "load", "largest force [N]", "displacement [mm]", "at [s]"}};
    for (const ReportedRun& run : runs) {
        const std::vector<LargestLoad> largest = find_largest_loads(run.run);
        for (std::size_t l = 0; l < largest.size(); ++l) {
            table.rows.push_back({{.text = run.label},
                                  {.text = run.run.loads[l]},
                                  number_cell(largest[l].force),
                                  number_cell(1e3 * largest[l].displacement),
                                  number_cell(largest[l].time)});
        }
    }
    section.html = to_html(table);
    for (std::size_t l = 0; l < runs.front().run.loads.size(); ++l) section.figures.push_back(make_load_figure(runs, l));
    return section;
}

}  // namespace musim::lsdem
