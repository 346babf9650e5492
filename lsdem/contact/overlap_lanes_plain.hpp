#pragma once

#include "lsdem/contact/overlap_lanes.hpp"

/// compute_lane_pairs and compute_overlaps for machines without AVX2, and for other processors.
namespace musim::lsdem::detail {

void compute_pairs_plain(LanePair* pairs, std::size_t count, double dt, bool first_step, LaneOutput& nowhere);
void find_overlaps_plain(const BoxMeeting* pairs, std::size_t count, LaneFinding* found);

}  // namespace musim::lsdem::detail
