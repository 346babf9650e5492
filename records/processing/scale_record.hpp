#pragma once

#include <vector>

#include "records/ground_motion.hpp"
#include "scaling/laws/model_scales.hpp"

namespace musim::records {

/// The record that a model must be given in place of the prototype's: times (start, dt) times λ_t, samples times the factor of their
/// quantity (λ_a, λ_v or λ_u) in the direction of their component, vertical by is_vertical(), those of a rotation times 1 (angle), 1/λ_t or
/// 1/λ_t²; the integration corner over λ_t.
/// Multiplications only, so that factors that are powers of two are exact; no resampling. Its clock is its own: it has no time_zero. A
/// line in the history says which law and factors were used.
GroundMotion rescale(const GroundMotion& prototype, const scaling::ModelScales& scales);

/// The same with one direction for each component.
GroundMotion rescale(const GroundMotion& prototype, const scaling::ModelScales& scales, const std::vector<scaling::Shaking>& directions);

/// The same for one series.
TimeSeries rescale(const TimeSeries& prototype, const scaling::ModelScales& scales,
                   scaling::Shaking direction = scaling::Shaking::horizontal);

/// Which way a component shakes, by is_vertical().
scaling::Shaking find_shaking(const Component& component);

}  // namespace musim::records
