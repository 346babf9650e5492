#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace musim::scaling {

/// The name in `known` that is spelled most like `name`, when at most a third of the letters differ (edit distance; the case of a letter
/// counts half); else empty.
std::string find_nearest_name(std::string_view name, const std::vector<std::string>& known);

/// `did you mean "friction"?` or, where no name is near, `known are a, b, c`.
std::string suggest_name(std::string_view name, const std::vector<std::string>& known);

/// ` (did you mean "friction"?)` or, where no name is near, nothing: for messages that name what is known anyway.
std::string hint_at_name(std::string_view name, const std::vector<std::string>& known);

}  // namespace musim::scaling

namespace musim::scaling::detail {

/// The first of the names in `known` that are nearest to `name`, of those whose edit distance is below `limit`; empty for none. An edit is
/// 1 for another case of the same letter, 2 for any other change.
std::string find_nearest(std::string_view name, const std::vector<std::string>& known, const std::function<int(const std::string&)>& limit);

}  // namespace musim::scaling::detail
