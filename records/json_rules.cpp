#include "records/json_rules.hpp"

#include <fmt/format.h>

#include "records/error.hpp"
#include "scaling/json_text.hpp"
#include "scaling/nearest_name.hpp"
#include "scaling/shorten.hpp"
#include "scaling/uncertain.hpp"

namespace musim::records::detail {

Json parse_json(std::string_view text, const std::string& source, std::string_view what_to_do) {
    try {
        return scaling::parse_json_text<Json>(text);
    } catch (const scaling::ParseError& error) {
        throw ReadError(fmt::format("{}: is no JSON ({}); {}", source, error.what(), what_to_do));
    }
}

Json parse_object(std::string_view text, const std::string& source, std::string_view schema, std::string_view what,
                  std::string_view example) {
    Json object = parse_json(text, source, fmt::format(R"(write {{"schema": "{}", {}}})", schema, example));
    if (!object.is_object() || !object.contains("schema") || object["schema"] != schema) {
        throw ReadError(fmt::format("{}: is no {}; add \"schema\": \"{}\"", source, what, schema));
    }
    object.erase("schema");
    return object;
}

void JsonRules::raise(const std::string& message) const { throw ReadError(message); }

std::string JsonRules::at(const std::string& place, const std::string& key) const { return fmt::format("{}: {}", place, key); }

std::string JsonRules::at(const std::string& place, std::size_t index) const { return fmt::format("{} {}", place, index + 1); }

std::string JsonRules::wrong_kind(const Json& value, scaling::JsonKind kind, const std::string& /*range*/) const {
    using Kind = scaling::JsonKind;
    if (kind == Kind::object) return ": is no object; write {\"KEY\": VALUE, ...}";
    if (kind == Kind::triple) return " is no list of three values; write [A, B, C]";
    if (kind == Kind::truth) return " is neither true nor false; write one of them, without quotes";
    if (kind == Kind::integer && value.is_number_integer()) return " is beyond all counts; correct it";
    if (kind == Kind::integer) return " is no whole number; write one, without quotes";
    if (kind == Kind::number) return " is no number; write one, without quotes";
    if (kind == Kind::text) return " is no text; write it in quotes";
    return " is no quantity; write text with a unit, such as \"0.05 Hz\"";
}

std::string JsonRules::missing(const std::string& key) const { return fmt::format(": {} is missing; add it", key); }

std::string JsonRules::unknown(const std::string& place, const std::string& key, const std::vector<std::string>& known) const {
    const std::string nearest = scaling::find_nearest_name(key, known);
    return fmt::format("{}: \"{}\" is none of its settings; {}", place, scaling::shorten(key, scaling::kEchoed),
                       nearest.empty() ? "remove it, or correct its name" : fmt::format("did you mean \"{}\"?", nearest));
}

double JsonRules::to_si(const scaling::JsonReader& value, scaling::Dimension dimension, std::string_view part) const {
    const Json& json = value.json();
    const bool takes_number = plain_numbers_ == PlainNumbers::are_si || dimension == scaling::Dimension{};
    if (json.is_number() && takes_number) return json.get<double>();
    if (json.is_number()) {
        value.fail(fmt::format("{}: {}", scaling::shorten(json.dump(), scaling::kEchoed), scaling::refuse_plain_number(dimension)));
    }
    if (!json.is_string()) value.refuse(scaling::JsonKind::quantity);
    try {
        const auto text = json.get<std::string>();
        if (scaling::is_marked_uncertain(text)) return take_uncertain(value, dimension, part);
        return takes_number ? scaling::parse_si(text, dimension) : scaling::parse_si_with_unit(text, dimension);
    } catch (const scaling::ParseError& error) {
        value.fail(error.what());
    }
}

namespace {

[[noreturn]] void refuse_uncertain(const scaling::JsonReader& value, std::string_view why) {
    throw ReadError(fmt::format("{} is \"{}\" (+/- makes no sense here: {}); give the value alone", value.place(), value.text(), why));
}

}  // namespace

double JsonRules::take_uncertain(const scaling::JsonReader& value, scaling::Dimension dimension, std::string_view part) const {
    if (reading_ == nullptr) refuse_uncertain(value, "values alone are used");
    const std::string text = value.text(), name = fmt::format("{}{}{}", value.place(), part.empty() ? "" : " ", part);
    const bool is_fraction_of_two = dimension == scaling::Dimension{} && text.find('(') != std::string::npos;
    if (!is_fraction_of_two) return reading_->take(name, scaling::parse_uncertain_si(text, dimension), dimension);
    const scaling::UncertainRatio ratio = scaling::parse_uncertain_ratio(text);
    if (!ratio.denominator) return reading_->take(name, ratio.numerator);
    return reading_->take(name + ", above", ratio.numerator) / reading_->take(name + ", below", *ratio.denominator);
}

void require_angle_unit(const scaling::JsonReader& fields, const std::string& key, std::string_view example) {
    const scaling::JsonReader value = fields[key];
    const std::string text = value.json().is_string() ? value.text() : value.json().dump();
    if (text.find("rad") != std::string::npos || text.find("deg") != std::string::npos) return;
    fields.fail(fmt::format("{} is {} (neither in rad nor in deg)", key, scaling::shorten(text, scaling::kEchoed)),
                fmt::format("write text such as \"{}\"", example));
}

void refuse_uncertainty(const scaling::JsonReader& fields, const std::string& key, std::string_view why) {
    if (!fields.json().contains(key)) return;
    const scaling::JsonReader value = fields[key];
    if (value.json().is_string() && scaling::is_marked_uncertain(value.text())) refuse_uncertain(value, why);
}

}  // namespace musim::records::detail
