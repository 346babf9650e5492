#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "records/error.hpp"
#include "records/processing.hpp"
#include "scaling/quantity_text.hpp"
#include "scaling/uncertain_reading.hpp"

namespace musim::records::detail {

/// What a plain number stands for where a quantity has a dimension: nothing, or SI as in files that musim writes.
enum class PlainNumbers { refused, are_si };

/// Parses JSON, in the order of its keys. Throws ReadError, `source: is no JSON (why); what_to_do`, also for numbers beyond doubles and for
/// absurdly deep nesting.
nlohmann::ordered_json parse_json(std::string_view text, const std::string& source, std::string_view what_to_do);

/// The fields of one JSON object in a file, with the place for messages. Knows which keys were asked for; all but has() and
/// refuse_unknown_keys() throw ReadError `place: what (why); what to do`.
class JsonFields {
  public:
    using Json = nlohmann::ordered_json;

    /// `object` must outlive this. `reading` takes values with uncertainties; without it they are refused. Throws when it is no object.
    JsonFields(const Json& object, std::string place, scaling::UncertainReading* reading = nullptr,
               PlainNumbers plain_numbers = PlainNumbers::refused);

    [[noreturn]] void fail(const std::string& what, const std::string& what_to_do) const;

    bool has(const char* key);
    const Json& operator[](const char* key) const { return object_[key]; }
    const std::string& place() const { return place_; }
    scaling::UncertainReading* reading() const { return reading_; }

    double number(const char* key, double fallback);
    int integer(const char* key, int fallback);
    bool truth(const char* key, bool fallback);
    std::string text(const char* key, const std::string& fallback);
    /// Which of two names; the first when it is not there.
    bool is_second(const char* key, std::string_view first, std::string_view second);
    TimeWindow window(const char* key);

    template <class Quantity>
    Quantity quantity(const char* key) {
        if (!has(key)) fail(std::string(key) + " is missing", "add it");
        return to_quantity<Quantity>(object_[key], key);
    }
    template <class Quantity>
    std::optional<Quantity> optional_quantity(const char* key) {
        return has(key) ? std::optional(to_quantity<Quantity>(object_[key], key)) : std::nullopt;
    }
    /// Text with a unit, or a number in SI units where these are taken, perhaps with a standard uncertainty (scaling/uncertain.hpp) where
    /// there is a reading; a plain number may be a fraction of two uncertain ones. `part` tells entries of a list apart.
    template <class Quantity>
    Quantity to_quantity(const Json& value, const char* key, std::string_view part = "") const {
        return Quantity::from_value(to_si(value, key, part, scaling::dimension_of<Quantity>()));
    }

    /// Throws where the value at a key, if it is there, has an uncertainty: `why` it makes no sense.
    void refuse_uncertainty(const char* key, std::string_view why) const;

    /// Throws for a key that nobody asked for.
    void refuse_unknown_keys() const;

  private:
    double to_si(const Json& value, const char* key, std::string_view part, scaling::Dimension dimension) const;
    double take_uncertain(const std::string& text, const char* key, std::string_view part, scaling::Dimension dimension) const;

    const Json& object_;
    std::string place_;
    scaling::UncertainReading* reading_;
    PlainNumbers plain_numbers_;
    std::vector<std::string> used_;
};

}  // namespace musim::records::detail
