#pragma once

#include <CLI/App.hpp>
#include <string>

#include "cli/commands.hpp"

namespace musim::cli {

/// What people come for, each with a command line to begin with, and how to see all commands.
std::string describe_program();

/// Gives an empty App name, version, help and every command; when it parses a command line, `action` is set to carry it out.
void add_commands(CLI::App& app, Action& action);

}  // namespace musim::cli
