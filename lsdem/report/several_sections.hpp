#pragma once

#include "lsdem/report/report_content.hpp"
#include "lsdem/report/report_section.hpp"

namespace musim::lsdem {

/// The stages of a sequence: what each did, and what all have left.
ReportSection make_sequence_section(const ReportContent& content);

/// The members of each ensemble, and how far the ensembles agree.
ReportSection make_ensemble_section(const ReportContent& content);

/// The bands of their motion; none when no ensemble has one.
std::vector<ReportFigure> make_ensemble_figures(const std::vector<ReportedEnsemble>& ensembles);

}  // namespace musim::lsdem
