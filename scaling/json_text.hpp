#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "scaling/error.hpp"

namespace musim::scaling {

/// Levels that JSON may be nested in: files of people have ten, and a hundred thousand would overflow the stack where they are printed.
inline constexpr int kMostJsonLevels = 100;

/// Throws ParseError at a depth, from 0, of kMostJsonLevels.
void require_json_level(int depth);

/// Fault of JSON in words of one short line, from an error of the parser.
std::string describe_json_error(const nlohmann::json::exception& error);

/// Parses JSON; `Json` is nlohmann::json, or ordered_json, which keeps the order of keys. Throws ParseError, one short line without the
/// file: "parse error at line 1, column 2: ...", a number too large for a double, or more levels than kMostJsonLevels.
template <class Json = nlohmann::json>
Json parse_json_text(std::string_view text) {
    const auto check = [](int depth, typename Json::parse_event_t /*event*/, const Json& /*value*/) {
        require_json_level(depth);
        return true;
    };
    try {
        return Json::parse(text, check);
    } catch (const nlohmann::json::exception& error) {
        throw ParseError(describe_json_error(error));
    }
}

}  // namespace musim::scaling
