#pragma once

#include <string>
#include <vector>

#include "lsdem/report/report_content.hpp"
#include "lsdem/report/report_section.hpp"

namespace musim::lsdem {

/// What one should know first: did the runs end well, do they agree, what is doubtful, what is missing.
ReportSection make_verdict_section(const ReportContent& content);

/// Scenes, materials, scales, steps, times and versions of the runs.
ReportSection make_overview_section(const ReportContent& content);

/// Motion of the spine, speeds, profiles, energies: what every run has.
std::vector<ReportSection> make_run_sections(const ReportContent& content);

}  // namespace musim::lsdem
