#pragma once

#include <string>

#include "records/design/design_law.hpp"
#include "records/design/detail/material_fields.hpp"

namespace musim::design::detail {

/// A law: the name of one of the code or of one as data, a law file beside `source`, or an object such as
/// {"law": "restoring_force", "set": {"F_R": "1/500"}, "hold": ["F_R/(mu*m*g)"]}; `entry` is a text or an object. It stands at `key` of
/// `fields`, whose reading takes its uncertain factors. Throws ReadError.
DesignLaw read_law(const Json& entry, const JsonFields& fields, const std::string& key, const std::string& source);

}  // namespace musim::design::detail
