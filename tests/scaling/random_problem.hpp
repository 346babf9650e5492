#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "scaling/pi_quantity.hpp"

namespace musim::scaling::tests {

/// Small exponents of up to seven base dimensions, halves and thirds now and then.
inline std::vector<PiQuantity> make_random_problem(std::mt19937_64& random, std::size_t count) {
    const auto up_to = [&](std::uint64_t n) { return static_cast<std::int64_t>(random() % (n + 1)); };
    const auto bases = static_cast<std::size_t>(1 + up_to(6));
    std::vector<PiQuantity> quantities;
    for (std::size_t j = 0; j < count; ++j) {
        PiQuantity quantity{.name = "q" + std::to_string(j), .dimension = {}, .value = {}};
        for (std::size_t b = 0; b < bases; ++b) {
            if (up_to(1) == 0) quantity.dimension[kBaseDimensions[b]] = Rational(up_to(6) - 3, up_to(9) == 0 ? 1 + up_to(2) : 1);
        }
        quantities.push_back(quantity);
    }
    return quantities;
}

}  // namespace musim::scaling::tests
