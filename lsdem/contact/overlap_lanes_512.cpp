// Every function over lanes in this file is compiled for AVX-512, see lsdem/detail/instructions.hpp.
#if defined(__x86_64__)
#define MUSIM_WIDE_TARGET gnu::target("avx512f,avx512dq,avx512vl")
#define MUSIM_WIDE [[gnu::always_inline, MUSIM_WIDE_TARGET]] inline
#define MUSIM_WIDE_LAMBDA __attribute__((always_inline, target("avx512f,avx512dq,avx512vl")))
#endif

#include "lsdem/contact/lane_pairs.hpp"
#if defined(__x86_64__)
#include "lsdem/contact/wide_512.hpp"
#endif

namespace musim::lsdem::detail {

#if defined(__x86_64__)
#define MUSIM_AVX512 [[MUSIM_WIDE_TARGET]]
using Widest = Wide<8>;
#else
#define MUSIM_AVX512
using Widest = Wide<4>;
#endif

MUSIM_AVX512 void compute_pairs_512(LanePair* pairs, std::size_t count, double dt, bool first_step, LaneOutput& nowhere,
                                    std::span<const LanePair> next) {
    LanePairs<Widest>::compute(pairs, count, dt, first_step, nowhere, next);
}
MUSIM_AVX512 void find_overlaps_512(const BoxMeeting* pairs, std::size_t count, LaneFinding* found) {
    LanePairs<Widest>::find_overlaps(pairs, count, found);
}

}  // namespace musim::lsdem::detail
