#pragma once

#include "lsdem/contact/overlap_lanes.hpp"

/// The functions of overlap_lanes.hpp for machines with AVX-512; elsewhere those of AVX2 stand in and nobody calls these.
namespace musim::lsdem::detail {

void compute_pairs_512(LanePair* pairs, double dt, bool first_step);
void find_overlaps_512(const BoxMeeting* pairs, LaneFinding* found);
void ask_512(const BoxMeeting* pairs, const MainCellQuestion* questions, MainCellAnswer* answers);

}  // namespace musim::lsdem::detail
