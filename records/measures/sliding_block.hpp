#pragma once

#include "records/time_series.hpp"

namespace musim::records {

/// Distances that a rigid block slides on a base that moves under it.
struct Sliding {
    scaling::Length largest;   ///< largest distance from where it lay
    scaling::Length residual;  ///< where it lies at the end, positive with the base's motion ahead of the block
};

/// Newmark's rigid block on a level base, free to slide both ways, dragged along with at most `yield` = μ g [Newmark65]. Exact for an
/// acceleration that is linear between its samples; sliding ends with the record. Throws ProcessingError for another quantity and unless
/// yield > 0.
Sliding compute_sliding(const TimeSeries& acceleration, scaling::Acceleration yield);

}  // namespace musim::records
