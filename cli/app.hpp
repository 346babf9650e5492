#pragma once

#include <CLI/App.hpp>

#include "cli/commands.hpp"

namespace musim::cli {

/// Gives an empty App name, version, help and every command; when it parses a command line, `action` is set to carry it out.
void add_commands(CLI::App& app, Action& action);

}  // namespace musim::cli
