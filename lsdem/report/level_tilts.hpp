#pragma once

#include <string>
#include <vector>

#include "lsdem/report/report_figure.hpp"

namespace musim::lsdem {

/// How the tilts of blocks are distributed over the levels of a structure at its start [Harmon23, Fig. 6]: of each level the median, what
/// nine of ten blocks stay below, and the largest [degrees]. `layer` and `tilt` [rad] have an entry per block; blocks in layer 0 are in
/// none. `whose` stands below the title.
ReportFigure make_tilt_figure(const std::string& name, const std::string& whose, const std::vector<int>& layer,
                              const std::vector<double>& tilt);

}  // namespace musim::lsdem
