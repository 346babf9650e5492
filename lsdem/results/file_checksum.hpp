#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace musim::lsdem::detail {

/// Appends the line "musim-checksum HASH\n", ContentHash of all bytes before it. HDF5 keeps its own end of file and ignores what follows,
/// so such a file opens everywhere.
void append_checksum(std::vector<char>& bytes);

/// HASH of a file's bytes that end with such a line.
std::string find_checksum(std::string_view bytes);

/// Reads a whole file against the line at its end; its HASH. Throws ResultError: the file, what is wrong, and what to do.
std::string require_checksum(const std::filesystem::path& file);

}  // namespace musim::lsdem::detail
