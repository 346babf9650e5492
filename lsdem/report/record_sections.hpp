#pragma once

#include <optional>

#include "lsdem/report/report_content.hpp"
#include "lsdem/report/report_section.hpp"

namespace musim::lsdem {

/// Records as files hold them: histories, peaks, spectra, one figure a file.
ReportSection make_record_section(const ReportContent& content);

/// What shook the base of each run, and what it comes from: the motion divided by the factors that its scene applied to the record, with
/// histories and spectra of both. Accelerations are means between two samples of the run. Nothing for runs whose base stands.
std::optional<ReportSection> make_base_motion_section(const ReportContent& content);

}  // namespace musim::lsdem
