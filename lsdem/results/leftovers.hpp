#pragma once

#include <filesystem>

namespace musim::lsdem::detail {

/// Removes what a kill left of a file that was being written by records::write_file_atomically().
void remove_leftovers(const std::filesystem::path& file) noexcept;

/// Removes a file that records::write_file_atomically() writes again and again, and what a kill left of one that was being written. Nothing
/// happens when there is none.
void remove_with_leftovers(const std::filesystem::path& file) noexcept;

}  // namespace musim::lsdem::detail
