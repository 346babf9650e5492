#include "lsdem/plot/plot_panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string_view>

namespace musim::lsdem::detail {
namespace {

/// Room a tick's text takes along its axis [px]; closer ones would touch.
constexpr double kTickWidth = 32.0, kTickHeight = 22.0;

/// An axis with even steps of the value or of its decimal logarithm, which stands in `linear` then.
struct Axis {
    PlotAxis linear;
    bool logarithmic = false;
    double tick_room = kTickWidth;

    /// Place [px]; not finite for what a logarithmic axis cannot show.
    double operator()(double value) const { return linear(logarithmic ? std::log10(value) : value); }
    double first() const { return logarithmic ? std::pow(10.0, linear.data_min) : linear.data_min; }
    double last() const { return logarithmic ? std::pow(10.0, linear.data_max) : linear.data_max; }
    double length() const { return std::abs(linear.pixel_max - linear.pixel_min); }
};

/// Round values in even steps, four to ten when there is room for them.
std::vector<double> find_even_ticks(const Axis& axis) {
    const double first = axis.first(), last = axis.last();
    const double fewest = std::clamp(std::floor(axis.length() / (1.5 * axis.tick_room)), 1.0, 4.0);
    const double spacing = round_down((last - first) / fewest);
    std::vector<double> ticks;
    for (double i = std::ceil(first / spacing); i * spacing <= last; ++i) ticks.push_back(i * spacing + 0.0);
    return ticks;
}

/// Powers of ten, with their double and fivefold when there are few and room for them.
std::vector<double> find_decade_ticks(const Axis& axis) {
    constexpr double kFew = 3.0;
    const double first = axis.first(), last = axis.last();
    const double low = std::floor(std::log10(first)), high = std::log10(last), decades = high - std::log10(first);
    const bool few = decades < kFew && 3.0 * decades * axis.tick_room < axis.length();
    std::vector<double> ticks;
    for (double decade = low; decade <= high; ++decade) {
        for (const double leading : {1.0, 2.0, 5.0}) {
            const double tick = leading * std::pow(10.0, decade);
            if ((few || leading == 1.0) && first <= tick && tick <= last) ticks.push_back(tick);
        }
    }
    return ticks;
}

/// A tick's value; powers of ten too small or large to be written out stand as 10⁻⁵.
std::string write_tick(double value) {
    static constexpr std::array<std::string_view, 10> kRaised{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string plain = fmt::format("{:.5g}", value);
    if (!plain.starts_with("1e")) return plain;
    std::string text = plain[2] == '-' ? "10⁻" : "10";
    for (const char digit : std::to_string(std::abs(std::stoi(plain.substr(2))))) text += kRaised[static_cast<std::size_t>(digit - '0')];
    return text;
}

/// Calls `draw` with the place [px] and the text of every tick.
template <class Draw>
void for_ticks(const Axis& axis, const Draw& draw) {
    // less than a decade: even steps are rounder
    const bool decades = axis.logarithmic && axis.last() >= 10.0 * axis.first();
    for (const double tick : decades ? find_decade_ticks(axis) : find_even_ticks(axis)) draw(axis(tick), write_tick(tick));
}

/// `axis` in units of which `factor` are one of its own.
Axis multiply(Axis axis, double factor) {
    for (double* end : {&axis.linear.data_min, &axis.linear.data_max}) *end = axis.logarithmic ? *end + std::log10(factor) : *end * factor;
    return axis;
}

void draw_second_axis(std::string& svg, const SecondAxis& second, const Axis& x_axis, const PanelFrame& frame) {
    for_ticks(multiply(x_axis, second.factor), [&](double x, const std::string& text) {
        draw_line(svg, x, frame.top - 4.0, x, frame.top, "stroke=\"#333\"");
        draw_text(svg, x, frame.top - 8.0, "middle", "class=\"small\"", text);
    });
    draw_text(svg, frame.left + 0.5 * frame.width, frame.top - 24.0, "middle", "class=\"small\"", second.label);
}

void draw_axes(std::string& svg, const LinePlot& plot, const PanelPlace& place, const Axis& x_axis, const Axis& y_axis) {
    const PanelFrame& frame = place.frame;
    for_ticks(x_axis, [&](double x, const std::string& text) {
        draw_line(svg, x, frame.top, x, frame.bottom(), "stroke=\"#e4e4e4\"");
        if (place.x_named) draw_text(svg, x, frame.bottom() + 18.0, "middle", "class=\"small\"", text);
    });
    for_ticks(y_axis, [&](double y, const std::string& text) {
        if (y < frame.top + place.headroom) return;  // beside the panel's name
        draw_line(svg, frame.left, y, frame.right(), y, "stroke=\"#e4e4e4\"");
        draw_text(svg, frame.left - 7.0, y + 4.0, "end", "class=\"small\"", text);
    });
    const auto describe = [](const Axis& axis, const std::string& name) {
        return FrameAxis{axis.linear.data_min, axis.linear.data_max, axis.logarithmic, name};
    };
    draw_frame(svg, frame.left, frame.top, frame.width, frame.height, describe(x_axis, plot.x_label), describe(y_axis, plot.y_label));
    if (place.x_named) draw_text(svg, frame.left + 0.5 * frame.width, frame.bottom() + 42.0, "middle", "", plot.x_label);
    draw_upward_text(svg, frame.left - frame.y_label_gap, frame.top + 0.5 * frame.height, plot.y_label);
    if (place.second_x.factor != 0.0) draw_second_axis(svg, place.second_x, x_axis, frame);
}

/// Stretches of the horizontal axis, in a faint tint of their curve.
void draw_bands(std::string& svg, const PlotSeries& series, const LineStyle& style, const Axis& x_axis, const PanelFrame& frame) {
    for (const PlotBand& band : series.bands) {
        const double from = std::max(x_axis(band.from), frame.left), to = std::min(x_axis(band.to), frame.right());
        if (!(from < to)) continue;
        svg += fmt::format(
            "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\" fill-opacity=\"0.13\" stroke=\"none\"/>\n",
            from, frame.top, to - from, frame.height, style.color);
    }
}

void append_path(std::string& path, const std::vector<PicturePoint>& points) {
    for (const PicturePoint& point : points) {
        fmt::format_to(std::back_inserter(path), "{}{:.1f} {:.1f}", path.empty() ? 'M' : 'L', point.x, point.y);
    }
}

/// Area between y_low and y.
void draw_filled(std::string& svg, const PlotSeries& series, const LineStyle& style, const Axis& x_axis, const Axis& y_axis) {
    std::vector<PicturePoint> upper, lower;
    for (std::size_t i = 0; i < series.x.size(); ++i) {
        const double x = x_axis(series.x[i]), low = y_axis(series.y_low[i]), high = y_axis(series.y[i]);
        if (!std::isfinite(x) || !std::isfinite(low) || !std::isfinite(high)) continue;
        upper.push_back({x, high});
        lower.push_back({x, low});
    }
    lower = thin_path(lower);
    std::reverse(lower.begin(), lower.end());
    std::string path;
    append_path(path, thin_path(upper));
    append_path(path, lower);
    if (path.empty()) return;
    svg += fmt::format("<path d=\"{}Z\" fill=\"{}\" fill-opacity=\"{}\" stroke=\"none\"/>\n", path, style.color, kBandOpacity);
}

void draw_series(std::string& svg, const PlotSeries& series, const LineStyle& style, const Axis& x_axis, const Axis& y_axis) {
    if (!series.y_low.empty()) return draw_filled(svg, series, style, x_axis, y_axis);
    std::vector<PicturePoint> path;
    std::string dots;
    for (std::size_t i = 0; i < series.x.size(); ++i) {
        const double x = x_axis(series.x[i]), y = y_axis(series.y[i]);
        if (!std::isfinite(x) || !std::isfinite(y)) continue;
        if (series.line) path.push_back({x, y});
        if (series.marks) fmt::format_to(std::back_inserter(dots), "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.6\"/>", x, y);
        if (i < series.y_error.size()) {
            const double low = y_axis(series.y[i] - series.y_error[i]), high = y_axis(series.y[i] + series.y_error[i]);
            const std::string bar = fmt::format("stroke=\"{}\" stroke-width=\"1\"", style.color);
            if (std::isfinite(low)) draw_line(svg, x, low, x, high, bar.c_str());
        }
    }
    std::string steps;
    append_path(steps, thin_path(path));
    if (!steps.empty()) svg += fmt::format("<path d=\"{}\" {}/>\n", steps, stroke(style));
    if (!dots.empty()) svg += fmt::format("<g fill=\"{}\">{}</g>\n", style.color, dots);
}

DataRange find_y_range(const LinePlot& plot) {
    DataRange range{.logarithmic = plot.y_logarithmic};
    for (const PlotSeries& series : plot.series) {
        for (std::size_t i = 0; i < series.y.size(); ++i) {
            const double error = i < series.y_error.size() ? series.y_error[i] : 0.0;
            range.add(series.y[i] - error);
            range.add(series.y[i] + error);
            if (!series.y_low.empty()) range.add(series.y_low[i]);
        }
    }
    if (plot.y_from_zero) range.add(0.0);
    if (plot.y_logarithmic && plot.y_most_decades > 0.0) range.low = std::max(range.low, range.high - plot.y_most_decades);
    range.widen(0.05);
    return range;
}

}  // namespace

std::vector<PicturePoint> thin_path(const std::vector<PicturePoint>& path) {
    std::vector<PicturePoint> thinned;
    auto first = path.begin();
    while (first != path.end()) {
        // the points in the column of the first
        const double column = std::floor(first->x);
        const auto last = std::find_if(first, path.end(), [&](const PicturePoint& point) { return std::floor(point.x) != column; });

        if (last - first <= 2) {
            thinned.insert(thinned.end(), first, last);
        } else {
            const auto [low, high] =
                std::minmax_element(first, last, [](const PicturePoint& a, const PicturePoint& b) { return a.y < b.y; });
            thinned.push_back(*std::min(low, high));
            if (low->y != high->y) thinned.push_back(*std::max(low, high));
        }
        first = last;
    }
    return thinned;
}

void DataRange::add(double value) {
    if (logarithmic) value = std::log10(value);
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
}

void DataRange::widen(double margin) {
    if (!(low <= high)) low = 0.0, high = 1.0;
    double extra = margin * (high - low);
    if (!(high > low)) extra = low != 0.0 ? 0.5 * std::abs(low) : 0.5;
    low -= extra;
    high += extra;
}

void add_abscissas(DataRange& range, const LinePlot& plot) {
    for (const PlotSeries& series : plot.series) {
        for (const double x : series.x) range.add(x);
    }
}

std::vector<LineStyle> find_styles(const LinePlot& plot, FindStyle find_style) {
    std::vector<LineStyle> styles;
    std::size_t next = 0;
    for (const PlotSeries& series : plot.series) {
        styles.push_back(series.style == kMarkStyle ? kMarkLine
                                                    : find_style(series.style >= 0 ? static_cast<std::size_t>(series.style) : next++));
    }
    return styles;
}

void draw_panel(std::string& svg, const LinePlot& plot, const PanelPlace& place, const std::vector<LineStyle>& styles) {
    for (const PlotSeries& series : plot.series) {
        const bool edges_match = series.y_low.empty() || series.y_low.size() == series.y.size();
        if (series.x.size() == series.y.size() && edges_match) continue;
        throw std::invalid_argument(
            fmt::format("plot: series '{}' has {} abscissas for {} values", series.label, series.x.size(), series.y.size()));
    }
    const PanelFrame& frame = place.frame;
    DataRange y_range = find_y_range(plot);
    y_range.high += (y_range.high - y_range.low) * place.headroom / (frame.height - place.headroom);
    const Axis x_axis{{place.x_range.low, place.x_range.high, frame.left, frame.right()}, plot.x_logarithmic, kTickWidth};
    const Axis y_axis{{y_range.low, y_range.high, frame.bottom(), frame.top}, plot.y_logarithmic, kTickHeight};

    for (std::size_t i = 0; i < plot.series.size(); ++i) draw_bands(svg, plot.series[i], styles[i], x_axis, frame);
    draw_axes(svg, plot, place, x_axis, y_axis);
    // what lies beyond the frame is not seen
    svg += fmt::format("<svg x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{3}\" viewBox=\"{0} {1} {2} {3}\">\n", frame.left, frame.top,
                       frame.width, frame.height);
    for (std::size_t i = 0; i < plot.series.size(); ++i) draw_series(svg, plot.series[i], styles[i], x_axis, y_axis);
    svg += "</svg>\n";
}

void draw_sample(std::string& svg, double x, double y, const PlotSeries& series, const LineStyle& style) {
    if (!series.y_low.empty()) {
        svg += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"26\" height=\"10\" fill=\"{}\" fill-opacity=\"{}\" stroke=\"none\"/>\n",
                           x - 13.0, y - 5.0, style.color, kBandOpacity);
        return;
    }
    if (series.line) draw_line(svg, x - 13.0, y, x + 13.0, y, stroke(style).c_str());
    if (series.marks) svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.6\" fill=\"{}\"/>\n", x, y, style.color);
}

}  // namespace musim::lsdem::detail
