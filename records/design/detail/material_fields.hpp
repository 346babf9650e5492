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
#include "records/design/design_law.hpp"
#include "records/json_rules.hpp"

/// Readers that files about prototypes, materials and models share. All throw ReadError `place: what (why); what to do`.
namespace musim::records::detail {

using scaling::JsonReader;
using Block = std::array<scaling::Length, 3>;

/// A quantity of zero or more, where it is given.
template <class Quantity>
std::optional<Quantity> read_not_negative(const JsonReader& fields, const std::string& key) {
    auto value = fields.find<Quantity>(key);
    if (value && !(value->value() >= 0.0 && std::isfinite(value->value()))) {
        fields.fail(fmt::format("{} is below zero", key), "correct it, or remove it where it is not known");
    }
    return value;
}

/// A plain number above zero, where it is given.
std::optional<double> read_number(const JsonReader& fields, const std::string& key);

std::string require_text(const JsonReader& fields, const std::string& key);

/// The entries of a list that is not empty; `example` goes into the message.
std::vector<JsonReader> require_list(const JsonReader& fields, const std::string& key, const std::string& example);

/// The texts of such a list.
std::vector<std::string> read_names(const JsonReader& fields, const std::string& key, const std::string& example);

/// Three lengths above zero: b, w, H.
Block require_block(const JsonReader& fields, const std::string& key);

/// E = k H/A of a face stiffness k, or the modulus itself; `find_block` is asked only when a stiffness is given.
std::optional<scaling::Stress> read_modulus(const JsonReader& fields, const std::string& modulus_key, const std::string& stiffness_key,
                                            const std::function<Block()>& find_block);

/// Lists the presets for a name that is none of them.
Material find_preset(const std::string& name, const std::string& place, const std::vector<Material>& presets);

/// The preset that "preset" names, nothing without one.
std::optional<Material> read_preset(const JsonReader& fields, const std::vector<Material>& presets);

/// "density" and "friction", needed without a preset, "restitution", "modulus" or "normal_stiffness", "shear_modulus" or
/// "shear_stiffness", "height_deviation"; what is given replaces the preset's.
Material read_properties(const JsonReader& fields, const std::optional<Material>& preset, const std::function<Block()>& find_block);

/// Puts a value that is given in the place of the old one.
template <class Value>
void replace(std::optional<Value>& old, const std::optional<Value>& given) {
    if (given) old = given;
}

/// A law: the name of one of the code or of one as data, a law file beside `source`, or an object such as
/// {"law": "restoring_force", "set": {"F_R": "1/500"}, "hold": ["F_R/(mu*m*g)"]}; `value` is a text or an object. Throws ReadError.
DesignLaw read_law(const JsonReader& value, const std::string& source);

}  // namespace musim::records::detail
