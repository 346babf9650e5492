#pragma once

#include <optional>
#include <string>
#include <vector>

namespace musim::lsdem {

/// One run in a stacked plot.
struct PlotCurves {
    std::string label;                        ///< in the legend
    std::vector<double> x = {};               ///< abscissa of all its curves, increasing
    std::vector<std::vector<double>> y = {};  ///< one curve per row of the plot, each as long as `x`
    /// Half width of a band about each curve, shaded; none where it is not finite. Empty: no bands.
    std::vector<std::vector<double>> spread = {};
    int style = -1;  ///< number of its look, as PlotSeries::style of a plot of runs; -1: its place among the runs
};

/// A place on the abscissa: a dashed line through all rows, with words at its upper end.
struct PlotMark {
    double x = 0.0;
    std::string label;
};

/// Curves of several runs, one row per level of a structure, the lowest level at the bottom, as in Fig. 8 of [Harmon23].
struct StackedPlot {
    std::string title;
    std::string subtitle;  ///< smaller, below; cut where the picture ends
    std::string x_label;
    std::string y_label;
    std::vector<std::string> row_labels = {};  ///< from bottom to top
    std::vector<PlotCurves> runs = {};         ///< drawn in order; the first one widest, so that the others show on top of it
    std::optional<PlotMark> mark = {};
};

/// The plot as an SVG document: white ground, rows spaced by their largest value, a scale bar per row spacing, colours that stay apart in
/// every kind of colour vision together with dashes that stay apart without colour. Curves are thinned to what the picture can show,
/// peaks kept. Throws std::invalid_argument when a run has another number of curves than the plot has rows, or of values or half widths
/// than abscissas.
std::string make_svg(const StackedPlot& plot);

}  // namespace musim::lsdem
