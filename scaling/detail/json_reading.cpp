#include "scaling/detail/json_reading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "scaling/json_text.hpp"
#include "scaling/nearest_name.hpp"
#include "scaling/shorten.hpp"
#include "scaling/uncertain.hpp"

namespace musim::scaling::detail {

void fail_at(std::string_view where, std::string_view message) { throw PiError(fmt::format("{}: {}", where, message)); }

Json parse_json(std::string_view text, std::string_view origin) {
    try {
        return parse_json_text(text);
    } catch (const ParseError& error) {
        fail_at(origin, fmt::format("{}; correct the JSON", error.what()));
    }
}

void refuse_unknown_keys(const Json& object, std::initializer_list<std::string_view> known, std::string_view where) {
    for (const auto& [key, value] : object.items()) {
        if (std::find(known.begin(), known.end(), key) != known.end()) continue;
        fail_at(where,
                fmt::format("unknown key {}; {}", shorten(Json(key).dump(), kEchoed), suggest_name(key, {known.begin(), known.end()})));
    }
}

const std::string& text_at(const Json& object, const char* key, std::string_view where, std::string_view example) {
    if (!object.contains(key)) fail_at(where, fmt::format("key \"{}\" is missing; add \"{}\": {}", key, key, example));
    if (!object[key].is_string()) fail_at(where, fmt::format("\"{}\" is no text; write \"{}\": {}", key, key, example));
    return object[key].get_ref<const std::string&>();
}

std::string number_text_at(const Json& object, const char* key, std::string_view where) {
    const Json& given = object[key];
    if (!given.is_number() && !given.is_string()) {
        fail_at(where, fmt::format("\"{}\" is no number; write one, or a fraction such as \"1/107\"", key));
    }
    return given.is_string() ? given.get<std::string>() : given.dump();
}

PiQuantity parse_quantity_object(const Json& object, const std::string& where, std::initializer_list<std::string_view> known) {
    if (!object.is_object()) fail_at(where, R"(not an object; write {"name": "v", "unit": "m/s"})");
    const std::string& name = text_at(object, "name", where, "\"v\"");
    const std::string here = fmt::format("{} ({})", where, name);
    refuse_unknown_keys(object, known, here);
    const std::string& unit = text_at(object, "unit", here, R"("m/s", or "1" for a plain number)");
    std::optional<std::string> value;
    if (object.contains("value")) value = number_text_at(object, "value", here);
    try {
        if (!value || !is_marked_uncertain(*value)) return make_pi_quantity(name, unit, value);
        const Uncertain measured = parse_uncertain(*value);
        PiQuantity quantity = make_pi_quantity(name, unit, fmt::format("{}", measured.value));
        quantity.uncertainty = *quantity.value * measured.relative();
        return quantity;
    } catch (const SimilitudeError& error) {
        fail_at(here, error.what());
    }
}

}  // namespace musim::scaling::detail
