#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "scaling/pi_quantity.hpp"

/// What readers of problems and laws in JSON share. All throw PiError `where: what; what to do`.
namespace musim::scaling::detail {

using Json = nlohmann::json;

[[noreturn]] void fail_at(std::string_view where, std::string_view message);

/// Parses text; `origin` (a file) stands in front of the message.
Json parse_json(std::string_view text, std::string_view origin);

/// Throws for a key that is none of the known.
void refuse_unknown_keys(const Json& object, std::initializer_list<std::string_view> known, std::string_view where);

/// The text at a key that must be there; `example` is JSON.
const std::string& text_at(const Json& object, const char* key, std::string_view where, std::string_view example);

/// A number as text: a JSON number or a text such as "1/107".
std::string number_text_at(const Json& object, const char* key, std::string_view where);

/// {"name", "unit"}, and "value", with or without its standard uncertainty ("0.63 +/- 5%"), if it is there; `known` are all keys that the
/// object may have.
PiQuantity parse_quantity_object(const Json& object, const std::string& where,
                                 std::initializer_list<std::string_view> known = {"name", "unit", "value"});

}  // namespace musim::scaling::detail
