#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "lsdem/plot/figure.hpp"
#include "lsdem/plot/line_plot.hpp"
#include "lsdem/plot/svg.hpp"

/// One pair of axes with its curves, as single plots and figures of several panels draw them.
namespace musim::lsdem::detail {

/// Where the axes of a panel stand [px].
struct PanelFrame {
    double left = 0.0;
    double top = 0.0;
    double width = 1.0;
    double height = 1.0;
    double y_label_gap = 64.0;  ///< from the name of the vertical axis to the axis

    double right() const { return left + width; }
    double bottom() const { return top + height; }
};

/// Least and greatest finite value, or of its decimal logarithm.
struct DataRange {
    bool logarithmic = false;
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    void add(double value);

    /// With a margin of this part of its length at both ends, and never empty.
    void widen(double margin);
};

/// A place in a picture [px].
struct PicturePoint {
    double x = 0.0;
    double y = 0.0;
    friend bool operator==(const PicturePoint&, const PicturePoint&) = default;
};

/// Visible points of a path: of more than two points in a row in the same pixel column only the lowest and the highest, in their order.
/// So a column has two points at most each time the path enters it, peaks stay, and a path without such rows stays as it is.
std::vector<PicturePoint> thin_path(const std::vector<PicturePoint>& path);

/// The range of all abscissas of `plot`, added to `range`.
void add_abscissas(DataRange& range, const LinePlot& plot);

/// The look of a series by its number.
using FindStyle = LineStyle (*)(std::size_t index);

/// The look of every series of `plot`: by its style, or else by its place among those without one.
std::vector<LineStyle> find_styles(const LinePlot& plot, FindStyle find_style);

/// Place of a panel among others.
struct PanelPlace {
    PanelFrame frame;
    DataRange x_range;      ///< of its horizontal axis, as it is drawn
    bool x_named = true;    ///< ticks and name of the horizontal axis are written
    double headroom = 0.0;  ///< kept free of curves below the upper edge [px]
    SecondAxis second_x = {};
};

/// Axes, bands and curves of `plot`; its title, subtitle and legend are the caller's. Throws std::invalid_argument when x and y of a series
/// differ in length.
void draw_panel(std::string& svg, const LinePlot& plot, const PanelPlace& place, const std::vector<LineStyle>& styles);

/// A short piece of a curve, its middle at (x, y) [px], and its mark: for legends.
void draw_sample(std::string& svg, double x, double y, const PlotSeries& series, const LineStyle& style);

}  // namespace musim::lsdem::detail
