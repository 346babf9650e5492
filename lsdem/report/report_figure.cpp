#include "lsdem/report/report_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "records/formats/csv_cell.hpp"

namespace musim::lsdem {
namespace {

std::vector<HtmlCell> describe_series(const PlotSeries& series) {
    std::vector<std::size_t> finite;
    for (std::size_t i = 0; i < series.y.size(); ++i) {
        if (std::isfinite(series.x[i]) && std::isfinite(series.y[i])) finite.push_back(i);
    }
    if (finite.empty()) return {{.text = series.label}, {.text = "no point"}};
    const auto less = [&](std::size_t a, std::size_t b) { return series.y[a] < series.y[b]; };
    const std::size_t low = *std::min_element(finite.begin(), finite.end(), less),
                      high = *std::max_element(finite.begin(), finite.end(), less);
    const auto left_right =
        std::minmax_element(finite.begin(), finite.end(), [&](std::size_t a, std::size_t b) { return series.x[a] < series.x[b]; });
    const std::size_t left = *left_right.first, right = *left_right.second;
    return {{.text = series.label},      number_cell(static_cast<double>(finite.size()), 7),
            number_cell(series.x[left]), number_cell(series.x[right]),
            number_cell(series.y[low]),  number_cell(series.x[low]),
            number_cell(series.y[high]), number_cell(series.x[high])};
}

/// Largest magnitude, when that is, last value, and the widest half of a band; nothing for a curve without a finite point.
std::vector<HtmlCell> describe_curve(const PlotCurves& run, std::size_t row) {
    std::optional<std::size_t> peak, last;
    const std::vector<double>& y = run.y[row];
    double widest = std::nan("");
    for (std::size_t k = 0; k < y.size(); ++k) {
        if (!std::isfinite(y[k])) continue;
        last = k;
        if (!peak || std::abs(y[k]) > std::abs(y[*peak])) peak = k;
        if (!run.spread.empty()) widest = std::fmax(widest, run.spread[row][k]);
    }
    if (!peak) return {};
    std::vector<HtmlCell> cells{number_cell(y[*peak]), number_cell(run.x[*peak]), number_cell(y[*last])};
    if (!run.spread.empty()) cells.push_back(number_cell(widest));
    return cells;
}

/// Names of a picture's parts are its own: on one page many pictures have the same.
std::string name_apart(std::string svg, const std::string& name) {
    for (const std::string mark : {" id=\"", "url(#"}) {
        for (std::size_t at = svg.find(mark); at != std::string::npos; at = svg.find(mark, at + mark.size())) {
            svg.insert(at + mark.size(), name + "-");
        }
    }
    return svg;
}

/// Rows of a twin that stand in the picture's description; who listens to more reads the table.
constexpr std::size_t kMostGiven = 4;

std::string write_row(const HtmlTable& twin, std::size_t row) {
    std::string text = twin.rows[row].front().text;
    for (std::size_t cell = 1; cell < twin.rows[row].size(); ++cell) {
        text += fmt::format("{} {} {}", cell == 1 ? ":" : ",", twin.heads.at(cell), twin.rows[row][cell].text);
    }
    return text;
}

std::string name_row(const StackedPlot& plot, std::size_t row) { return row < plot.row_labels.size() ? plot.row_labels[row] : ""; }

}  // namespace

ReportFigure make_figure(const std::string& name, const LinePlot& plot) {
    ReportFigure figure{.name = name, .title = plot.title, .svg = make_svg(plot), .csv = "series,x,y\n"};
    figure.twin.caption = fmt::format("{}: {} over {}", plot.title, plot.y_label, plot.x_label);
    figure.twin.heads = {"series", "points", "first x", "last x", "smallest", "at x", "largest", "at x"};
    for (const PlotSeries& series : plot.series) {
        for (std::size_t i = 0; i < series.x.size(); ++i) {
            fmt::format_to(std::back_inserter(figure.csv), "{},{},{}\n", records::csv_cell(series.label), series.x[i], series.y[i]);
        }
        for (std::size_t i = 0; i < series.y_low.size(); ++i) {
            fmt::format_to(std::back_inserter(figure.csv), "{},{},{}\n", records::csv_cell(series.label + ", lower edge"), series.x[i],
                           series.y_low[i]);
        }
        figure.twin.rows.push_back(describe_series(series));
    }
    return figure;
}

ReportFigure make_figure(const std::string& name, const StackedPlot& plot) {
    ReportFigure figure{.name = name, .title = plot.title, .svg = make_svg(plot), .csv = "run,row,x,y,spread\n"};
    figure.twin.caption = fmt::format("{}: {} over {}", plot.title, plot.y_label, plot.x_label);
    figure.twin.heads = {"run", "row", "largest magnitude", "at", "last value"};
    const bool has_bands = std::any_of(plot.runs.begin(), plot.runs.end(), [](const PlotCurves& run) { return !run.spread.empty(); });
    if (has_bands) figure.twin.heads.emplace_back("widest half of the band");
    for (const PlotCurves& run : plot.runs) {
        for (std::size_t row = 0; row < run.y.size(); ++row) {
            const std::vector<double>& y = run.y[row];
            for (std::size_t k = 0; k < y.size(); ++k) {
                fmt::format_to(std::back_inserter(figure.csv), "{},{},{},{},{}\n", records::csv_cell(run.label),
                               records::csv_cell(name_row(plot, row)), run.x[k], y[k],
                               run.spread.empty() ? "" : fmt::format("{}", run.spread[row][k]));
            }
            const std::vector<HtmlCell> given = describe_curve(run, row);
            if (given.empty()) continue;
            std::vector<HtmlCell>& cells =
                figure.twin.rows.emplace_back(std::vector<HtmlCell>{{.text = run.label}, {.text = name_row(plot, row)}});
            cells.insert(cells.end(), given.begin(), given.end());
        }
    }
    return figure;
}

std::string describe(const ReportFigure& figure) {
    std::string text = figure.twin.caption;
    const std::size_t rows = figure.twin.rows.size(), given = std::min(rows, kMostGiven);
    for (std::size_t row = 0; row < given; ++row) text += (row == 0 ? ". " : "; ") + write_row(figure.twin, row);
    if (rows > given) text += fmt::format("; {} more rows under In numbers", rows - given);
    return text + ".";
}

std::string to_html(const ReportFigure& figure) {
    const std::string numbers = figure.twin.rows.empty() ? make_statement(Tone::plain, figure.twin.caption) : to_html(figure.twin);
    const std::string time = figure.seconds_per_x > 0.0 ? fmt::format(" data-seconds-per-x=\"{}\"", figure.seconds_per_x) : "";
    return fmt::format(
        "<figure id=\"figure-{}\" data-figure=\"{}\"{}>\n<div class=\"plot\" role=\"img\" "
        "aria-label=\"{}\">{}</div>\n<figcaption>{}</figcaption>\n"
        "<details><summary>In numbers</summary>\n{}</details>\n</figure>\n",
        figure.name, figure.name, time, escape_html(describe(figure)), name_apart(figure.svg, figure.name), escape_html(figure.title),
        numbers);
}

}  // namespace musim::lsdem
