#pragma once

#include <string>
#include <vector>

namespace musim::lsdem {

/// A stretch of the horizontal axis.
struct PlotBand {
    double from = 0.0;
    double to = 0.0;
};

/// PlotSeries::style of a place that is marked on an axis, a thin dashed line as of StackedPlot::mark.
inline constexpr int kMarkStyle = -2;

/// One series of a line plot.
struct PlotSeries {
    std::string label = {};              ///< in the legend; empty: not named there
    std::vector<double> x = {}, y = {};  ///< equally long; points that are not finite are left out
    bool marks = false;                  ///< a dot at every point
    bool line = true;                    ///< the points joined
    int style = -1;                      ///< colour and dash; series of the same number look alike; -1: the next one; kMarkStyle
    std::vector<double> y_error = {};    ///< half lengths of bars at the points; empty: none
    std::vector<double> y_low = {};      ///< as many as points: the stretch from here to y is shaded in place of a line; empty: none
    std::vector<PlotBand> bands = {};    ///< shaded in the colour of the series
};

/// Curves over one pair of axes.
struct LinePlot {
    std::string title = {};
    std::string subtitle = {};  ///< smaller, below
    std::string x_label;
    std::string y_label;
    std::vector<PlotSeries> series = {};
    bool y_from_zero = false;     ///< the vertical axis includes 0, when it is not logarithmic
    bool x_logarithmic = false;   ///< points, and bars that reach, to zero or below are left out
    bool y_logarithmic = false;   ///< likewise
    bool of_runs = false;         ///< each series is a run, its style the run's number: drawn as in a StackedPlot of the same runs
    double y_most_decades = 0.0;  ///< what a logarithmic vertical axis shows below the greatest value; 0: all
};

/// For values of the levels of a structure, written upward.
LinePlot make_level_plot(const std::string& title, const std::string& subtitle, const std::string& x_label);

/// A dot per level: of each of `levels`, which have a number `level`, what `value` makes of it; joined by a line where no level comes twice
/// or out of order, as of blocks side by side.
template <class Levels, class Value>
PlotSeries make_level_series(const std::string& label, const Levels& levels, const Value& value) {
    PlotSeries series{.label = label, .marks = true};
    for (const auto& level : levels) {
        if (!series.y.empty() && !(level.level > series.y.back())) series.line = false;
        series.x.push_back(value(level));
        series.y.push_back(level.level);
    }
    return series;
}

/// The plot as an SVG document, axes with round ticks, legend on the right. Throws std::invalid_argument when x and y of a series differ
/// in length.
std::string make_svg(const LinePlot& plot);

}  // namespace musim::lsdem
