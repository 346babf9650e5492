#include "records/detail/json_fields.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scaling/json_text.hpp"
#include "scaling/nearest_name.hpp"
#include "scaling/shorten.hpp"
#include "scaling/uncertain.hpp"

namespace musim::records::detail {

nlohmann::ordered_json parse_json(std::string_view text, const std::string& source, std::string_view what_to_do) {
    try {
        return scaling::parse_json_text<nlohmann::ordered_json>(text);
    } catch (const scaling::ParseError& error) {
        throw ReadError(fmt::format("{}: is no JSON ({}); {}", source, error.what(), what_to_do));
    }
}

JsonFields::JsonFields(const Json& object, std::string place, scaling::UncertainReading* reading, PlainNumbers plain_numbers)
    : object_(object), place_(std::move(place)), reading_(reading), plain_numbers_(plain_numbers) {
    if (!object.is_object()) fail("is no object", "write {\"KEY\": VALUE, ...}");
}

void JsonFields::fail(const std::string& what, const std::string& what_to_do) const {
    throw ReadError(fmt::format("{}: {}; {}", place_, what, what_to_do));
}

bool JsonFields::has(const char* key) {
    used_.emplace_back(key);
    return object_.contains(key);
}

double JsonFields::number(const char* key, double fallback) {
    if (!has(key)) return fallback;
    if (!object_[key].is_number()) fail(fmt::format("{} is no number", key), "write one, without quotes");
    return object_[key].get<double>();
}

int JsonFields::integer(const char* key, int fallback) {
    if (!has(key)) return fallback;
    if (!object_[key].is_number_integer()) fail(fmt::format("{} is no whole number", key), "write one, without quotes");
    return object_[key].get<int>();
}

bool JsonFields::truth(const char* key, bool fallback) {
    if (!has(key)) return fallback;
    if (!object_[key].is_boolean()) fail(fmt::format("{} is neither true nor false", key), "write one of them, without quotes");
    return object_[key].get<bool>();
}

std::string JsonFields::text(const char* key, const std::string& fallback) {
    if (!has(key)) return fallback;
    if (!object_[key].is_string()) fail(fmt::format("{} is no text", key), "write it in quotes");
    return object_[key].get<std::string>();
}

bool JsonFields::is_second(const char* key, std::string_view first, std::string_view second) {
    if (!has(key)) return false;
    const std::string name = object_[key].is_string() ? object_[key].get<std::string>() : std::string();
    if (name != first && name != second) fail(fmt::format("{} is neither \"{}\" nor \"{}\"", key, first, second), "write one of them");
    return name == second;
}

TimeWindow JsonFields::window(const char* key) {
    if (!has(key) || !object_[key].is_array() || object_[key].size() != 2) {
        fail(fmt::format("{} is no pair of times", key), "write [\"10 s\", \"40 s\"]");
    }
    return {to_quantity<scaling::Time>(object_[key][0], key), to_quantity<scaling::Time>(object_[key][1], key)};
}

void JsonFields::refuse_uncertainty(const char* key, std::string_view why) const {
    if (!object_.contains(key) || !object_[key].is_string()) return;
    const auto text = object_[key].get<std::string>();
    if (!scaling::is_marked_uncertain(text)) return;
    fail(fmt::format("{} is \"{}\" (+/- makes no sense here: {})", key, text, why), "give the value alone");
}

double JsonFields::to_si(const Json& value, const char* key, std::string_view part, scaling::Dimension dimension) const {
    const bool takes_number = plain_numbers_ == PlainNumbers::are_si || dimension == scaling::Dimension{};
    if (value.is_number() && takes_number) return value.get<double>();
    if (value.is_number())
        throw ReadError(fmt::format("{}: {}: {}: {}", place_, key, scaling::shorten(value.dump(), scaling::kEchoed),
                                    scaling::refuse_plain_number(dimension)));
    if (!value.is_string()) fail(fmt::format("{} is no quantity", key), "write text with a unit, such as \"0.05 Hz\"");
    try {
        const auto text = value.get<std::string>();
        if (scaling::is_marked_uncertain(text)) return take_uncertain(text, key, part, dimension);
        return takes_number ? scaling::parse_si(text, dimension) : scaling::parse_si_with_unit(text, dimension);
    } catch (const scaling::ParseError& error) {
        throw ReadError(fmt::format("{}: {}: {}", place_, key, error.what()));
    }
}

double JsonFields::take_uncertain(const std::string& text, const char* key, std::string_view part, scaling::Dimension dimension) const {
    if (reading_ == nullptr) {
        fail(fmt::format("{} is \"{}\" (+/- makes no sense here: values alone are used)", key, text), "give the value alone");
    }
    const std::string name = fmt::format("{}: {}{}{}", place_, key, part.empty() ? "" : " ", part);
    const bool is_fraction_of_two = dimension == scaling::Dimension{} && text.find('(') != std::string::npos;
    if (!is_fraction_of_two) return reading_->take(name, scaling::parse_uncertain_si(text, dimension), dimension);
    const scaling::UncertainRatio ratio = scaling::parse_uncertain_ratio(text);
    if (!ratio.denominator) return reading_->take(name, ratio.numerator);
    return reading_->take(name + ", above", ratio.numerator) / reading_->take(name + ", below", *ratio.denominator);
}

void JsonFields::refuse_unknown_keys() const {
    for (const auto& [key, value] : object_.items()) {
        const std::string& name = key;
        if (std::find(used_.begin(), used_.end(), name) == used_.end()) {
            const std::string nearest = scaling::find_nearest_name(name, used_);
            fail(fmt::format("\"{}\" is none of its settings", scaling::shorten(name, scaling::kEchoed)),
                 nearest.empty() ? "remove it, or correct its name" : fmt::format("did you mean \"{}\"?", nearest));
        }
    }
}

}  // namespace musim::records::detail
