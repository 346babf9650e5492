#pragma once

#include "lsdem/scene/scene.hpp"

namespace musim::lsdem::detail {

/// Does a sensor sit on the ground?
bool is_ground(const SensorBody& body);

}  // namespace musim::lsdem::detail
