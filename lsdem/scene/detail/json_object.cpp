#include "lsdem/scene/detail/json_object.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lsdem/scene/detail/json_text.hpp"
#include "lsdem/scene/scene_error.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "scaling/error.hpp"
#include "scaling/nearest_name.hpp"
#include "scaling/number.hpp"

namespace musim::lsdem::scene::detail {

namespace {

std::string type_name(const nlohmann::json& value) {
    return value.is_null() ? "null" : fmt::format("{} {}", value.type_name(), value.is_structured() ? "" : value.dump());
}

[[noreturn]] void fail_type(const JsonPlace& place, const nlohmann::json& value, const std::string& wanted) {
    std::string found = type_name(value);
    while (!found.empty() && found.back() == ' ') found.pop_back();
    fail(place, fmt::format("{} found ({} is wanted); correct the value", found, wanted));
}

/// Runs a parser of the scaling module and puts the place in front of its message.
template <class Parse>
double parse_at(const JsonPlace& place, const Parse& parse) {
    try {
        return parse();
    } catch (const scaling::ParseError& error) {
        fail(place, error.what());
    }
}

}  // namespace

void fail(const JsonPlace& place, const std::string& message) {
    throw SceneError(fmt::format("{}: {}: {}", place.origin, place.path.empty() ? "/" : place.path, message));
}

double to_number(const nlohmann::json& value, const JsonPlace& place) {
    if (value.is_number()) return value.get<double>();
    if (!value.is_string()) fail_type(place, value, "a number or a fraction such as \"1/107\"");
    return parse_at(place, [&] { return scaling::parse_number(value.get_ref<const std::string&>()); });
}

double to_si(const nlohmann::json& value, const JsonPlace& place, scaling::Dimension wanted) {
    if (value.is_number()) {
        // zero is the same in every unit
        if (place.plain_number != nullptr && place.plain_number->empty() && value != 0) *place.plain_number = place.path;
        return value.get<double>();
    }
    if (!value.is_string()) fail_type(place, value, "an SI number or a text with its unit");
    return parse_at(place, [&] { return scaling::parse_si(value.get_ref<const std::string&>(), wanted); });
}

std::string to_text(const nlohmann::json& value, const JsonPlace& place) {
    if (!value.is_string()) fail_type(place, value, "a text");
    return value.get<std::string>();
}

bool to_bool(const nlohmann::json& value, const JsonPlace& place) {
    if (!value.is_boolean()) fail_type(place, value, "true or false");
    return value.get<bool>();
}

std::int64_t to_integer(const nlohmann::json& value, const JsonPlace& place, std::int64_t low, std::int64_t high) {
    const std::string wanted = fmt::format("a whole number from {} to {}", low, high);
    if (!value.is_number_integer()) fail_type(place, value, wanted);
    // beyond the range of signed integers only when unsigned
    const bool in_range = value.is_number_unsigned() ? value.get<std::uint64_t>() <= static_cast<std::uint64_t>(high) : true;
    if (!in_range || value.get<std::int64_t>() < low || value.get<std::int64_t>() > high) fail_type(place, value, wanted);
    return value.get<std::int64_t>();
}

const nlohmann::json& require_triple(const nlohmann::json& value, const JsonPlace& place) {
    if (!value.is_array() || value.size() != 3) fail_type(place, value, "a list of three values");
    return value;
}

JsonObject::JsonObject(const nlohmann::json& value, JsonPlace place, const std::string& kind) : value_(value), place_(std::move(place)) {
    if (!value.is_object()) fail_type(place_, value, "an object { ... }");
    const std::vector<std::string>& known = scene_keys().at(kind);
    for (const auto& [key, unused] : value.items()) {
        if (std::find(known.begin(), known.end(), key) == known.end()) {
            fail(place_.at(key), fmt::format("unknown key \"{}\"; {}", key, scaling::suggest_name(key, known)));
        }
    }
}

bool JsonObject::has(const std::string& key) const { return value_.contains(key) && !value_.at(key).is_null(); }

const nlohmann::json& JsonObject::get(const std::string& key) const {
    if (!has(key)) fail(place_, fmt::format("key \"{}\" is missing; add it", key));
    return value_.at(key);
}

void JsonObject::read(const std::string& key, double& value) const {
    if (has(key)) value = number(key);
}

void JsonObject::read(const std::string& key, bool& value) const {
    if (has(key)) value = to_bool(get(key), place(key));
}

void JsonObject::read(const std::string& key, int& value) const {
    constexpr int kLargest = std::numeric_limits<int>::max();
    if (has(key)) value = static_cast<int>(to_integer(get(key), place(key), -kLargest, kLargest));
}

void JsonObject::read(const std::string& key, std::uint64_t& value) const {
    if (has(key)) value = static_cast<std::uint64_t>(to_integer(get(key), place(key), 0, std::numeric_limits<std::int64_t>::max()));
}

void JsonObject::read(const std::string& key, std::string& value) const {
    if (has(key)) value = text(key);
}

std::size_t JsonObject::choice(const std::string& key, const std::vector<std::string>& names) const {
    const std::string name = text(key);
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
        fail(place(key), fmt::format("\"{}\" is not known{}; use one of {}", name, scaling::hint_at_name(name, names), join(names)));
    }
    return static_cast<std::size_t>(found - names.begin());
}

}  // namespace musim::lsdem::scene::detail
