#include "lsdem/study/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <stdexcept>

namespace musim::lsdem::study {
namespace {

/// Sizes of the picture [px].
constexpr double kLeft = 84.0;
constexpr double kRight = 24.0;
constexpr double kTop = 96.0;
constexpr double kBottom = 56.0;
constexpr double kPlotWidth = 812.0;
constexpr double kRowSpacing = 52.0;
constexpr double kLegendDash = 44.0;

/// A curve is thinned to its least and greatest value in each of these bins: 2 px, finer than the widest line is thick.
constexpr std::size_t kBins = 400;

struct LineStyle {
    const char* color;
    double width;
    const char* dash;
};

/// Colours of Okabe and Ito's palette, chosen for all kinds of colour vision; the dashes tell the lines apart in grey.
constexpr std::array<LineStyle, 6> kStyles{{{"#56B4E9", 3.4, ""},
                                            {"#D55E00", 1.6, "8 7"},
                                            {"#000000", 1.3, "1.5 4"},
                                            {"#009E73", 1.3, "9 3 1.5 3"},
                                            {"#CC79A7", 1.3, "4 4"},
                                            {"#0072B2", 1.3, "12 5"}}};

/// Linear map of data to pixels.
struct Axis {
    double data_min = 0.0;
    double data_max = 1.0;
    double pixel_min = 0.0;
    double pixel_max = 1.0;

    double operator()(double value) const { return pixel_min + (value - data_min) / (data_max - data_min) * (pixel_max - pixel_min); }
};

std::string escape(const std::string& text) {
    std::string safe;
    for (const char c : text) {
        switch (c) {
            case '&':
                safe += "&amp;";
                break;
            case '<':
                safe += "&lt;";
                break;
            case '>':
                safe += "&gt;";
                break;
            case '"':
                safe += "&quot;";
                break;
            default:
                safe += c;
        }
    }
    return safe;
}

/// What fits into the width of the plot at 6.2 px a letter.
std::string shorten(const std::string& text) {
    constexpr std::size_t kFits = 130;
    return text.size() <= kFits ? text : text.substr(0, kFits) + " ...";
}

/// 1, 2 or 5 times a power of ten, nearest below `value`.
double round_down(double value) {
    const double decade = std::pow(10.0, std::floor(std::log10(value)));
    const double leading = value / decade;
    if (leading >= 5.0) return 5.0 * decade;
    return leading >= 2.0 ? 2.0 * decade : decade;
}

void require_consistent(const StackedPlot& plot) {
    for (const PlotCurves& run : plot.runs) {
        if (run.y.size() != plot.row_labels.size()) {
            throw std::invalid_argument(
                fmt::format("plot: run '{}' has {} curves for {} rows", run.label, run.y.size(), plot.row_labels.size()));
        }
        for (const std::vector<double>& curve : run.y) {
            if (curve.size() != run.x.size()) {
                throw std::invalid_argument(
                    fmt::format("plot: run '{}' has {} values at {} abscissas", run.label, curve.size(), run.x.size()));
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
    return {first, last, kLeft, kLeft + kPlotWidth};
}

/// Largest finite absolute value of all curves: the data a row spacing stands for. A diverged run must not flatten the others, hence no
/// more than a hundred times the first run's.
double find_row_scale(const StackedPlot& plot) {
    double scale = 0.0;
    double first_run = 0.0;
    for (const PlotCurves& run : plot.runs) {
        for (const std::vector<double>& curve : run.y) {
            for (const double value : curve) {
                if (std::isfinite(value)) scale = std::max(scale, std::abs(value));
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

void draw_text(std::string& svg, double x, double y, const char* anchor, const char* style, const std::string& text) {
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" {}>{}</text>\n", x, y, anchor, style, escape(text));
}

void draw_line(std::string& svg, double x1, double y1, double x2, double y2, const char* style) {
    svg += fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", x1, y1, x2, y2, style);
}

std::string stroke(const LineStyle& line) {
    const std::string dash = *line.dash != '\0' ? fmt::format(" stroke-dasharray=\"{}\"", line.dash) : "";
    return fmt::format("stroke=\"{}\" stroke-width=\"{}\"{} fill=\"none\" stroke-linejoin=\"round\"", line.color, line.width, dash);
}

void draw_x_ticks(std::string& svg, const Axis& x_axis, double bottom) {
    const double spacing = round_down((x_axis.data_max - x_axis.data_min) / 5.0);
    for (double i = std::ceil(x_axis.data_min / spacing); i * spacing <= x_axis.data_max; ++i) {
        const double x = x_axis(i * spacing);
        draw_line(svg, x, kTop, x, bottom, "stroke=\"#e4e4e4\"");
        draw_line(svg, x, bottom, x, bottom + 5.0, "stroke=\"#333\"");
        draw_text(svg, x, bottom + 19.0, "middle", "class=\"small\"", fmt::format("{:.4g}", i * spacing));
    }
}

void draw_legend(std::string& svg, const StackedPlot& plot) {
    double x = kLeft;
    for (std::size_t r = 0; r < plot.runs.size(); ++r) {
        const std::string style = stroke(kStyles[r % kStyles.size()]);
        draw_line(svg, x, 70.0, x + kLegendDash, 70.0, style.c_str());
        draw_text(svg, x + kLegendDash + 7.0, 74.0, "start", "", plot.runs[r].label);
        // 7.2 px is the mean width of a letter at this size
        x += kLegendDash + 34.0 + 7.2 * static_cast<double>(plot.runs[r].label.size());
    }
}

/// A bar as long as a round value, at the right end of the frame's top.
void draw_scale_bar(std::string& svg, double row_scale) {
    const double value = round_down(row_scale);
    const double length = value / row_scale * kRowSpacing;
    const double x = kLeft + kPlotWidth - 8.0;
    draw_line(svg, x, kTop - 8.0 - length, x, kTop - 8.0, "stroke=\"#333\" stroke-width=\"2\"");
    draw_text(svg, x - 8.0, kTop - 10.0, "end", "class=\"small\"", fmt::format("bar: {:.3g}", value));
}

}  // namespace

std::string make_svg(const StackedPlot& plot) {
    require_consistent(plot);
    const auto rows = static_cast<double>(plot.row_labels.size());
    const double width = kLeft + kPlotWidth + kRight;
    const double bottom = kTop + (rows + 1.0) * kRowSpacing;
    const double height = bottom + kBottom;
    const Axis x_axis = make_x_axis(plot);
    const double row_scale = find_row_scale(plot);

    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
        "font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\" font-size=\"13\" fill=\"#222\">\n"
        "<style>.small{{font-size:11.5px}} .title{{font-size:15px;font-weight:bold}}</style>\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
        "<clipPath id=\"frame\"><rect x=\"{2:.1f}\" y=\"{3:.1f}\" width=\"{4:.1f}\" height=\"{5:.1f}\"/></clipPath>\n",
        width, height, kLeft, kTop, kPlotWidth, bottom - kTop);

    // axes: frame, ticks, labels, legend
    draw_text(svg, kLeft, 26.0, "start", "class=\"title\"", plot.title);
    draw_text(svg, kLeft, 46.0, "start", "class=\"small\"", shorten(plot.subtitle));
    draw_legend(svg, plot);
    draw_x_ticks(svg, x_axis, bottom);
    svg += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" stroke=\"#333\"/>\n", kLeft, kTop,
                       kPlotWidth, bottom - kTop);
    draw_scale_bar(svg, row_scale);
    draw_text(svg, kLeft + 0.5 * kPlotWidth, height - 14.0, "middle", "", plot.x_label);
    svg += fmt::format("<text transform=\"translate(20 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n", 0.5 * (kTop + bottom),
                       escape(plot.y_label));

    // one row per level, every run on top of the one before
    svg += "<g clip-path=\"url(#frame)\">\n";
    for (std::size_t row = 0; row < plot.row_labels.size(); ++row) {
        const double zero = bottom - (static_cast<double>(row) + 1.0) * kRowSpacing;
        const Axis y_axis{0.0, row_scale, zero, zero - kRowSpacing};
        draw_line(svg, kLeft, zero, kLeft + kPlotWidth, zero, "stroke=\"#d0d0d0\"");
        for (std::size_t r = 0; r < plot.runs.size(); ++r) {
            const std::string path = make_path(plot.runs[r].x, plot.runs[r].y[row], x_axis, y_axis);
            svg += fmt::format("<path d=\"{}\" {}/>\n", path, stroke(kStyles[r % kStyles.size()]));
        }
    }
    svg += "</g>\n";
    for (std::size_t row = 0; row < plot.row_labels.size(); ++row) {
        const double zero = bottom - (static_cast<double>(row) + 1.0) * kRowSpacing;
        draw_line(svg, kLeft - 5.0, zero, kLeft, zero, "stroke=\"#333\"");
        draw_text(svg, kLeft - 9.0, zero + 4.0, "end", "class=\"small\"", plot.row_labels[row]);
    }
    svg += "</svg>\n";
    return svg;
}

}  // namespace musim::lsdem::study
