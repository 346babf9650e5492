#pragma once

#include <string_view>

namespace musim::scaling::detail {

/// Edit distance [Levenshtein66]: 1 for another case of the same letter, 2 for any other change, also for two neighbours that are swapped
/// [Damerau64], if nothing else is changed in them.
int edit_distance(std::string_view a, std::string_view b);

}  // namespace musim::scaling::detail
