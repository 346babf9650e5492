#include "scaling/nearest_name.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <utility>
#include <vector>

namespace musim::scaling {

namespace {

bool are_same_letter(char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b)); }

/// [Levenshtein66], with two neighbours that are swapped as one change [Damerau64], if nothing else is changed in them.
int edit_distance(std::string_view a, std::string_view b) {
    // row i: distances of the first i letters of a from the beginnings of b
    std::vector<int> before_last, last, row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = 2 * static_cast<int>(j);
    for (std::size_t i = 0; i < a.size(); ++i) {
        before_last = std::exchange(last, row);
        row[0] = last[0] + 2;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const int substitution = a[i] == b[j] ? 0 : are_same_letter(a[i], b[j]) ? 1 : 2;
            row[j + 1] = std::min({last[j] + substitution, row[j] + 2, last[j + 1] + 2});
            const bool is_swapped = i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j];
            if (is_swapped) row[j + 1] = std::min(row[j + 1], before_last[j - 1] + 2);
        }
    }
    return row[b.size()];
}

}  // namespace

std::string find_nearest_name(std::string_view name, const std::vector<std::string>& known) {
    // an edit counts 2
    const auto limit = [&](const std::string& candidate) { return 2 * static_cast<int>(std::max(candidate.size(), name.size())) / 3 + 1; };
    return detail::find_nearest(name, known, limit);
}

std::string suggest_name(std::string_view name, const std::vector<std::string>& known) {
    const std::string nearest = find_nearest_name(name, known);
    return nearest.empty() ? fmt::format("known are {}", fmt::join(known, ", ")) : fmt::format("did you mean \"{}\"?", nearest);
}

std::string hint_at_name(std::string_view name, const std::vector<std::string>& known) {
    const std::string nearest = find_nearest_name(name, known);
    return nearest.empty() ? std::string() : fmt::format(" (did you mean \"{}\"?)", nearest);
}

}  // namespace musim::scaling

namespace musim::scaling::detail {

std::string find_nearest(std::string_view name, const std::vector<std::string>& known,
                         const std::function<int(const std::string&)>& limit) {
    std::string nearest;
    int smallest = std::numeric_limits<int>::max();
    for (const std::string& candidate : known) {
        const int distance = edit_distance(name, candidate);
        if (distance >= std::min(smallest, limit(candidate))) continue;
        smallest = distance;
        nearest = candidate;
    }
    return nearest;
}

}  // namespace musim::scaling::detail
