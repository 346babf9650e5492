#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "cli/record_curves.hpp"

namespace musim::cli {

/// All points of all curves, a row each: file, component, scale (prototype or model), the names of value and abscissa with their units,
/// both.
std::string make_csv(const std::vector<ComponentCurves>& components);

/// What the components' peaks are, their own: a list of objects.
nlohmann::json to_json(const std::vector<ComponentCurves>& components);

}  // namespace musim::cli
