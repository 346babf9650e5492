#pragma once

#include <string>
#include <vector>

#include "lsdem/scene/scene.hpp"

namespace musim::lsdem::detail {

/// Words on values of a scene that are hardly meant (scaling/unlikely.hpp, and a gravity that points upwards), each with its place; the
/// first of each kind, since a slip is made in a whole file.
std::vector<std::string> find_unlikely_values(const Scene& scene);

}  // namespace musim::lsdem::detail
