#include "lsdem/motion/motion_kernel.hpp"

#include "lsdem/detail/instructions.hpp"
#include "lsdem/motion/motion_lanes.hpp"

namespace musim::lsdem::detail {

void TouchList::rebuild(std::size_t blocks, const std::vector<ContactPair>& pairs, const std::vector<std::uint32_t>& loaded) {
    begin_.assign(blocks + 2, 0);
    for (const ContactPair& pair : pairs) {
        ++begin_[pair.leader + 1];
        ++begin_[pair.follower + 1];
    }
    for (const std::uint32_t block : loaded) ++begin_[block + 1];
    for (std::size_t i = 0; i <= blocks; ++i) begin_[i + 1] += begin_[i];
    touches_.resize(begin_.back());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::uint32_t p = 0; p < pairs.size(); ++p) {
        touches_[next[pairs[p].leader]++] = {p, true};
        touches_[next[pairs[p].follower]++] = {p, false};
    }
    auto force = static_cast<std::uint32_t>(pairs.size());
    for (const std::uint32_t block : loaded) touches_[next[block]++] = {force++, true};
}

namespace {

MUSIM_AVX2 double move_blocks_256(const Leap& leap, const Share& share, Bodies& bodies) {
    return BlockLanes<Wide<4>>::move(leap, share, bodies);
}

double move_blocks_plain(const Leap& leap, const Share& share, Bodies& bodies) { return BlockLanes<Wide<4>>::move(leap, share, bodies); }

}  // namespace

double move_blocks(const Leap& leap, const Share& share, Bodies& bodies) {
    return widest(move_blocks_512, move_blocks_256, move_blocks_plain)(leap, share, bodies);
}

}  // namespace musim::lsdem::detail
