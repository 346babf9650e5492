#pragma once

#include <string>

#include "records/design/design_law.hpp"
#include "records/design/detail/material_fields.hpp"

namespace musim::records::detail {

/// A law: the name of one of the code or of one as data, a law file beside `source`, or an object such as
/// {"law": "restoring_force", "set": {"F_R": "1/500"}, "hold": ["F_R/(mu*m*g)"]}; `value` is a text or an object. Throws ReadError.
DesignLaw read_law(const JsonReader& value, const std::string& source);

}  // namespace musim::records::detail
