#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "records/design/design.hpp"
#include "records/detail/json_fields.hpp"

/// Readers that files about prototypes, materials and models share. All throw ReadError `place: what (why); what to do`.
namespace musim::design::detail {

using records::detail::JsonFields;
using Json = JsonFields::Json;
using Block = std::array<scaling::Length, 3>;

/// The object of a file whose "schema" is `schema`, without that field. What it is ("design") and an example of its other fields go into
/// messages.
Json parse_object(std::string_view json, const std::string& source, std::string_view schema, std::string_view what,
                  std::string_view example);

/// A quantity above zero, where it is given.
template <class Quantity>
std::optional<Quantity> read_positive(JsonFields& fields, const char* key) {
    auto value = fields.optional_quantity<Quantity>(key);
    if (value && !(value->value() > 0.0 && std::isfinite(value->value()))) {
        fields.fail(fmt::format("{} is not above zero", key), "correct it, or remove it where it is not known");
    }
    return value;
}

/// A quantity of zero or more, where it is given.
template <class Quantity>
std::optional<Quantity> read_not_negative(JsonFields& fields, const char* key) {
    auto value = fields.optional_quantity<Quantity>(key);
    if (value && !(value->value() >= 0.0 && std::isfinite(value->value()))) {
        fields.fail(fmt::format("{} is below zero", key), "correct it, or remove it where it is not known");
    }
    return value;
}

template <class Quantity>
Quantity require_positive(JsonFields& fields, const char* key) {
    const auto value = read_positive<Quantity>(fields, key);
    if (!value) fields.fail(fmt::format("{} is missing", key), "add it");
    return *value;
}

/// A plain number above zero, where it is given.
std::optional<double> read_number(JsonFields& fields, const char* key);

std::string require_text(JsonFields& fields, const char* key);

/// A list that is not empty; `example` goes into the message.
const Json& require_list(JsonFields& fields, const char* key, const std::string& example);

/// The texts of such a list.
std::vector<std::string> read_names(JsonFields& fields, const char* key, const std::string& example);

/// Three lengths above zero: b, w, H.
Block require_block(JsonFields& fields, const char* key);

/// E = k H/A of a face stiffness k, or the modulus itself; `find_block` is asked only when a stiffness is given.
std::optional<scaling::Stress> read_modulus(JsonFields& fields, const char* modulus_key, const char* stiffness_key,
                                            const std::function<Block()>& find_block);

/// Lists the presets for a name that is none of them.
Material find_preset(const std::string& name, const std::string& place, const std::vector<Material>& presets);

/// The preset that "preset" names, nothing without one.
std::optional<Material> read_preset(JsonFields& fields, const std::vector<Material>& presets);

/// "density" and "friction", needed without a preset, "restitution", "modulus" or "normal_stiffness", "shear_modulus" or
/// "shear_stiffness", "height_deviation"; what is given replaces the preset's.
Material read_properties(JsonFields& fields, const std::optional<Material>& preset, const std::function<Block()>& find_block);

/// Puts a value that is given in the place of the old one.
template <class Value>
void replace(std::optional<Value>& old, const std::optional<Value>& given) {
    if (given) old = given;
}

}  // namespace musim::design::detail
