#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace musim::scaling {

/// Length scales from `smallest` to `largest`, both included.
struct LengthRange {
    double smallest = 0.0, largest = 1.0;  ///< λ_l

    bool operator==(const LengthRange&) const = default;
};

/// Share of a limit that a model of length scale λ_l uses, from 0; above 1, or no number, the limit is broken.
using ShareUsed = std::function<double(double length)>;

/// The part of `within` where used(λ_l) ≤ 1, for a share that only rises or only falls with λ_l (every power of λ_l does); empty when
/// there is none. Ends are the last double for which the share is within 1: the closed form (1/used(1))^(1/n) of a power n, to rounding.
std::vector<LengthRange> find_length_range(const ShareUsed& used, const LengthRange& within);

/// All parts of `within`, by rising λ_l, where used(λ_l) ≤ 1, for any share: find_length_range() in steps of 2^(1/16), so that a part, or a
/// gap, narrower than a step can be missed.
std::vector<LengthRange> find_length_ranges(const ShareUsed& used, const LengthRange& within);

/// Ranges that two lists of disjoint ranges, each by rising λ_l, have in common; by rising λ_l.
std::vector<LengthRange> intersect(const std::vector<LengthRange>& a, const std::vector<LengthRange>& b);

/// Length scales at which all limits hold.
struct CommonRange {
    LengthRange scales;
    std::optional<std::size_t> binds_below, binds_above;  ///< position of the limit that is broken beyond; none: the end of the search
};

/// Ranges that limits, each with its ranges by rising λ_l, leave of `within`; by rising λ_l.
std::vector<CommonRange> find_common(const std::vector<std::vector<LengthRange>>& limits, const LengthRange& within);

/// "1/25" or "1/42.67", four digits; "1" for λ_l = 1.
std::string describe_scale(double length);

}  // namespace musim::scaling
