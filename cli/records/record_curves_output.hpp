#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "records/measures/record_curves.hpp"

namespace musim::cli {

/// What the components' peaks are, their own: a list of objects.
nlohmann::json to_json(const std::vector<records::ComponentCurves>& components);

}  // namespace musim::cli
