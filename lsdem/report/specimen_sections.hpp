#pragma once

#include <vector>

#include "lsdem/report/report_content.hpp"
#include "lsdem/report/report_section.hpp"

namespace musim::lsdem {

/// Prepared structures: blocks, tilts and contact forces, level by level [Harmon23, Fig. 6].
ReportSection make_specimen_section(const ReportContent& content);

/// Specimens as runs that stand, for pictures of their blocks.
std::vector<ReportedRun> make_standing_runs(const std::vector<ReportedSpecimen>& specimens);

}  // namespace musim::lsdem
