#include "records/headers/short_decimal.hpp"

#include <fmt/format.h>

#include <cmath>

#include "records/detail/text.hpp"

namespace musim::records::detail {

double to_short_decimal(double value) {
    constexpr double kDust = 1e-8;  // relative; times are printed to six decimals or more over at most some 10⁴ s
    for (int digits = 1; digits <= 6; ++digits) {
        const std::optional<double> rounded = parse_real(fmt::format("{:.{}e}", value, digits - 1));
        if (rounded && std::abs(*rounded - value) <= kDust * value) return *rounded;
    }
    return value;
}

}  // namespace musim::records::detail
