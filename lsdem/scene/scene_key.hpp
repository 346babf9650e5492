#pragma once

#include <string_view>

#include "scaling/remedy.hpp"

namespace musim::lsdem {

/// Key of a scene that gives a setting, in quotes, such as "dt"; in plain words where there is none.
std::string_view scene_key(Setting setting);

}  // namespace musim::lsdem
