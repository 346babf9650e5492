#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scaling/json_reader.hpp"
#include "scaling/pi_quantity.hpp"

/// Parts that readers of problems and laws in JSON share. All throw PiError `where: what; what to do`.
namespace musim::scaling::detail {

using Json = JsonReader::Json;

class PiRules final : public JsonRules {
  public:
    void raise(const std::string& message) const override { throw PiError(message); }
    std::string unknown(const std::string& place, const std::string& key, const std::vector<std::string>& known) const override;
};

/// Parses text; `origin` (a file) stands in front of the message.
Json parse_json(std::string_view text, const std::string& origin);

/// The entries of the list at a key of a whole file, whose place is the file; none when the key is not there.
std::vector<JsonReader> list_at(const JsonReader& file, const std::string& key, std::string_view example);

/// The text at a key that must be there; `example` is JSON.
std::string text_at(const JsonReader& object, const std::string& key, std::string_view example);

/// A number as text: a JSON number or a text such as "1/107".
std::string number_text_at(const JsonReader& object, const std::string& key);

/// {"name", "unit"}, and "value", with or without its standard uncertainty ("0.63 +/- 5%"), if it is there; `known` are all keys that the
/// object may have.
PiQuantity parse_quantity_object(const JsonReader& value, const std::vector<std::string>& known = {"name", "unit", "value"});

}  // namespace musim::scaling::detail
