#pragma once

#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "scaling/quantity_text.hpp"

namespace musim::scaling {

class JsonReader;

/// Where a value stands, for messages: "scene.json: /material/density"; "scene.json: /" is the whole text.
struct JsonPlace {
    std::string text;

    JsonPlace at(const std::string& key) const { return {text + (text.ends_with(": /") ? "" : "/") + key}; }
    JsonPlace at(std::size_t index) const { return at(std::to_string(index)); }
};

/// Kind that a value of a file has to be of.
enum class JsonKind { object, triple, truth, integer, number, text, quantity };

/// Rules by which the files of a room are read: its error, and where it has them, places, words and quantities of its own.
class JsonRules {
  public:
    using Json = nlohmann::ordered_json;

    virtual ~JsonRules() = default;

    /// Throws the room's error.
    virtual void raise(const std::string& message) const = 0;
    /// The place of what stands at a key of an object, and at a position of a list.
    virtual std::string at(const std::string& place, const std::string& key) const { return JsonPlace{place}.at(key).text; }
    virtual std::string at(const std::string& place, std::size_t index) const { return JsonPlace{place}.at(index).text; }
    /// Words after the place of a value of another kind; `range` names the integers that are taken.
    virtual std::string wrong_kind(const Json& value, JsonKind kind, const std::string& range) const;
    /// Words after the place of an object without a key.
    virtual std::string missing(const std::string& key) const;
    /// The message for a key that is none of the known.
    virtual std::string unknown(const std::string& place, const std::string& key, const std::vector<std::string>& known) const;
    /// SI value of a quantity, a number or text with a unit; `part` names the one of several that share a place.
    virtual double to_si(const JsonReader& value, Dimension dimension, std::string_view part) const;
    /// Is null a value, and "1/107" no number?
    virtual bool is_strict() const { return false; }
};

/// A value in a JSON file and its place for messages: the one way to read JSON that people write. Throws what its rules throw, `place: what
/// (why); what to do`. An object knows which keys were asked for.
class JsonReader {
  public:
    using Json = JsonRules::Json;

    /// `json` and `rules` must outlive this.
    JsonReader(const Json& json, const JsonRules& rules, std::string place) : json_(&json), rules_(&rules), place_(std::move(place)) {}

    const Json& json() const { return *json_; }
    const std::string& place() const { return place_; }

    /// The same value under another name in messages.
    JsonReader rename(std::string place) const { return {*json_, *rules_, std::move(place)}; }

    [[noreturn]] void fail(const std::string& what) const;
    [[noreturn]] void fail(const std::string& what, const std::string& what_to_do) const { fail(what + "; " + what_to_do); }
    /// Fails for a value of another kind.
    [[noreturn]] void refuse(JsonKind wanted, const std::string& range = "") const;

    /// The same value, which must be an object; one that has none but the known keys.
    JsonReader object() const;
    JsonReader object(const std::vector<std::string>& known) const;
    /// Fails for a key that nobody asked for.
    void refuse_unknown_keys() const { refuse_unknown_keys(used_); }

    bool has(const std::string& key) const;
    /// The value at a key. Fails when it is missing.
    JsonReader operator[](const std::string& key) const;
    /// The value at a key that is there, be it null.
    JsonReader at(const std::string& key) const { return {json_->at(key), *rules_, rules_->at(place_, key)}; }
    /// The entries of a list; of one that must have three; one that has the place of the whole list.
    std::vector<JsonReader> entries() const;
    std::vector<JsonReader> triple() const;
    JsonReader part(std::size_t index) const { return {json_->at(index), *rules_, place_}; }

    bool truth() const;
    std::int64_t integer(std::int64_t low, std::int64_t high) const;
    double number() const;
    std::string text() const;
    template <class Quantity>
    Quantity quantity(std::string_view part = "") const {
        return Quantity::from_value(rules_->to_si(*this, dimension_of<Quantity>(), part));
    }

    /// The value as a truth, number, text, quantity, or three of them.
    template <class Value>
    Value as() const {
        if constexpr (std::is_same_v<Value, bool>) {
            return truth();
        } else if constexpr (std::is_integral_v<Value>) {
            constexpr auto kHigh =
                std::numeric_limits<std::conditional_t<(sizeof(Value) < sizeof(std::int64_t)), Value, std::int64_t>>::max();
            return static_cast<Value>(integer(std::is_signed_v<Value> ? -std::int64_t{kHigh} : 0, kHigh));
        } else if constexpr (std::is_floating_point_v<Value>) {
            return number();
        } else if constexpr (std::is_same_v<Value, std::string>) {
            return text();
        } else if constexpr (requires { requires std::tuple_size<Value>::value == 3; }) {
            const std::vector<JsonReader> list = triple();
            using Entry = typename Value::value_type;
            return {list[0].as<Entry>(), list[1].as<Entry>(), list[2].as<Entry>()};
        } else {
            return quantity<Value>();
        }
    }
    template <class Value>
    Value get(const std::string& key) const {
        return (*this)[key].as<Value>();
    }
    /// Nothing when the key is missing.
    template <class Value>
    std::optional<Value> find(const std::string& key) const {
        return has(key) ? std::optional(get<Value>(key)) : std::nullopt;
    }
    /// Keeps `value` when the key is missing.
    template <class Value>
    void read(const std::string& key, Value& value) const {
        if (has(key)) value = get<Value>(key);
    }

  private:
    [[noreturn]] void raise(const std::string& message) const;
    void refuse_unknown_keys(const std::vector<std::string>& known) const;

    const Json* json_;
    const JsonRules* rules_;
    std::string place_;
    mutable std::vector<std::string> used_;  ///< keys that were asked for
};

}  // namespace musim::scaling
