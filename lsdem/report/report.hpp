#pragma once

#include <string>

#include "lsdem/report/report_content.hpp"
#include "lsdem/report/report_section.hpp"

namespace musim::lsdem {

/// The sections of a report in their order: verdict first.
std::vector<ReportSection> make_sections(const ReportContent& content);

/// One HTML page that needs nothing else: no network, no server. `version` of the program that made it.
std::string make_page(const ReportContent& content, const std::vector<ReportSection>& sections, const std::string& version);

}  // namespace musim::lsdem
