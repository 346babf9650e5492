#pragma once

#include "records/ground_motion.hpp"
#include "scaling/similitude.hpp"

namespace musim::records {

/// The record that a model must be given in place of the prototype's: times (start, dt) times λ_t, samples times the factor of their
/// quantity (λ_a, λ_v or λ_l), the integration corner over λ_t. Multiplications only, so that factors that are powers of two are exact; no
/// resampling. Its clock is its own: it has no time_zero. A line in the history says which law and factors were used.
GroundMotion rescale(const GroundMotion& prototype, const scaling::Similitude& similitude);

/// The same for one series.
TimeSeries rescale(const TimeSeries& prototype, const scaling::Similitude& similitude);

}  // namespace musim::records
