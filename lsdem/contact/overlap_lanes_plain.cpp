#include "lsdem/contact/lane_pairs.hpp"

namespace musim::lsdem::detail {

void compute_pairs_plain(LanePair* pairs, std::size_t count, double dt, bool first_step, LaneOutput& nowhere,
                         std::span<const LanePair> next) {
    LanePairs<Wide<4>>::compute(pairs, count, dt, first_step, nowhere, next);
}
void find_overlaps_plain(const BoxMeeting* pairs, std::size_t count, LaneFinding* found) {
    LanePairs<Wide<4>>::find_overlaps(pairs, count, found);
}

}  // namespace musim::lsdem::detail
