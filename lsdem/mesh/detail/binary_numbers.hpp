#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

namespace musim::lsdem::detail {

/// The number whose bytes stand at `bytes`, in the given order.
template <class Number>
Number load_number(const char* bytes, std::endian order) {
    std::array<char, sizeof(Number)> copy;
    std::copy_n(bytes, copy.size(), copy.begin());
    if (order != std::endian::native) std::reverse(copy.begin(), copy.end());
    return std::bit_cast<Number>(copy);
}

}  // namespace musim::lsdem::detail
