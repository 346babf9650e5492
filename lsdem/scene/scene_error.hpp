#pragma once

#include <stdexcept>
#include <string>

namespace musim::lsdem::scene {

/// Bad input in a scene: says where (file and JSON path), what, why, and what to do, in one line.
class SceneError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace musim::lsdem::scene
