#include "lsdem/detail/instructions.hpp"

#include <algorithm>
#include <atomic>

namespace musim::lsdem::detail {
namespace {

Instructions widest() {
#if defined(__x86_64__)
    const bool wide = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
    if (wide) return Instructions::avx512;
    return __builtin_cpu_supports("avx2") ? Instructions::avx2 : Instructions::plain;
#else
    return Instructions::plain;
#endif
}

std::atomic<Instructions> active{widest()};

}  // namespace

Instructions active_instructions() { return active.load(std::memory_order_relaxed); }

void limit_instructions(Instructions most) { active.store(std::min(most, widest()), std::memory_order_relaxed); }

}  // namespace musim::lsdem::detail
