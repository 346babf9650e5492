#pragma once

#include "scaling/error.hpp"

namespace musim::lsdem {

/// A directory or file that holds no usable results: says where, what, why and what to do, in one line.
class ResultError : public Error {
  public:
    using Error::Error;
};

}  // namespace musim::lsdem
