#pragma once

#include <optional>
#include <string>
#include <vector>

namespace musim::lsdem::detail {

/// Is there a program of this name on the PATH?
bool has_program(const std::string& name);

/// Runs a program of the PATH with arguments, no shell between, its input empty, and waits for it: its exit status, 128 + the signal that
/// ended it, or nothing when it cannot be started.
std::optional<int> run_program(const std::vector<std::string>& command);

}  // namespace musim::lsdem::detail
