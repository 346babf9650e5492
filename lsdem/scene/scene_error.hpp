#pragma once

#include "scaling/error.hpp"

namespace musim::lsdem {

/// Bad input in a scene: says where (file and JSON path), what, why, and what to do, in one line.
class SceneError : public Error {
  public:
    using Error::Error;
};

}  // namespace musim::lsdem
