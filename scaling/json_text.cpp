#include "scaling/json_text.hpp"

#include <fmt/format.h>

#include "scaling/shorten.hpp"

namespace musim::scaling {

void require_json_level(int depth) {
    if (depth >= kMostJsonLevels) throw ParseError(fmt::format("nested in more than {} levels", kMostJsonLevels));
}

std::string describe_json_error(const nlohmann::json::exception& error) {
    // "[json.exception.parse_error.101] parse error at line 1, column 2: ..."
    const std::string_view message = error.what();
    const std::size_t bracket = message.find("] ");
    return shorten(message.substr(bracket == std::string_view::npos ? 0 : bracket + 2));
}

}  // namespace musim::scaling
