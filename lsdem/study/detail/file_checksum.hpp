#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace musim::lsdem::study::detail {

/// Appends the line "musim-checksum HASH\n", ContentHash of all bytes before it. HDF5 keeps its own end of file and ignores what follows,
/// so such a file opens everywhere.
void append_checksum(std::vector<char>& bytes);

/// Reads a whole file against the line at its end. Throws ResultError: the file, what is wrong, and what to do.
void require_checksum(const std::filesystem::path& file);

}  // namespace musim::lsdem::study::detail
