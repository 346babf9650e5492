#pragma once

#include <cstddef>

/// Asks for memory ahead of its use. A step walks through more than the caches near a core hold, and what it gathers (poses of two blocks,
/// forces of their pairs) lies at irregular addresses.
namespace musim::lsdem::detail {

inline constexpr std::size_t kCacheLine = 64;

/// All lines of `count` values from `first` on, which may be none of them aligned.
template <class T>
[[gnu::always_inline]] inline void prefetch(const T* first, std::size_t count = 1) {
    const char* const begin = reinterpret_cast<const char*>(first);
    const std::size_t bytes = count * sizeof(T);
    for (std::size_t at = 0; at < bytes; at += kCacheLine) __builtin_prefetch(begin + at);
    __builtin_prefetch(begin + bytes - 1);
}

}  // namespace musim::lsdem::detail
