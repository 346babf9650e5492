#pragma once

#include <cstdint>

namespace musim::lsdem::detail {

/// Random numbers that are the same everywhere: SplitMix64 [Steele14].
class SplitMix64 {
  public:
    explicit SplitMix64(std::uint64_t seed) : seed_(seed) {}
    /// Uniform in 0 ... bound − 1; the bias of the remainder is below bound/2^64.
    std::uint64_t below(std::uint64_t bound);
    /// k with probability 2^−(k+1): an exponential law in integers.
    std::uint64_t halvings();
    /// Uniform in (0, 1], a multiple of 2^−53.
    double uniform();

  private:
    std::uint64_t next();

    std::uint64_t seed_;
    std::uint64_t drawn_ = 0;
};

}  // namespace musim::lsdem::detail
