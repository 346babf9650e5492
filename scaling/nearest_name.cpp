#include "scaling/nearest_name.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "scaling/detail/edit_distance.hpp"

namespace musim::scaling {

std::string find_nearest_name(std::string_view name, const std::vector<std::string>& known) {
    std::string nearest;
    std::size_t smallest = 0;
    for (const std::string& candidate : known) {
        // an edit counts 2
        const auto distance = static_cast<std::size_t>(detail::edit_distance(name, candidate));
        if (3 * distance > 2 * std::max(candidate.size(), name.size()) || (!nearest.empty() && distance >= smallest)) continue;
        smallest = distance;
        nearest = candidate;
    }
    return nearest;
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
