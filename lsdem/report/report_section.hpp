#pragma once

#include <string>
#include <vector>

#include "lsdem/report/report_figure.hpp"

namespace musim::lsdem {

/// A part of a report under a heading of its own.
struct ReportSection {
    std::string id;  ///< of the heading, for links
    std::string title;
    std::string html;  ///< before the figures
    std::vector<ReportFigure> figures = {};
    bool figures_beside = false;  ///< where the page is wide: beside what is before them
};

}  // namespace musim::lsdem
