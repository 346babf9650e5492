#pragma once

#include <span>

#include "records/time_series.hpp"

namespace musim::records {

/// How far one response history is from another.
struct Misfit {
    double max_relative = 0.0;  ///< max |other − reference| / max |reference|
    double rms_relative = 0.0;  ///< rms (other − reference) / rms reference
};

/// Misfit of two histories sampled at the same instants, in the same unit. A reference that is zero throughout has misfit 0 against zero
/// and infinity against anything else; a history with a value that is not finite has misfit infinity. Throws ProcessingError when the
/// lengths differ or there is nothing to compare.
Misfit compute_misfit(std::span<const double> reference, std::span<const double> other);

/// The same for two series; also throws when quantity or time step (1e-9 relative) differ.
Misfit compute_misfit(const TimeSeries& reference, const TimeSeries& other);

}  // namespace musim::records
