#pragma once

#include <CLI/App.hpp>
#include <string>
#include <string_view>

#include "cli/commands.hpp"

namespace musim::cli {

/// Purposes that people come for, each with a command line to begin with, and how to see all commands.
std::string describe_program();

/// Gives an empty App name, version, help and every command, or the one of the name `only`, where there is one, since most commands take
/// less time than to add all. When it parses a command line, `action` is set to carry it out.
void add_commands(CLI::App& app, Action& action, std::string_view only = {});

}  // namespace musim::cli
