#include "lsdem/contact/overlap_lanes.hpp"

#include "lsdem/contact/lane_pairs.hpp"
#include "lsdem/detail/instructions.hpp"

namespace musim::lsdem::detail {
namespace {

MUSIM_AVX2 void compute_pairs_256(LanePair* pairs, std::size_t count, double dt, bool first_step, LaneOutput& nowhere,
                                  std::span<const LanePair> next) {
    LanePairs<Wide<4>>::compute(pairs, count, dt, first_step, nowhere, next);
}
MUSIM_AVX2 void find_overlaps_256(const BoxMeeting* pairs, std::size_t count, LaneFinding* found) {
    LanePairs<Wide<4>>::find_overlaps(pairs, count, found);
}

}  // namespace

void compute_lane_pairs(LanePair* pairs, std::size_t count, double dt, bool first_step, LaneOutput& nowhere,
                        std::span<const LanePair> next) {
    widest(compute_pairs_512, compute_pairs_256, compute_pairs_plain)(pairs, count, dt, first_step, nowhere, next);
}
void compute_overlaps(const BoxMeeting* pairs, std::size_t count, LaneFinding* found) {
    widest(find_overlaps_512, find_overlaps_256, find_overlaps_plain)(pairs, count, found);
}

}  // namespace musim::lsdem::detail
