#include "lsdem/detail/avx512.hpp"
// the instructions come before what they are for
#include "lsdem/motion/motion_lanes.hpp"

namespace musim::lsdem::detail {

MUSIM_AVX512 double move_blocks_512(const Leap& leap, const Share& share, Bodies& bodies) {
    return BlockLanes<Widest>::move(leap, share, bodies);
}

}  // namespace musim::lsdem::detail
