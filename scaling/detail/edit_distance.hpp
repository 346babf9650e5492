#pragma once

#include <string_view>

namespace musim::scaling::detail {

/// Edit distance [Levenshtein66]: 1 for another case of the same letter, 2 for any other change.
int edit_distance(std::string_view a, std::string_view b);

}  // namespace musim::scaling::detail
