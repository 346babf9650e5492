#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scaling/json_reader.hpp"
#include "scaling/uncertainty/uncertain_reading.hpp"

namespace musim::records::detail {

using Json = scaling::JsonReader::Json;

/// Meaning of a plain number where a quantity has a dimension: nothing, or SI as in files that musim writes.
enum class PlainNumbers { refused, are_si };

/// Parses JSON, in the order of its keys. Throws ReadError, `source: is no JSON (why); what_to_do`, also for numbers beyond doubles and for
/// absurdly deep nesting.
Json parse_json(std::string_view text, const std::string& source, std::string_view what_to_do);

/// Parses an object whose "schema" is `schema`. What it is ("design") and an example of its other
/// fields go into messages.
Json parse_object(std::string_view text, const std::string& source, std::string_view schema, std::string_view what,
                  std::string_view example);

/// Files about records, tables and designs: ReadError. Quantities are text with a unit, or numbers in SI units where these are taken,
/// perhaps with a standard uncertainty (scaling/uncertain.hpp) where there is a reading; a plain number may be a fraction of two uncertain
/// ones.
class JsonRules final : public scaling::JsonRules {
  public:
    explicit JsonRules(scaling::UncertainReading* reading = nullptr, PlainNumbers plain_numbers = PlainNumbers::refused)
        : reading_(reading), plain_numbers_(plain_numbers) {}

    void raise(const std::string& message) const override;
    std::string at(const std::string& place, const std::string& key) const override;
    std::string at(const std::string& place, std::size_t index) const override;
    std::string wrong_kind(const Json& value, scaling::JsonKind kind, const std::string& range) const override;
    std::string missing(const std::string& key) const override;
    std::string unknown(const std::string& place, const std::string& key, const std::vector<std::string>& known) const override;
    double to_si(const scaling::JsonReader& value, scaling::Dimension dimension, std::string_view part) const override;
    bool is_strict() const override { return true; }

  private:
    double take_uncertain(const scaling::JsonReader& value, scaling::Dimension dimension, std::string_view part) const;

    scaling::UncertainReading* reading_;
    PlainNumbers plain_numbers_;
};

/// A quantity above zero, where it is given.
template <class Quantity>
std::optional<Quantity> read_positive(const scaling::JsonReader& fields, const std::string& key,
                                      const std::string& what_to_do = "correct it, or remove it where it is not known") {
    auto value = fields.find<Quantity>(key);
    if (value && !(value->value() > 0.0 && std::isfinite(value->value()))) fields.fail(key + " is not above zero", what_to_do);
    return value;
}

template <class Quantity>
Quantity require_positive(const scaling::JsonReader& fields, const std::string& key,
                          const std::string& what_to_do = "correct it, or remove it where it is not known") {
    if (!fields.has(key)) fields.fail(key + " is missing", "add it");
    return *read_positive<Quantity>(fields, key, what_to_do);
}

/// Throws where the value at a key is neither in rad nor in deg: angles and their derivatives are plain numbers and powers of time, whose
/// unit is easily forgotten.
void require_angle_unit(const scaling::JsonReader& fields, const std::string& key, std::string_view example);

/// An angle or a derivative of one above zero, where it is given, with its unit.
template <class Quantity>
std::optional<Quantity> read_turn(const scaling::JsonReader& fields, const std::string& key, std::string_view example,
                                  const std::string& what_to_do = "correct it, or remove it where it is not known") {
    if (!fields.has(key)) return std::nullopt;
    require_angle_unit(fields, key, example);
    return read_positive<Quantity>(fields, key, what_to_do);
}

/// Throws where the value at a key, if it is there, has an uncertainty: `why` it makes no sense.
void refuse_uncertainty(const scaling::JsonReader& fields, const std::string& key, std::string_view why);

}  // namespace musim::records::detail
