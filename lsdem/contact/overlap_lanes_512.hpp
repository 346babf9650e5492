#pragma once

#include "lsdem/contact/overlap_lanes.hpp"

/// compute_lane_pairs for machines with AVX-512; elsewhere that of AVX2 stands in and nobody calls it.
namespace musim::lsdem::detail {

void compute_pairs_512(LanePair* pairs, double dt, bool first_step);

}  // namespace musim::lsdem::detail
