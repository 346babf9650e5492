#pragma once

#include <string>

#include "lsdem/plot/line_plot.hpp"
#include "lsdem/plot/plot.hpp"
#include "lsdem/report/html.hpp"

namespace musim::lsdem {

/// A plot in a report, which can also be a file of its own for a paper.
struct ReportFigure {
    std::string name;   ///< of its files: letters, digits, underscores
    std::string title;  ///< in words, for who does not see it, too
    std::string svg;
    std::string csv;             ///< all that it draws
    HtmlTable twin = {};         ///< what it shows, in numbers
    double seconds_per_x = 0.0;  ///< where x is the time of the first run: [s] in one of its units, for the view of the blocks; else 0
};

/// Curves over one pair of axes. CSV: series,x,y, one line per point; of a shaded stretch a second series. Twin: for each series its ends
/// and its smallest and largest value.
ReportFigure make_figure(const std::string& name, const LinePlot& plot);

/// Stacked curves. CSV: run,row,x,y,spread (half width of the band, or empty). Twin: for each run and row the value of largest magnitude,
/// when that is, the last one, and the widest half of the band.
ReportFigure make_figure(const std::string& name, const StackedPlot& plot);

/// Text in place of the picture: what is drawn over what, and the first rows of the twin.
std::string describe(const ReportFigure& figure);

/// The figure, described for who does not see it, with its twin folded below.
std::string to_html(const ReportFigure& figure);

}  // namespace musim::lsdem
