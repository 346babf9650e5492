#pragma once

#include <string_view>
#include <vector>

#include "scaling/pi_quantity.hpp"

namespace musim::scaling {

/// Quantities of a problem in JSON: {"quantities": [{"name": "v", "unit": "m/s", "value": 0.424}, ...]}, "value" where one is known: a
/// number or a fraction as text, in that unit, with or without its standard uncertainty in it ("42.4 +/- 0.4", "0.59 +/- 5%"). It may stand
/// under "problem" among other keys, as in what `musim pi --json` prints. `origin` (a file) stands in front of messages. Throws PiError:
/// broken JSON, unknown or missing key, unit that is unknown (with the nearest) or none, and what check_quantities() refuses.
std::vector<PiQuantity> parse_pi_problem(std::string_view text, std::string_view origin);

}  // namespace musim::scaling
