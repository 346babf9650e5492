#include "lsdem/plot/line_plot.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <vector>

#include "lsdem/plot/plot_panel.hpp"
#include "lsdem/plot/svg.hpp"

namespace musim::lsdem {
namespace {

/// Sizes of the picture [px].
constexpr detail::PanelFrame kFrame{.left = 84.0, .top = 66.0, .width = 620.0, .height = 420.0};
constexpr double kLineBottom = 56.0, kLegendWidth = 230.0, kLegendLine = 19.0;

/// A colour per series, one dash after all colours: lines as thick as each other, unlike those of runs drawn on top of each other.
detail::LineStyle find_style(std::size_t index) {
    static constexpr std::array<const char*, 6> kColors{"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#000000"};
    static constexpr std::array<const char*, 3> kDashes{"", "7 4", "2 3"};
    return {kColors[index % kColors.size()], 1.6, kDashes[index / kColors.size() % kDashes.size()]};
}

/// Look of a run, as where runs are drawn on top of each other.
detail::LineStyle find_run_style(std::size_t run) { return detail::kLineStyles[run % detail::kLineStyles.size()]; }

}  // namespace

LinePlot make_level_plot(const std::string& title, const std::string& subtitle, const std::string& x_label) {
    return {.title = title, .subtitle = subtitle, .x_label = x_label, .y_label = "level", .y_from_zero = true};
}

std::string make_svg(const LinePlot& plot) {
    detail::PanelPlace place{.frame = kFrame, .x_range = {.logarithmic = plot.x_logarithmic}};
    detail::add_abscissas(place.x_range, plot);
    place.x_range.widen(0.02);
    const std::vector<detail::LineStyle> styles = detail::find_styles(plot, plot.of_runs ? find_run_style : find_style);

    std::string svg = detail::open_svg(kFrame.right() + kLegendWidth, kFrame.bottom() + kLineBottom,
                                       fmt::format("{}: {} over {}", plot.title, plot.y_label, plot.x_label));
    detail::draw_text(svg, kFrame.left, 26.0, "start", "class=\"title\"", plot.title);
    detail::draw_text(svg, kFrame.left, 46.0, "start", "class=\"small\"", plot.subtitle);
    detail::draw_panel(svg, plot, place, styles);
    double legend = kFrame.top + 12.0;
    for (std::size_t i = 0; i < plot.series.size(); ++i) {
        if (plot.series[i].label.empty()) continue;
        const double x = kFrame.right() + 14.0;
        detail::draw_sample(svg, x + 13.0, legend, plot.series[i], styles[i]);
        detail::draw_text(svg, x + 33.0, legend + 4.0, "start", "class=\"small\"", plot.series[i].label);
        legend += kLegendLine;
    }
    svg += "</svg>\n";
    return svg;
}

}  // namespace musim::lsdem
