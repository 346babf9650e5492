#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "scaling/rational.hpp"

namespace musim::scaling::detail {

/// Π x_j^(n_j) with fixed rational exponents, ready for numbers: whole powers first, one root at the end, so that powers of two stay exact
/// where the exponents allow.
class RootedProduct {
  public:
    /// Throws SimilitudeError when a power leaves 64 bits.
    explicit RootedProduct(const std::vector<Rational>& exponents);

    /// The product; none while one of its factors is missing, or when no normal double can hold it.
    std::optional<double> value(const std::vector<std::optional<double>>& factors) const;

  private:
    std::int64_t degree_ = 1;                                     ///< of the root
    std::vector<std::pair<std::size_t, std::int64_t>> powers_{};  ///< positions and powers under it
};

}  // namespace musim::scaling::detail
