#pragma once

#include <optional>
#include <vector>

#include "records/time_series.hpp"

namespace musim::records {

/// The acceleration, velocity and displacement of one component; what its quantity does not give is left out.
struct MotionHistories {
    std::optional<TimeSeries> acceleration;
    std::optional<TimeSeries> velocity;
    TimeSeries displacement;
};

/// Histories by trapezoid integrals from zero. With an integration corner (uncorrected records) the acceleration is that above its initial
/// level (level_uncorrected), and the others come from the samples, their mean taken out, high-passed there, order 2, forward and backward;
/// the displacement from that velocity without its mean, which would be a drift.
/// Throws ProcessingError for a corner that the samples cannot have.
MotionHistories compute_histories(const TimeSeries& series, std::optional<scaling::Frequency> integration_corner = std::nullopt);

/// Build-up of the Arias intensity, ∫₀ᵗ a² dt / ∫₀^end a² dt at every sample, from 0 to 1 [Husid69]; all zero for a record without motion.
/// Depends on the ratios of the samples only. Throws ProcessingError for another quantity.
std::vector<double> compute_arias_share(const TimeSeries& acceleration);

}  // namespace musim::records
