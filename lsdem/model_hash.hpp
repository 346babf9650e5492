#pragma once

#include <cstdint>

#include "lsdem/model.hpp"

namespace musim::lsdem {

/// Hash of every number of a model and of its time step [s]: equal for equal bits, different otherwise but for one chance in 2^64.
std::uint64_t hash_model(Model model, double time_step);

}  // namespace musim::lsdem
