#pragma once

#include "lsdem/report/report_content.hpp"
#include "lsdem/report/report_section.hpp"

namespace musim::lsdem {

/// Factors of the models to their prototype, and the groups they distort, by colour and word.
ReportSection make_scale_section(const ReportContent& content);

}  // namespace musim::lsdem
