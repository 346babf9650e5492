#pragma once

#include "lsdem/report/report_content.hpp"
#include "lsdem/report/report_section.hpp"

namespace musim::lsdem {

/// What one should know first: the main result, then warnings and what is missing; folded below them how each run ended.
ReportSection make_verdict_section(const ReportContent& content);

}  // namespace musim::lsdem
