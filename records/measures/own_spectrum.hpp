#pragma once

#include <optional>

#include "records/measures/response_spectrum.hpp"

namespace musim::records {

/// Response spectrum of an acceleration at the periods that the record itself resolves: 200 of them, in even steps of their logarithm,
/// from 4 dt to
///
///   corrected records (no integration corner)   its duration D; zeros as long as the record follow it, so that free vibration counts
///   uncorrected ones                            min(D/4, 1/corner), the record as it is: beyond the corner there is its noise
///
/// Empty for records too short for that. A record scaled by powers of two has the scaled spectrum to the last bit. Throws as
/// compute_response_spectrum(), and ProcessingError for a corner that is not positive.
ResponseSpectrum compute_own_spectrum(const TimeSeries& acceleration, std::optional<scaling::Frequency> integration_corner,
                                      double damping = 0.05);

}  // namespace musim::records
