#include "lsdem/study/line_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <vector>

#include "lsdem/study/detail/svg.hpp"

namespace musim::lsdem::study {
namespace {

using detail::draw_line;
using detail::draw_text;
using detail::PlotAxis;

/// Sizes of the picture [px].
constexpr double kLeft = 84.0, kTop = 66.0, kBottom = 56.0;
constexpr double kWidth = 620.0, kHeight = 420.0, kLegendWidth = 230.0, kLegendLine = 19.0;

/// A colour per series, one dash after all colours: lines as thick as each other, unlike those of runs drawn on top of each other.
detail::LineStyle find_style(std::size_t index) {
    static constexpr std::array<const char*, 6> kColors{"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#000000"};
    static constexpr std::array<const char*, 3> kDashes{"", "7 4", "2 3"};
    return {kColors[index % kColors.size()], 1.6, kDashes[index / kColors.size() % kDashes.size()]};
}

/// Least and greatest finite value, or of its decimal logarithm.
struct Range {
    bool logarithmic = false;
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    void add(double value) {
        if (logarithmic) value = std::log10(value);
        if (!std::isfinite(value)) return;
        low = std::min(low, value);
        high = std::max(high, value);
    }

    /// With a margin, and never empty.
    void widen(double margin) {
        if (!(low <= high)) low = 0.0, high = 1.0;
        double extra = margin * (high - low);
        if (!(high > low)) extra = low != 0.0 ? 0.5 * std::abs(low) : 0.5;
        low -= extra;
        high += extra;
    }
};

/// An axis with even steps of the value or of its decimal logarithm, which stands in `linear` then.
struct Axis {
    PlotAxis linear;
    bool logarithmic = false;

    /// Place [px]; not finite for what a logarithmic axis cannot show.
    double operator()(double value) const { return linear(logarithmic ? std::log10(value) : value); }
    double first() const { return logarithmic ? std::pow(10.0, linear.data_min) : linear.data_min; }
    double last() const { return logarithmic ? std::pow(10.0, linear.data_max) : linear.data_max; }
};

/// Round values in even steps.
std::vector<double> find_even_ticks(double first, double last) {
    const double spacing = detail::round_down((last - first) / 4.0);
    std::vector<double> ticks;
    for (double i = std::ceil(first / spacing); i * spacing <= last; ++i) ticks.push_back(i * spacing + 0.0);
    return ticks;
}

/// Powers of ten, with their double and fivefold when there are few.
std::vector<double> find_decade_ticks(double first, double last) {
    constexpr double kFew = 3.0;
    const double low = std::floor(std::log10(first)), high = std::log10(last);
    const bool few = high - std::log10(first) < kFew;
    std::vector<double> ticks;
    for (double decade = low; decade <= high; ++decade) {
        for (const double leading : {1.0, 2.0, 5.0}) {
            const double tick = leading * std::pow(10.0, decade);
            if ((few || leading == 1.0) && first <= tick && tick <= last) ticks.push_back(tick);
        }
    }
    return ticks;
}

/// Calls `draw` with the place [px] and the text of every tick.
template <class Draw>
void for_ticks(const Axis& axis, const Draw& draw) {
    // less than a decade: even steps are rounder
    const bool decades = axis.logarithmic && axis.last() >= 10.0 * axis.first();
    const std::vector<double> ticks = decades ? find_decade_ticks(axis.first(), axis.last()) : find_even_ticks(axis.first(), axis.last());
    for (const double tick : ticks) draw(axis(tick), fmt::format("{:.5g}", tick));
}

void draw_axes(std::string& svg, const LinePlot& plot, const Axis& x_axis, const Axis& y_axis) {
    const double bottom = kTop + kHeight, right = kLeft + kWidth;
    draw_text(svg, kLeft, 26.0, "start", "class=\"title\"", plot.title);
    draw_text(svg, kLeft, 46.0, "start", "class=\"small\"", plot.subtitle);
    for_ticks(x_axis, [&](double x, const std::string& text) {
        draw_line(svg, x, kTop, x, bottom, "stroke=\"#e4e4e4\"");
        draw_text(svg, x, bottom + 18.0, "middle", "class=\"small\"", text);
    });
    for_ticks(y_axis, [&](double y, const std::string& text) {
        draw_line(svg, kLeft, y, right, y, "stroke=\"#e4e4e4\"");
        draw_text(svg, kLeft - 7.0, y + 4.0, "end", "class=\"small\"", text);
    });
    svg +=
        fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#333\"/>\n", kLeft, kTop, kWidth, kHeight);
    draw_text(svg, kLeft + 0.5 * kWidth, bottom + 42.0, "middle", "", plot.x_label);
    detail::draw_upward_text(svg, 20.0, kTop + 0.5 * kHeight, plot.y_label);
}

void draw_series(std::string& svg, const PlotSeries& series, const detail::LineStyle& style, const Axis& x_axis, const Axis& y_axis) {
    std::string path, dots;
    for (std::size_t i = 0; i < series.x.size(); ++i) {
        const double x = x_axis(series.x[i]), y = y_axis(series.y[i]);
        if (!std::isfinite(x) || !std::isfinite(y)) continue;
        fmt::format_to(std::back_inserter(path), "{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x, y);
        if (series.marks) fmt::format_to(std::back_inserter(dots), "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.6\"/>", x, y);
        if (i < series.y_error.size()) {
            const double low = y_axis(series.y[i] - series.y_error[i]), high = y_axis(series.y[i] + series.y_error[i]);
            const std::string bar = fmt::format("stroke=\"{}\" stroke-width=\"1\"", style.color);
            if (std::isfinite(low)) draw_line(svg, x, low, x, high, bar.c_str());
        }
    }
    if (series.line && !path.empty()) svg += fmt::format("<path d=\"{}\" {}/>\n", path, detail::stroke(style));
    if (!dots.empty()) svg += fmt::format("<g fill=\"{}\">{}</g>\n", style.color, dots);
}

}  // namespace

std::string make_svg(const LinePlot& plot) {
    // the ranges of all series
    Range x_range{.logarithmic = plot.x_logarithmic}, y_range{.logarithmic = plot.y_logarithmic};
    for (const PlotSeries& series : plot.series) {
        if (series.x.size() != series.y.size()) {
            throw std::invalid_argument(
                fmt::format("plot: series '{}' has {} abscissas for {} values", series.label, series.x.size(), series.y.size()));
        }
        for (const double x : series.x) x_range.add(x);
        for (std::size_t i = 0; i < series.y.size(); ++i) {
            const double error = i < series.y_error.size() ? series.y_error[i] : 0.0;
            y_range.add(series.y[i] - error);
            y_range.add(series.y[i] + error);
        }
    }
    if (plot.y_from_zero) y_range.add(0.0);
    x_range.widen(0.02);
    y_range.widen(0.05);
    const Axis x_axis{{x_range.low, x_range.high, kLeft, kLeft + kWidth}, plot.x_logarithmic};
    const Axis y_axis{{y_range.low, y_range.high, kTop + kHeight, kTop}, plot.y_logarithmic};

    std::string svg = detail::open_svg(kLeft + kWidth + kLegendWidth, kTop + kHeight + kBottom);
    draw_axes(svg, plot, x_axis, y_axis);
    double legend = kTop + 12.0;
    std::size_t next = 0;
    for (const PlotSeries& series : plot.series) {
        const detail::LineStyle style = find_style(series.style >= 0 ? static_cast<std::size_t>(series.style) : next++);
        draw_series(svg, series, style, x_axis, y_axis);
        if (series.label.empty()) continue;
        const double x = kLeft + kWidth + 14.0;
        if (series.line) draw_line(svg, x, legend, x + 26.0, legend, detail::stroke(style).c_str());
        if (series.marks)
            svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.6\" fill=\"{}\"/>\n", x + 13.0, legend, style.color);
        draw_text(svg, x + 33.0, legend + 4.0, "start", "class=\"small\"", series.label);
        legend += kLegendLine;
    }
    svg += "</svg>\n";
    return svg;
}

}  // namespace musim::lsdem::study
