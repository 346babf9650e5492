#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <utility>

namespace musim::cli {

/// All of a text; the stream remembers when it cannot be written.
void write_text(std::FILE* stream, std::string_view text);

/// Formatted text on stdout. That it cannot be written is an error at the end, see flush_output().
template <class... Arguments>
void print(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
    write_text(stdout, fmt::format(text, std::forward<Arguments>(arguments)...));
}

/// Formatted text on stderr: progress and remarks. Work goes on when nobody can read them.
template <class... Arguments>
void note(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
    write_text(stderr, fmt::format(text, std::forward<Arguments>(arguments)...));
}

/// A remark for stderr once the command has done its work; should it fail, its error is the only line. From any thread; the same remark
/// comes once.
void note_at_end(std::string line);
void print_notes();
void forget_notes();  ///< those of a command line before, which failed or has printed them

/// One JSON object on stdout.
void print_json(const nlohmann::json& object);

/// Makes sure that everything printed has arrived. Throws std::runtime_error when stdout cannot take it, as on a full disk.
void flush_output();

}  // namespace musim::cli
