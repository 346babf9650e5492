#include "lsdem/plot/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <stdexcept>

#include "lsdem/plot/svg.hpp"

namespace musim::lsdem {
namespace {

/// Sizes of the picture [px].
constexpr double kPlotLeft = 84.0;
constexpr double kPlotRight = 24.0;
constexpr double kPlotTop = 96.0;
constexpr double kPlotBottom = 56.0;
constexpr double kPlotWidth = 812.0;
constexpr double kRowSpacing = 52.0;
constexpr double kLabelGap = 9.0;      // from the names of rows to the axis
constexpr double kBesideYName = 30.0;  // left of them, for the name of the vertical axis
constexpr double kLegendDash = 44.0;

/// A curve is thinned to its least and greatest value in each of these bins: 2 px, finer than the widest line is thick.
constexpr std::size_t kBins = 400;

/// A curve in a band is this wide, so that the band shows beside it [px].
constexpr double kMeanWidth = 1.3;

using Axis = detail::PlotAxis;
using detail::draw_line;
using detail::draw_text;
using detail::kLineStyles;
using detail::round_down;
using detail::stroke;

/// Look of the curves of run `r`.
detail::LineStyle style_of(const StackedPlot& plot, std::size_t r) {
    const std::size_t number = plot.runs[r].style >= 0 ? static_cast<std::size_t>(plot.runs[r].style) : r;
    detail::LineStyle style = kLineStyles[number % kLineStyles.size()];
    if (!plot.runs[r].spread.empty()) style.width = kMeanWidth;
    return style;
}

void require_consistent(const StackedPlot& plot) {
    for (const PlotCurves& run : plot.runs) {
        if (run.y.size() != plot.row_labels.size()) {
            throw std::invalid_argument(
                fmt::format("plot: run '{}' has {} curves for {} rows", run.label, run.y.size(), plot.row_labels.size()));
        }
        if (!run.spread.empty() && run.spread.size() != run.y.size()) {
            throw std::invalid_argument(
                fmt::format("plot: run '{}' has {} bands for {} curves", run.label, run.spread.size(), run.y.size()));
        }
        for (const auto* curves : {&run.y, &run.spread}) {
            for (const std::vector<double>& curve : *curves) {
                if (curve.size() != run.x.size()) {
                    throw std::invalid_argument(
                        fmt::format("plot: run '{}' has {} values at {} abscissas", run.label, curve.size(), run.x.size()));
                }
            }
        }
    }
}

Axis make_x_axis(const StackedPlot& plot) {
    double first = 0.0;
    double last = 0.0;
    for (const PlotCurves& run : plot.runs) {
        if (run.x.empty()) continue;
        first = std::min(first, run.x.front());
        last = std::max(last, run.x.back());
    }
    if (!(last > first)) last = first + 1.0;
    return {first, last, kPlotLeft, kPlotLeft + kPlotWidth};
}

/// Largest finite absolute value of all curves and bands: the data a row spacing stands for. A diverged run must not flatten the others,
/// hence no more than a hundred times the first run's.
double find_row_scale(const StackedPlot& plot) {
    double scale = 0.0;
    double first_run = 0.0;
    for (const PlotCurves& run : plot.runs) {
        for (std::size_t row = 0; row < run.y.size(); ++row) {
            for (std::size_t i = 0; i < run.x.size(); ++i) {
                const double value = std::abs(run.y[row][i]), spread = run.spread.empty() ? 0.0 : run.spread[row][i];
                if (std::isfinite(value)) scale = std::max(scale, std::isfinite(spread) ? value + spread : value);
            }
        }
        if (&run == &plot.runs.front()) first_run = scale;
    }
    if (first_run > 0.0) scale = std::min(scale, 100.0 * first_run);
    return scale > 0.0 ? scale : 1.0;
}

/// Path of a curve: in each bin its first, least, greatest and last finite value, in order of time.
std::string make_path(const std::vector<double>& x, const std::vector<double>& y, const Axis& x_axis, const Axis& y_axis) {
    std::string path;
    double last_x = 0.0;
    double last_y = 0.0;
    const auto add = [&](std::size_t i) {
        // relative moves of rounded absolute positions: short, and rounding does not add up
        const double px = std::round(x_axis(x[i]) * 10.0) / 10.0;
        const double py = std::round(y_axis(y[i]) * 10.0) / 10.0;
        if (path.empty()) {
            path = fmt::format("M{:.1f} {:.1f}l", px, py);
        } else if (px != last_x || py != last_y) {
            fmt::format_to(std::back_inserter(path), "{:.4g} {:.4g} ", px - last_x, py - last_y);
        }
        last_x = px;
        last_y = py;
    };

    const std::size_t bin = std::max<std::size_t>(1, x.size() / kBins);
    for (std::size_t begin = 0; begin < x.size(); begin += bin) {
        const std::size_t end = std::min(begin + bin, x.size());
        std::size_t low = end;
        std::size_t high = end;
        for (std::size_t i = begin; i < end; ++i) {
            if (!std::isfinite(y[i])) continue;
            if (low == end || y[i] < y[low]) low = i;
            if (high == end || y[i] > y[high]) high = i;
        }
        if (low == end) continue;
        add(std::min(low, high));
        if (low != high) add(std::max(low, high));
    }
    return path;
}

/// Outlines of a band y ± spread: in each bin its greatest value forward, its least backward; a bin without any parts the outline.
std::string make_band_path(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& spread,
                           const Axis& x_axis, const Axis& y_axis) {
    std::string path, upper, lower;
    const auto close = [&] {
        if (!upper.empty()) path += "M" + upper + lower + "Z";
        upper.clear();
        lower.clear();
    };
    const std::size_t bin = std::max<std::size_t>(1, x.size() / kBins);
    for (std::size_t begin = 0; begin < x.size(); begin += bin) {
        const std::size_t end = std::min(begin + bin, x.size());
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (std::size_t i = begin; i < end; ++i) {
            if (!std::isfinite(y[i]) || !std::isfinite(spread[i])) continue;
            low = std::min(low, y[i] - spread[i]);
            high = std::max(high, y[i] + spread[i]);
        }
        if (high < low) {
            close();
            continue;
        }
        const double px = x_axis(x[begin]);
        fmt::format_to(std::back_inserter(upper), "{:.1f} {:.1f} ", px, y_axis(high));
        lower.insert(0, fmt::format("{:.1f} {:.1f} ", px, y_axis(low)));
    }
    close();
    return path;
}

void draw_x_ticks(std::string& svg, const Axis& x_axis, double bottom) {
    const double spacing = round_down((x_axis.data_max - x_axis.data_min) / 5.0);
    for (double i = std::ceil(x_axis.data_min / spacing); i * spacing <= x_axis.data_max; ++i) {
        const double x = x_axis(i * spacing);
        draw_line(svg, x, kPlotTop, x, bottom, "stroke=\"#e4e4e4\"");
        draw_line(svg, x, bottom, x, bottom + 5.0, "stroke=\"#333\"");
        draw_text(svg, x, bottom + 19.0, "middle", "class=\"small\"", fmt::format("{:.4g}", i * spacing));
    }
}

void draw_legend(std::string& svg, const StackedPlot& plot) {
    double x = kPlotLeft;
    for (std::size_t r = 0; r < plot.runs.size(); ++r) {
        const std::string style = stroke(style_of(plot, r));
        draw_line(svg, x, 70.0, x + kLegendDash, 70.0, style.c_str());
        draw_text(svg, x + kLegendDash + 7.0, 74.0, "start", "", plot.runs[r].label);
        // 7.2 px is the mean width of a letter at this size
        x += kLegendDash + 34.0 + 7.2 * static_cast<double>(plot.runs[r].label.size());
    }
}

/// The unit that a label ends with, as in "v [cm/s]"; empty without one.
std::string find_unit(const std::string& label) {
    const std::size_t open = label.find('['), close = label.find(']', open);
    return close == std::string::npos ? "" : " " + label.substr(open + 1, close - open - 1);
}

/// A bar as long as a round value, at the right end of the frame's top.
void draw_scale_bar(std::string& svg, double row_scale, const std::string& unit) {
    const double value = round_down(row_scale);
    const double length = value / row_scale * kRowSpacing;
    const double x = kPlotLeft + kPlotWidth - 8.0;
    draw_line(svg, x, kPlotTop - 8.0 - length, x, kPlotTop - 8.0, "stroke=\"#333\" stroke-width=\"2\"");
    draw_text(svg, x - 8.0, kPlotTop - 10.0, "end", "class=\"small\"", fmt::format("bar: {:.3g}{}", value, unit));
}

void draw_mark(std::string& svg, const PlotMark& mark, const Axis& x_axis, double bottom) {
    const double x = x_axis(mark.x);
    draw_line(svg, x, kPlotTop, x, bottom, stroke(detail::kMarkLine).c_str());
    draw_text(svg, x + 5.0, kPlotTop + 14.0, "start", "class=\"small\"", mark.label);
}

}  // namespace

std::string make_svg(const StackedPlot& plot) {
    require_consistent(plot);
    const auto rows = static_cast<double>(plot.row_labels.size());
    const double width = kPlotLeft + kPlotWidth + kPlotRight;
    const double bottom = kPlotTop + (rows + 1.0) * kRowSpacing;
    const double height = bottom + kPlotBottom;
    const Axis x_axis = make_x_axis(plot);
    const double row_scale = find_row_scale(plot);

    // names of rows that would reach into that of the axis push all to the right
    double widest = 0.0;
    for (const std::string& label : plot.row_labels) widest = std::max(widest, detail::find_text_width(label, detail::kSmallFont));
    const double pushed = std::ceil(std::max(0.0, widest - (kPlotLeft - kLabelGap - kBesideYName)));

    std::string svg = detail::open_svg(width + pushed, height, fmt::format("{}: {} over {}", plot.title, plot.y_label, plot.x_label));
    if (pushed > 0.0) svg += fmt::format("<g transform=\"translate({:.0f} 0)\">\n", pushed);
    svg += fmt::format("<clipPath id=\"frame\"><rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/></clipPath>\n",
                       kPlotLeft, kPlotTop, kPlotWidth, bottom - kPlotTop);

    // axes: frame, ticks, labels, legend
    draw_text(svg, kPlotLeft, 26.0, "start", "class=\"title\"", plot.title);
    draw_text(svg, kPlotLeft, 46.0, "start", "class=\"small\"", detail::shorten(plot.subtitle, detail::kSmallFont, kPlotWidth));
    draw_legend(svg, plot);
    draw_x_ticks(svg, x_axis, bottom);
    detail::draw_frame(svg, kPlotLeft, kPlotTop, kPlotWidth, bottom - kPlotTop, {x_axis.data_min, x_axis.data_max, false, plot.x_label},
                       std::nullopt);
    draw_scale_bar(svg, row_scale, find_unit(plot.y_label));
    draw_text(svg, kPlotLeft + 0.5 * kPlotWidth, height - 14.0, "middle", "", plot.x_label);
    detail::draw_upward_text(svg, 20.0 - pushed, 0.5 * (kPlotTop + bottom), plot.y_label);

    if (plot.mark) draw_mark(svg, *plot.mark, x_axis, bottom);

    // one row per level, every run on top of the one before
    svg += "<g clip-path=\"url(#frame)\">\n";
    for (std::size_t row = 0; row < plot.row_labels.size(); ++row) {
        const double zero = bottom - (static_cast<double>(row) + 1.0) * kRowSpacing;
        const Axis y_axis{0.0, row_scale, zero, zero - kRowSpacing};
        draw_line(svg, kPlotLeft, zero, kPlotLeft + kPlotWidth, zero, "stroke=\"#d0d0d0\"");
        for (std::size_t r = 0; r < plot.runs.size(); ++r) {
            if (!plot.runs[r].spread.empty()) {
                const std::string band = make_band_path(plot.runs[r].x, plot.runs[r].y[row], plot.runs[r].spread[row], x_axis, y_axis);
                svg += fmt::format("<path class=\"band\" d=\"{}\" fill=\"{}\" fill-opacity=\"{}\"/>\n", band, style_of(plot, r).color,
                                   detail::kBandOpacity);
            }
            const std::string path = make_path(plot.runs[r].x, plot.runs[r].y[row], x_axis, y_axis);
            svg += fmt::format("<path d=\"{}\" {}/>\n", path, stroke(style_of(plot, r)));
        }
    }
    svg += "</g>\n";
    for (std::size_t row = 0; row < plot.row_labels.size(); ++row) {
        const double zero = bottom - (static_cast<double>(row) + 1.0) * kRowSpacing;
        draw_line(svg, kPlotLeft - 5.0, zero, kPlotLeft, zero, "stroke=\"#333\"");
        draw_text(svg, kPlotLeft - kLabelGap, zero + 4.0, "end", "class=\"small\"", plot.row_labels[row]);
    }
    svg += pushed > 0.0 ? "</g>\n</svg>\n" : "</svg>\n";
    return svg;
}

}  // namespace musim::lsdem
