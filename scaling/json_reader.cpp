#include "scaling/json_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scaling/nearest_name.hpp"
#include "scaling/number.hpp"

namespace musim::scaling {

std::string JsonRules::wrong_kind(const Json& value, JsonKind kind, const std::string& range) const {
    std::string wanted = "an SI number or a text with its unit";
    if (kind == JsonKind::object) wanted = "an object { ... }";
    if (kind == JsonKind::triple) wanted = "a list of three values";
    if (kind == JsonKind::truth) wanted = "true or false";
    if (kind == JsonKind::integer) wanted = fmt::format("a whole number {}", range);
    if (kind == JsonKind::number) wanted = "a number or a fraction such as \"1/107\"";
    if (kind == JsonKind::text) wanted = "a text";
    std::string found = value.type_name();
    if (value.is_primitive() && !value.is_null()) found += fmt::format(" {}", value.dump());
    return fmt::format(": {} found ({} is wanted); correct the value", found, wanted);
}

std::string JsonRules::missing(const std::string& key) const { return fmt::format(": key \"{}\" is missing; add it", key); }

std::string JsonRules::unknown(const std::string& place, const std::string& key, const std::vector<std::string>& known) const {
    return fmt::format("{}: unknown key \"{}\"; {}", at(place, key), key, suggest_name(key, known));
}

double JsonRules::to_si(const JsonReader& value, Dimension dimension, std::string_view /*part*/) const {
    if (value.json().is_number()) return value.json().get<double>();
    if (!value.json().is_string()) value.refuse(JsonKind::quantity);
    try {
        return parse_si(value.text(), dimension);
    } catch (const ParseError& error) {
        value.fail(error.what());
    }
}

void JsonReader::raise(const std::string& message) const {
    rules_->raise(message);
    throw Error(message);  // compilers do not see that a virtual function never returns
}

void JsonReader::fail(const std::string& what) const { raise(fmt::format("{}: {}", place_, what)); }

void JsonReader::refuse(JsonKind wanted, const std::string& range) const { raise(place_ + rules_->wrong_kind(*json_, wanted, range)); }

JsonReader JsonReader::object() const {
    if (!json_->is_object()) refuse(JsonKind::object);
    return {*json_, *rules_, place_};
}

JsonReader JsonReader::object(const std::vector<std::string>& known) const {
    JsonReader object = this->object();
    object.refuse_unknown_keys(known);
    return object;
}

void JsonReader::refuse_unknown_keys(const std::vector<std::string>& known) const {
    for (const auto& [key, value] : json_->items()) {
        if (std::find(known.begin(), known.end(), key) == known.end()) raise(rules_->unknown(place_, key, known));
    }
}

bool JsonReader::has(const std::string& key) const {
    used_.push_back(key);
    return json_->contains(key) && (rules_->is_strict() || !json_->at(key).is_null());
}

JsonReader JsonReader::operator[](const std::string& key) const {
    if (!has(key)) raise(place_ + rules_->missing(key));
    return at(key);
}

std::vector<JsonReader> JsonReader::entries() const {
    std::vector<JsonReader> entries;
    for (const Json& entry : *json_) entries.emplace_back(entry, *rules_, rules_->at(place_, entries.size()));
    return entries;
}

std::vector<JsonReader> JsonReader::triple() const {
    if (!json_->is_array() || json_->size() != 3) refuse(JsonKind::triple);
    return entries();
}

bool JsonReader::truth() const {
    if (!json_->is_boolean()) refuse(JsonKind::truth);
    return json_->get<bool>();
}

std::int64_t JsonReader::integer(std::int64_t low, std::int64_t high) const {
    // beyond the range of signed integers only when unsigned
    const bool is_beyond = json_->is_number_unsigned() && json_->get<std::uint64_t>() > static_cast<std::uint64_t>(high);
    if (!json_->is_number_integer() || is_beyond || json_->get<std::int64_t>() < low || json_->get<std::int64_t>() > high) {
        refuse(JsonKind::integer, fmt::format("from {} to {}", low, high));
    }
    return json_->get<std::int64_t>();
}

double JsonReader::number() const {
    if (json_->is_number()) return json_->get<double>();
    if (!json_->is_string() || rules_->is_strict()) refuse(JsonKind::number);
    try {
        return parse_number(json_->get_ref<const std::string&>());
    } catch (const ParseError& error) {
        fail(error.what());
    }
}

std::string JsonReader::text() const {
    if (!json_->is_string()) refuse(JsonKind::text);
    return json_->get<std::string>();
}

}  // namespace musim::scaling
