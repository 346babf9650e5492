#pragma once

#include <string>
#include <vector>

#include "lsdem/report/report_content.hpp"
#include "lsdem/report/report_section.hpp"

namespace musim::lsdem {

/// Scenes, materials, scales, steps, times and versions of the runs.
ReportSection make_overview_section(const ReportContent& content);

/// Velocities of the spine, of a pair with the band of its twins, and how far runs are from the first.
std::vector<ReportFigure> make_spine_figures(const ReportContent& content);

/// Profiles, speeds, energies: what every run has.
std::vector<ReportSection> make_run_sections(const std::vector<ReportedRun>& runs);

}  // namespace musim::lsdem
