#include "scaling/laws/length_range.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

namespace musim::scaling {

namespace {

/// Beyond all logarithms of doubles.
constexpr double kLargestLogarithm = 1000.0;

/// Evaluations after which a search ends wherever it is: three times those of bisection to neighbouring doubles, which the method needs at
/// worst.
constexpr std::uintmax_t kLongestSearch = 256;

/// Position of the first limit with a range that ends at a length.
template <class End>
std::optional<std::size_t> find_binding(const std::vector<std::vector<LengthRange>>& limits, double length, const End& end) {
    for (std::size_t i = 0; i < limits.size(); ++i) {
        if (std::any_of(limits[i].begin(), limits[i].end(), [&](const LengthRange& range) { return end(range) == length; })) return i;
    }
    return {};
}

/// ln used(λ_l), finite; never zero, so that the search goes on until a neighbouring double breaks the limit.
double find_excess(const ShareUsed& used, double length) {
    const double share = used(length);
    if (share == 1.0) return -std::numeric_limits<double>::epsilon();
    return share >= 0.0 ? std::clamp(std::log(share), -kLargestLogarithm, kLargestLogarithm) : kLargestLogarithm;
}

/// A length and its excess.
struct Probe {
    double length, excess;
};

/// The part between two lengths where the limit holds, if it changes at one place at most.
std::optional<LengthRange> find_part(const ShareUsed& used, const Probe& from, const Probe& to) {
    if (from.excess < 0.0 && to.excess < 0.0) return LengthRange{from.length, to.length};
    if (from.excess > 0.0 && to.excess > 0.0) return std::nullopt;
    const auto excess = [&](double length) { return find_excess(used, length); };
    const auto are_neighbours = [](double a, double b) { return std::nextafter(a, b) == b; };
    std::uintmax_t steps = kLongestSearch;
    const auto [low, high] =
        boost::math::tools::toms748_solve(excess, from.length, to.length, from.excess, to.excess, are_neighbours, steps);
    return from.excess < 0.0 ? LengthRange{from.length, low} : LengthRange{high, to.length};
}

}  // namespace

std::vector<LengthRange> find_length_range(const ShareUsed& used, const LengthRange& within) {
    const auto probe = [&](double length) { return Probe{length, find_excess(used, length)}; };
    const auto part = find_part(used, probe(within.smallest), probe(within.largest));
    return part ? std::vector{*part} : std::vector<LengthRange>{};
}

std::vector<LengthRange> find_length_ranges(const ShareUsed& used, const LengthRange& within) {
    constexpr int kStepsPerOctave = 16;
    const int steps = static_cast<int>(std::ceil(std::log2(within.largest / within.smallest) * kStepsPerOctave));
    std::vector<LengthRange> ranges;
    Probe before{within.smallest, find_excess(used, within.smallest)};
    for (int i = 1; i <= steps; ++i) {
        const double length = i == steps ? within.largest : within.smallest * std::exp2(static_cast<double>(i) / kStepsPerOctave);
        const Probe here{length, find_excess(used, length)};
        if (const auto part = find_part(used, before, here)) {
            const bool goes_on = !ranges.empty() && part->smallest == before.length && ranges.back().largest == before.length;
            if (goes_on) {
                ranges.back().largest = part->largest;
            } else {
                ranges.push_back(*part);
            }
        }
        before = here;
    }
    return ranges;
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

std::vector<CommonRange> find_common(const std::vector<std::vector<LengthRange>>& limits, const LengthRange& within) {
    std::vector<LengthRange> common{within};
    for (const std::vector<LengthRange>& ranges : limits) common = intersect(common, ranges);
    std::vector<CommonRange> result;
    for (const LengthRange& scales : common) {
        CommonRange& range = result.emplace_back(CommonRange{scales, {}, {}});
        if (scales.smallest > within.smallest) {
            range.binds_below = find_binding(limits, scales.smallest, [](const LengthRange& each) { return each.smallest; });
        }
        if (scales.largest < within.largest) {
            range.binds_above = find_binding(limits, scales.largest, [](const LengthRange& each) { return each.largest; });
        }
    }
    return result;
}

std::string describe_scale(double length) { return length == 1.0 ? "1" : fmt::format("1/{:.4g}", 1.0 / length); }

}  // namespace musim::scaling
