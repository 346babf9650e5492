#pragma once

#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace musim::cli {

/// Is a stream a terminal on which lines can be written anew? Not one that calls itself dumb (TERM).
bool is_terminal(std::FILE* stream);

/// Columns of the terminal that a stream goes to; 80 where it does not say.
std::size_t count_columns(std::FILE* stream);

/// A text of UTF-8 in at most so many columns, each character taken as one: "a long na…" when it has more.
std::string fit(const std::string& text, std::size_t columns);

/// Characters of a text of UTF-8.
std::size_t count_characters(std::string_view text);

/// May a stream have colours? A terminal may, unless NO_COLOR is set to anything (no-color.org).
bool wants_colour(std::FILE* stream);

/// Red text for a terminal that wants colours; the text alone for others.
std::string in_red(std::string_view text, std::FILE* stream);

/// A history as one character a value, from ▁, the negative of the largest magnitude, to █, its positive; a zero lies in the middle.
std::string make_sparkline(const std::vector<double>& values);

}  // namespace musim::cli
