#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace musim::scaling {

/// Letters of a value that a message echoes: more than any value that is right has.
inline constexpr std::size_t kEchoed = 60;

/// A text as one line of a terminal: control characters, which a name in a file may hold, are spaces.
std::string make_line(std::string text);

/// A text for a message of one line: as it is up to `most` letters (bytes, at least 16), beyond that its beginning, "..." and its end.
std::string shorten(std::string_view text, std::size_t most = 160);

}  // namespace musim::scaling
