#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lsdem/plot/line_plot.hpp"

namespace musim::lsdem {

/// A horizontal axis in other units, above a panel.
struct SecondAxis {
    std::string label = {};
    double factor = 0.0;  ///< its units in one of the axis below; 0: there is none
};

/// Panels below each other. Their titles stand inside their axes; what names curves is the figure's key.
struct FigureColumn {
    double width = 400.0;   ///< of the axes [px]
    bool common_x = false;  ///< one horizontal axis for all, written below the last
    std::vector<LinePlot> panels = {};
    std::vector<SecondAxis> second_x = {};  ///< above each panel, or above the first of a common axis; empty: none
};

/// A curve's name and what there is to say of it in numbers.
struct KeyRow {
    int style = 0;  ///< as in PlotSeries
    std::vector<std::string> cells;
};

/// Purpose of the styles of curves.
enum class CurveStyles {
    apart,  ///< all different, the first six in grey too
    pairs,  ///< an even style is a broad pale line, the next one thin dashes of its colour that can lie on it
};

/// Number of styles that differ, counted from 0: 18 apart (six colours by three dashes each), 10 in pairs (five colours). Later ones repeat
/// them.
std::size_t count_styles(CurveStyles styles);

/// Panels in columns of one height under a key that is a table, for print at the width of a page.
struct Figure {
    std::string title;                      ///< shrunk and shortened to the width of the columns
    std::vector<std::string> key_headings;  ///< of the cells of its rows
    std::vector<KeyRow> key;                ///< names in the first cells are shortened where the others leave too little room
    std::vector<FigureColumn> columns;
    std::vector<std::string> caption;  ///< lines below, wrapped to the width of the columns
    CurveStyles styles = CurveStyles::apart;
};

/// The figure as an SVG document. Throws std::invalid_argument when x and y of a series differ in length.
std::string make_svg(const Figure& figure);

}  // namespace musim::lsdem
