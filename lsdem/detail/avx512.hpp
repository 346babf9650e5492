#pragma once

/// Included before all else by files whose functions over lanes are compiled for AVX-512, see lsdem/detail/instructions.hpp; on another
/// processor they have four lanes.
#if defined(__x86_64__)
#define MUSIM_WIDE_TARGET gnu::target("avx512f,avx512dq,avx512vl")
#define MUSIM_WIDE [[gnu::always_inline, MUSIM_WIDE_TARGET]] inline
#define MUSIM_WIDE_LAMBDA __attribute__((always_inline, target("avx512f,avx512dq,avx512vl")))
#define MUSIM_AVX512 [[MUSIM_WIDE_TARGET]]
#include "lsdem/detail/wide_512.hpp"
namespace musim::lsdem::detail {
using Widest = Wide<8>;
}
#else
#define MUSIM_AVX512
#include "lsdem/detail/wide.hpp"
namespace musim::lsdem::detail {
using Widest = Wide<4>;
}
#endif
