#pragma once

#include "lsdem/report/report_content.hpp"
#include "lsdem/report/report_section.hpp"

namespace musim::lsdem {

/// The stages of a sequence: what each did, and what all have left.
ReportSection make_sequence_section(const ReportContent& content);

/// The members of an ensemble, mean and scatter of what they show, and the bands of their motion.
ReportSection make_ensemble_section(const ReportContent& content);

}  // namespace musim::lsdem
