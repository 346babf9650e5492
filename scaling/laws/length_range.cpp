#include "scaling/laws/length_range.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace musim::scaling {

std::vector<LengthRange> find_length_range(const ShareUsed& used, const LengthRange& within) {
    const auto fits = [&](double length) { return used(length) <= 1.0; };
    const bool fits_smallest = fits(within.smallest), fits_largest = fits(within.largest);
    if (fits_smallest && fits_largest) return {within};
    if (!fits_smallest && !fits_largest) return {};
    double inside = fits_smallest ? within.smallest : within.largest;
    double outside = fits_smallest ? within.largest : within.smallest;
    for (double middle = std::midpoint(inside, outside); middle != inside && middle != outside; middle = std::midpoint(inside, outside)) {
        (fits(middle) ? inside : outside) = middle;
    }
    return {fits_smallest ? LengthRange{within.smallest, inside} : LengthRange{inside, within.largest}};
}

std::vector<LengthRange> intersect(const std::vector<LengthRange>& a, const std::vector<LengthRange>& b) {
    std::vector<LengthRange> common;
    for (const LengthRange& one : a) {
        for (const LengthRange& other : b) {
            const LengthRange both{std::max(one.smallest, other.smallest), std::min(one.largest, other.largest)};
            if (both.smallest <= both.largest) common.push_back(both);
        }
    }
    return common;
}

std::string describe_scale(double length) { return length == 1.0 ? "1" : fmt::format("1/{:.4g}", 1.0 / length); }

}  // namespace musim::scaling
