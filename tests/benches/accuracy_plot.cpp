#include "tests/benches/accuracy_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string_view>
#include <vector>

namespace musim::lsdem {
namespace {

/// Sizes of the picture [px].
constexpr double kPanelWidth = 300.0, kPanelHeight = 210.0;
constexpr double kLeft = 58.0, kTop = 92.0, kGapX = 62.0, kGapY = 66.0;
constexpr std::size_t kColumns = 3;
constexpr double kMark = 4.2;

/// Smallest error that is resolved [-].
constexpr double kFloor = 1e-10;

enum class Mark { square, diamond, triangle, cross, star };

/// Look of a family: Okabe and Ito's colours, and marks that stay apart without colour.
struct Style {
    std::string_view family, legend;
    const char* color;
    Mark mark;
};
constexpr std::array<Style, 6> kStyles{{{"step", "time step", "#0072B2", Mark::triangle},
                                        {"nodes", "leader's nodes", "#D55E00", Mark::square},
                                        {"two-sided", "nodes of both", "#E69F00", Mark::diamond},
                                        {"grid", "grid level set", "#999999", Mark::cross},
                                        {"preset", "presets", "#000000", Mark::star},
                                        {"copy", "one ulp moved", "#CC79A7", Mark::cross}}};

const Style& find_style(const std::string& family) {
    const auto found = std::find_if(kStyles.begin(), kStyles.end(), [&](const Style& style) { return style.family == family; });
    return found == kStyles.end() ? kStyles.back() : *found;
}

/// Logarithmic map of data to pixels.
struct LogAxis {
    int first = 0, last = 1;  ///< decades
    double pixel_first = 0.0, pixel_last = 1.0;

    double at(double decade) const { return pixel_first + (decade - first) / (last - first) * (pixel_last - pixel_first); }
    double operator()(double value) const {
        return at(std::clamp(std::log10(std::max(value, 1e-300)), static_cast<double>(first), static_cast<double>(last)));
    }
};

LogAxis make_axis(std::vector<double> values, double pixel_first, double pixel_last) {
    values.erase(std::remove_if(values.begin(), values.end(), [](double v) { return !std::isfinite(v) || !(v > 0.0); }), values.end());
    if (values.empty()) return {0, 1, pixel_first, pixel_last};
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    const int first = static_cast<int>(std::floor(std::log10(*low))), last = static_cast<int>(std::ceil(std::log10(*high)));
    return {first, std::max(last, first + 1), pixel_first, pixel_last};
}

void draw_text(std::string& svg, double x, double y, const char* anchor, const char* style, std::string_view text) {
    fmt::format_to(std::back_inserter(svg), "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" {}>{}</text>\n", x, y, anchor, style, text);
}

void draw_line(std::string& svg, double x1, double y1, double x2, double y2, const char* color) {
    fmt::format_to(std::back_inserter(svg), "<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"{}\"/>\n", x1, y1, x2, y2, color);
}

void draw_mark(std::string& svg, double x, double y, const Style& style) {
    const double r = kMark;
    const auto path = [&](const std::string& d, bool filled) {
        fmt::format_to(std::back_inserter(svg), "<path d=\"{}\" stroke=\"{}\" fill=\"{}\" stroke-width=\"1.6\"/>\n", d, style.color,
                       filled ? style.color : "none");
    };
    switch (style.mark) {
        case Mark::square:
            path(fmt::format("M{:.1f} {:.1f}h{:.1f}v{:.1f}h{:.1f}z", x - r + 0.6, y - r + 0.6, 2 * r - 1.2, 2 * r - 1.2, 1.2 - 2 * r),
                 false);
            break;
        case Mark::diamond:
            path(fmt::format("M{:.1f} {:.1f}l{:.1f} {:.1f}l{:.1f} {:.1f}l{:.1f} {:.1f}z", x, y - r, r, r, -r, r, -r, -r), true);
            break;
        case Mark::triangle:
            path(fmt::format("M{:.1f} {:.1f}l{:.1f} {:.1f}h{:.1f}z", x, y - r, r, 1.8 * r, -2.0 * r), true);
            break;
        case Mark::cross:
            path(fmt::format("M{:.1f} {:.1f}l{:.1f} {:.1f}m0 {:.1f}l{:.1f} {:.1f}", x - r + 1, y - r + 1, 2 * r - 2, 2 * r - 2, 2 - 2 * r,
                             2 - 2 * r, 2 * r - 2),
                 false);
            break;
        case Mark::star:
            path(fmt::format("M{0:.1f} {1:.1f}h{2:.1f}m{3:.1f} {3:.1f}v{2:.1f}", x - 1.6 * r, y, 3.2 * r, -1.6 * r), false);
            break;
    }
}

/// One panel with its upper left corner at (x0, y0).
void draw_panel(std::string& svg, const AccuracyPanel& panel, double x0, double y0) {
    std::vector<double> seconds, errors;
    for (const AccuracyRow& row : panel.rows) {
        seconds.push_back(row.outcome.seconds);
        errors.push_back(std::max(row.outcome.error, kFloor));
    }
    const LogAxis x_axis = make_axis(seconds, x0, x0 + kPanelWidth), y_axis = make_axis(errors, y0 + kPanelHeight, y0);

    // frame and decades
    draw_text(svg, x0, y0 - 10.0, "start", "font-weight=\"bold\"", panel.title);
    for (int d = x_axis.first; d <= x_axis.last; ++d) {
        draw_line(svg, x_axis.at(d), y0, x_axis.at(d), y0 + kPanelHeight, "#e4e4e4");
        draw_text(svg, x_axis.at(d), y0 + kPanelHeight + 15.0, "middle", "class=\"s\"", fmt::format("{:g} s", std::pow(10.0, d)));
    }
    const int every = (y_axis.last - y_axis.first + 5) / 6;
    for (int d = y_axis.first; d <= y_axis.last; d += every) {
        draw_line(svg, x0, y_axis.at(d), x0 + kPanelWidth, y_axis.at(d), "#e4e4e4");
        draw_text(svg, x0 - 6.0, y_axis.at(d) + 4.0, "end", "class=\"s\"", fmt::format("1e{}", d));
    }
    fmt::format_to(std::back_inserter(svg), "<path d=\"M{:.1f} {:.1f}h{:.1f}v{:.1f}h-{:.1f}z\" stroke=\"#333\" fill=\"none\"/>\n", x0, y0,
                   kPanelWidth, kPanelHeight, kPanelWidth);

    // the front from the cheapest setting on, each step held until the next
    std::vector<const AccuracyRow*> front;
    for (const AccuracyRow& row : panel.rows)
        if (row.pareto) front.push_back(&row);
    std::sort(front.begin(), front.end(),
              [](const AccuracyRow* a, const AccuracyRow* b) { return a->outcome.seconds < b->outcome.seconds; });
    std::string path;
    for (const AccuracyRow* row : front) {
        const double x = x_axis(row->outcome.seconds), y = y_axis(std::max(row->outcome.error, kFloor));
        path += path.empty() ? fmt::format("M{:.1f} {:.1f}V{:.1f}", x, y0, y) : fmt::format("H{:.1f}V{:.1f}", x, y);
    }
    if (!path.empty()) {
        fmt::format_to(std::back_inserter(svg),
                       "<path d=\"{}H{:.1f}\" stroke=\"#CC79A7\" stroke-width=\"5\" opacity=\"0.45\" fill=\"none\"/>\n", path,
                       x0 + kPanelWidth);
    }
    for (const AccuracyRow& row : panel.rows)
        draw_mark(svg, x_axis(row.outcome.seconds), y_axis(std::max(row.outcome.error, kFloor)), find_style(row.family));
}

}  // namespace

std::string make_accuracy_svg(const AccuracySweep& sweep) {
    const std::size_t lines = (sweep.panels.size() + kColumns - 1) / kColumns;
    const double width = kLeft + kColumns * (kPanelWidth + kGapX), height = kTop + static_cast<double>(lines) * (kPanelHeight + kGapY);
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
        "font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\" font-size=\"12.5\" fill=\"#222\">\n"
        "<style>.s{{font-size:11px}} .t{{font-size:15px;font-weight:bold}}</style>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
        width, height);
    draw_text(svg, kLeft, 26.0, "start", "class=\"t\"", "Relative error over processor time; band: Pareto front");
    double x = kLeft;
    for (const Style& style : kStyles) {
        draw_mark(svg, x + 6.0, 48.0, style);
        draw_text(svg, x + 16.0, 52.0, "start", "class=\"s\"", style.legend);
        // 6.3 px is the mean width of a letter at this size
        x += 36.0 + 6.3 * static_cast<double>(style.legend.size());
    }
    for (std::size_t p = 0; p < sweep.panels.size(); ++p) {
        const double x0 = kLeft + static_cast<double>(p % kColumns) * (kPanelWidth + kGapX);
        const std::size_t row = p / kColumns;
        const double y0 = kTop + static_cast<double>(row) * (kPanelHeight + kGapY);
        draw_panel(svg, sweep.panels[p], x0, y0);
    }
    svg += "</svg>\n";
    return svg;
}

}  // namespace musim::lsdem
