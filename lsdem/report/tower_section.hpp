#pragma once

#include <string>

#include "lsdem/report/report_content.hpp"
#include "lsdem/report/report_section.hpp"

namespace musim::lsdem {

/// The runs' blocks in 3D, side by side in the time of the first, with all that steers them; what is rounded, and by how much. Without
/// three.js on this machine only a line that says so.
ReportSection make_tower_section(const ReportContent& content);

/// The scripts that the section needs, three.js first; empty when that is not on this machine.
std::string make_tower_scripts();

}  // namespace musim::lsdem
