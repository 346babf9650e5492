#pragma once

#include <vector>

#include "lsdem/report/html.hpp"
#include "lsdem/report/report_content.hpp"

namespace musim::lsdem {

/// The main result in a sentence or two with its numbers: of a pair, a sequence or the runs together; of each ensemble. Empty when there is
/// no run.
std::vector<Statement> make_headlines(const ReportContent& content);

}  // namespace musim::lsdem
