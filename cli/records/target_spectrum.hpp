#pragma once

#include <string>

#include "records/synthesis/match_spectrum.hpp"

namespace musim::cli {

/// Periods of a target that are used [s].
struct PeriodBand {
    double first = 0.0, last = 0.0;
};

/// Reads a target spectrum from CSV: one line of titles with `period_s` and `column` [g] among them, as `musim record spectrum` writes, or
/// none, and then the first two columns. Lines that begin with # are left out, and periods beyond the band. Throws records::ReadError
/// `file:line: what (why); what to do` for missing columns, cells that are no numbers, periods that do not rise, and when none is left.
records::TargetSpectrum read_target_spectrum(const std::string& file, const std::string& column, const PeriodBand& band, double damping);

}  // namespace musim::cli
