#include "lsdem/detail/avx512.hpp"
// the instructions come before what they are for
#include "lsdem/contact/lane_pairs.hpp"

namespace musim::lsdem::detail {

MUSIM_AVX512 void compute_pairs_512(LanePair* pairs, std::size_t count, double dt, bool first_step, LaneOutput& nowhere,
                                    std::span<const LanePair> next) {
    LanePairs<Widest>::compute(pairs, count, dt, first_step, nowhere, next);
}
MUSIM_AVX512 void find_overlaps_512(const BoxMeeting* pairs, std::size_t count, LaneFinding* found) {
    LanePairs<Widest>::find_overlaps(pairs, count, found);
}

}  // namespace musim::lsdem::detail
