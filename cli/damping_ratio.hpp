#pragma once

#include <CLI/Error.hpp>
#include <CLI/Validators.hpp>

namespace musim::cli {

/// Checks a --damping: one of an oscillator, and not above 2, where percent were meant.
CLI::Validator damping_ratio();

}  // namespace musim::cli
