#pragma once

#include "lsdem/contact/overlap_lanes.hpp"

/// compute_lane_pairs and compute_overlaps for machines with AVX-512; elsewhere those of AVX2 stand in and nobody calls them.
namespace musim::lsdem::detail {

void compute_pairs_512(LanePair* pairs, std::size_t count, double dt, bool first_step, LaneOutput& nowhere);
void find_overlaps_512(const BoxMeeting* pairs, std::size_t count, LaneFinding* found);

}  // namespace musim::lsdem::detail
