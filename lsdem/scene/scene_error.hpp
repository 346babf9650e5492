#pragma once

#include <stdexcept>
#include <string>

#include "scaling/shorten.hpp"

namespace musim::lsdem::scene {

/// Bad input in a scene: says where (file and JSON path), what, why, and what to do, in one line.
class SceneError : public std::runtime_error {
  public:
    explicit SceneError(const std::string& what) : std::runtime_error(scaling::make_line(what)) {}
};

}  // namespace musim::lsdem::scene
