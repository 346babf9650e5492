#include "scaling/pi_problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace musim::scaling {

namespace {

using nlohmann::json;

[[noreturn]] void fail(std::string_view where, std::string_view message) { throw PiError(fmt::format("{}: {}", where, message)); }

/// Throws for a key that is none of the known.
void refuse_unknown_keys(const json& object, std::initializer_list<std::string_view> known, std::string_view where) {
    for (const auto& [key, value] : object.items()) {
        if (std::find(known.begin(), known.end(), key) != known.end()) continue;
        fail(where, fmt::format("unknown key {}; known are {}", json(key).dump(), fmt::join(known, ", ")));
    }
}

const std::string& text_at(const json& object, const char* key, std::string_view where, std::string_view example) {
    if (!object.contains(key)) fail(where, fmt::format("key \"{}\" is missing; add \"{}\": {}", key, key, example));
    if (!object[key].is_string()) fail(where, fmt::format("\"{}\" is no text; write \"{}\": {}", key, key, example));
    return object[key].get_ref<const std::string&>();
}

PiQuantity parse_quantity_object(const json& object, const std::string& where) {
    if (!object.is_object()) fail(where, R"(not an object; write {"name": "v", "unit": "m/s"})");
    const std::string& name = text_at(object, "name", where, "\"v\"");
    const std::string here = fmt::format("{} ({})", where, name);
    refuse_unknown_keys(object, {"name", "unit", "value"}, here);
    const std::string& unit = text_at(object, "unit", here, R"("m/s", or "1" for a plain number)");
    std::optional<std::string> value;
    if (object.contains("value")) {
        const json& given = object["value"];
        if (!given.is_number() && !given.is_string()) fail(here, "\"value\" is no number; write one, or a fraction such as \"1/107\"");
        value = given.is_string() ? given.get<std::string>() : given.dump();
    }
    try {
        return make_pi_quantity(name, unit, value);
    } catch (const SimilitudeError& error) {
        fail(here, error.what());
    }
}

json parse_json(std::string_view text, std::string_view origin) {
    try {
        return json::parse(text);
    } catch (const json::exception& error) {
        // "[json.exception.parse_error.101] parse error at line 1, column 2: ..."
        const std::string_view message = error.what();
        const std::size_t bracket = message.find("] ");
        fail(origin, fmt::format("{}; correct the JSON", message.substr(bracket == std::string_view::npos ? 0 : bracket + 2)));
    }
}

}  // namespace

std::vector<PiQuantity> parse_pi_problem(std::string_view text, std::string_view origin) {
    const json problem = parse_json(text, origin);
    constexpr std::string_view kExample = R"({"quantities": [{"name": "v", "unit": "m/s"}, ...]})";
    if (!problem.is_object()) fail(origin, fmt::format("not an object; write {}", kExample));
    refuse_unknown_keys(problem, {"quantities"}, origin);
    if (!problem.contains("quantities") || !problem["quantities"].is_array()) {
        fail(origin, fmt::format("no list of \"quantities\"; write {}", kExample));
    }
    std::vector<PiQuantity> quantities;
    for (const json& object : problem["quantities"]) {
        quantities.push_back(parse_quantity_object(object, fmt::format("{}: /quantities/{}", origin, quantities.size())));
    }
    try {
        check_quantities(quantities);
    } catch (const PiError& error) {
        fail(origin, error.what());
    }
    return quantities;
}

}  // namespace musim::scaling
