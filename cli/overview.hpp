#pragma once

#include <string>

namespace musim::cli {

/// What people come for, each with a command line to begin with, and how to see all commands.
std::string describe_program();

}  // namespace musim::cli
