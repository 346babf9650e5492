#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lsdem/scene/material_presets.hpp"
#include "scaling/quantity_text.hpp"

namespace musim::lsdem::scene::detail {

/// Where a value stands, for messages.
struct JsonPlace {
    std::string origin;                   ///< file
    std::string path;                     ///< JSON path, "/material/density"; empty for the whole text
    std::string* plain_number = nullptr;  ///< takes the path of the first quantity that is a number without a unit, where that is asked

    JsonPlace at(const std::string& key) const { return {origin, path + "/" + key, plain_number}; }
    JsonPlace at(std::size_t index) const { return at(std::to_string(index)); }
};

/// Throws SceneError "origin: /path: message".
[[noreturn]] void fail(const JsonPlace& place, const std::string& message);

/// Number, or text with a number or fraction. Throws SceneError.
double to_number(const nlohmann::json& value, const JsonPlace& place);

/// SI number, or text with a unit of the wanted dimension. Throws SceneError.
double to_si(const nlohmann::json& value, const JsonPlace& place, scaling::Dimension wanted);

/// Text. Throws SceneError.
std::string to_text(const nlohmann::json& value, const JsonPlace& place);

/// True or false. Throws SceneError.
bool to_bool(const nlohmann::json& value, const JsonPlace& place);

/// Whole number from `low` to `high`. Throws SceneError.
std::int64_t to_integer(const nlohmann::json& value, const JsonPlace& place, std::int64_t low, std::int64_t high);

/// Quantity of a given type.
template <class Quantity>
Quantity to_quantity(const nlohmann::json& value, const JsonPlace& place) {
    return Quantity::from_value(to_si(value, place, scaling::dimension_of<Quantity>()));
}

/// A JSON array of three values. Throws SceneError.
const nlohmann::json& require_triple(const nlohmann::json& value, const JsonPlace& place);

/// Three quantities of a given type.
template <class Quantity>
Triple<Quantity> to_triple(const nlohmann::json& value, const JsonPlace& place) {
    require_triple(value, place);
    return {to_quantity<Quantity>(value[0], place.at(0)), to_quantity<Quantity>(value[1], place.at(1)),
            to_quantity<Quantity>(value[2], place.at(2))};
}

/// An object whose keys are all of a known kind (scene_keys). Throws SceneError on construction for anything else.
class JsonObject {
  public:
    JsonObject(const nlohmann::json& value, JsonPlace place, const std::string& kind);

    const JsonPlace& place() const { return place_; }
    JsonPlace place(const std::string& key) const { return place_.at(key); }

    /// The key is there and not null.
    bool has(const std::string& key) const;
    /// Value of a key. Throws SceneError when it is missing.
    const nlohmann::json& get(const std::string& key) const;

    template <class Quantity>
    Quantity quantity(const std::string& key) const {
        return to_quantity<Quantity>(get(key), place(key));
    }
    template <class Quantity>
    std::optional<Quantity> optional_quantity(const std::string& key) const {
        return has(key) ? std::optional(quantity<Quantity>(key)) : std::nullopt;
    }
    template <class Quantity>
    Triple<Quantity> triple(const std::string& key) const {
        return to_triple<Quantity>(get(key), place(key));
    }
    std::string text(const std::string& key) const { return to_text(get(key), place(key)); }
    double number(const std::string& key) const { return to_number(get(key), place(key)); }

    /// Keeps `value` when the key is missing.
    void read(const std::string& key, double& value) const;
    void read(const std::string& key, bool& value) const;
    void read(const std::string& key, int& value) const;
    void read(const std::string& key, std::uint64_t& value) const;
    void read(const std::string& key, std::string& value) const;
    template <class Quantity>
    void read_quantity(const std::string& key, Quantity& value) const {
        if (has(key)) value = quantity<Quantity>(key);
    }

    /// Position in `names` of the text at `key`. Throws SceneError for any other text.
    std::size_t choice(const std::string& key, const std::vector<std::string>& names) const;

  private:
    const nlohmann::json& value_;
    JsonPlace place_;
};

}  // namespace musim::lsdem::scene::detail
