#pragma once

#include <CLI/App.hpp>
#include <CLI/Error.hpp>
#include <string>
#include <vector>

namespace musim::cli {

/// Makes every option and argument of a command and its subcommands refuse an empty value, such as -o "".
void refuse_empty_values(CLI::App& app);

/// Refuses an option of a command line whose value is empty behind its `=`, such as `--out= scene.json`: CLI11 would take the next word for
/// it. Throws CLI::ValidationError.
void refuse_empty_values(int argc, const char* const* argv);

/// Shows some of a command's commands under a heading of its help, by what people want to do.
void group_commands(CLI::App& app, const std::string& title, const std::vector<std::string>& names);

/// Fault of a command line, in one line that begins with the word at fault and ends with the help to turn to. A mistyped command
/// or option comes first, with the nearest known one: what else is missing often follows from it. `app` has been given the command line.
std::string describe_usage_error(const CLI::App& app, const CLI::ParseError& error);

}  // namespace musim::cli
