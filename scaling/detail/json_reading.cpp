#include "scaling/detail/json_reading.hpp"

#include <fmt/format.h>

#include <optional>

#include "scaling/json_text.hpp"
#include "scaling/nearest_name.hpp"
#include "scaling/shorten.hpp"
#include "scaling/uncertain.hpp"

namespace musim::scaling::detail {

std::string PiRules::unknown(const std::string& place, const std::string& key, const std::vector<std::string>& known) const {
    return fmt::format("{}: unknown key {}; {}", place, shorten(Json(key).dump(), kEchoed), suggest_name(key, known));
}

Json parse_json(std::string_view text, const std::string& origin) {
    try {
        return parse_json_text<Json>(text);
    } catch (const ParseError& error) {
        throw PiError(fmt::format("{}: {}; correct the JSON", origin, error.what()));
    }
}

std::vector<JsonReader> list_at(const JsonReader& file, const std::string& key, std::string_view example) {
    if (!file.json().contains(key)) return {};
    if (!file.json()[key].is_array()) file.fail(fmt::format("\"{}\" is no list; write \"{}\": {}", key, key, example));
    return file.rename(file.place() + ": /").at(key).entries();
}

std::string text_at(const JsonReader& object, const std::string& key, std::string_view example) {
    if (!object.json().contains(key)) object.fail(fmt::format("key \"{}\" is missing; add \"{}\": {}", key, key, example));
    if (!object.json()[key].is_string()) object.fail(fmt::format("\"{}\" is no text; write \"{}\": {}", key, key, example));
    return object.json()[key].get<std::string>();
}

std::string number_text_at(const JsonReader& object, const std::string& key) {
    const Json& given = object.json()[key];
    if (!given.is_number() && !given.is_string()) {
        object.fail(fmt::format("\"{}\" is no number; write one, or a fraction such as \"1/107\"", key));
    }
    return given.is_string() ? given.get<std::string>() : given.dump();
}

PiQuantity parse_quantity_object(const JsonReader& value, const std::vector<std::string>& known) {
    if (!value.json().is_object()) value.fail(R"(not an object; write {"name": "v", "unit": "m/s"})");
    const std::string name = text_at(value, "name", "\"v\"");
    const JsonReader object = value.rename(fmt::format("{} ({})", value.place(), name)).object(known);
    const std::string unit = text_at(object, "unit", R"("m/s", or "1" for a plain number)");
    std::optional<std::string> number;
    if (object.json().contains("value")) number = number_text_at(object, "value");
    try {
        if (!number || !is_marked_uncertain(*number)) return make_pi_quantity(name, unit, number);
        const Uncertain measured = parse_uncertain(*number);
        PiQuantity quantity = make_pi_quantity(name, unit, fmt::format("{}", measured.value));
        quantity.uncertainty = *quantity.value * measured.relative();
        return quantity;
    } catch (const SimilitudeError& error) {
        object.fail(error.what());
    }
}

}  // namespace musim::scaling::detail
