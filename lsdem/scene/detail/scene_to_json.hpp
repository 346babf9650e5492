#pragma once

#include <nlohmann/json.hpp>

#include "lsdem/scene/scene.hpp"

namespace musim::lsdem::detail {

/// How quantities stand in JSON: as SI numbers, which come back bit for bit, or as texts with units for people, to seven digits.
enum class QuantityStyle { si_number, text };

/// A scene as JSON, all settings written out.
nlohmann::ordered_json to_json(const Scene& scene, QuantityStyle style);

}  // namespace musim::lsdem::detail
