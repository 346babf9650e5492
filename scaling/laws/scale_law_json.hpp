#pragma once

#include <string>
#include <string_view>

#include "scaling/laws/scale_law.hpp"

namespace musim::scaling {

/// A law in JSON (musim-law-1.schema.json gives every key):
///   {"schema": "musim-law/1", "name", "title", "description", "sources": [...], "assumptions": [...], "extends": "mechanics",
///    "quantities": [{"name": "l", "unit": "m", "meaning": "length"}, ...],
///    "chosen": [{"name": "l"}, {"name": "g", "default": 1}, ...], "definitions": ["v*t/l", ...], "held": [...], "watched": [...],
///    "additions": [{"name", "meaning", "total", "own"}, ...]}
/// "extends" puts the lists of a shipped law in front, but for what that law chooses; a quantity named again replaces the other law's.
/// The law may stand under "law" among other keys, as in what `musim scale --law NAME --json` prints.
/// `origin` (a file) stands in front of messages. Throws PiError: broken JSON, another schema, unknown or missing key, and what
/// check_law() refuses.
ScaleLaw parse_scale_law(std::string_view text, std::string_view origin);

/// The law as JSON, without "extends"; parse_scale_law() reads the same law back.
std::string write_scale_law(const ScaleLaw& law);

}  // namespace musim::scaling
