#include "lsdem/contact/overlap_lanes.hpp"

#include "lsdem/contact/lane_pairs.hpp"
#include "lsdem/contact/overlap_lanes_512.hpp"
#include "lsdem/detail/instructions.hpp"

namespace musim::lsdem::detail {
namespace {

MUSIM_AVX2 void compute_pairs_256(LanePair* pairs, double dt, bool first_step) { LanePairs<Wide<4>>::compute(pairs, dt, first_step); }
void compute_pairs_plain(LanePair* pairs, double dt, bool first_step) { LanePairs<Wide<4>>::compute(pairs, dt, first_step); }

MUSIM_AVX2 void find_overlaps_256(const BoxMeeting* pairs, LaneFinding* found) { LanePairs<Wide<4>>::find_overlaps(pairs, found); }
void find_overlaps_plain(const BoxMeeting* pairs, LaneFinding* found) { LanePairs<Wide<4>>::find_overlaps(pairs, found); }

/// The one of three that suits the machine.
template <class Function>
Function* widest(Function* by_512, Function* by_256, Function* plain) {
    const Instructions most = active_instructions();
    return most >= Instructions::avx512 ? by_512 : most >= Instructions::avx2 ? by_256 : plain;
}

}  // namespace

void compute_lane_pairs(LanePair* pairs, double dt, bool first_step) {
    widest(compute_pairs_512, compute_pairs_256, compute_pairs_plain)(pairs, dt, first_step);
}
void compute_overlaps(const BoxMeeting* pairs, LaneFinding* found) {
    widest(find_overlaps_512, find_overlaps_256, find_overlaps_plain)(pairs, found);
}
void ask_main_cells(const BoxMeeting* pairs, const MainCellQuestion* questions, MainCellAnswer* answers) {
    LanePairs<Wide<4>>::ask(pairs, questions, answers);
}

}  // namespace musim::lsdem::detail
