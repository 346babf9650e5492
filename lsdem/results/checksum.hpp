#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace musim::lsdem::detail {

/// 64-bit FNV-1a hash of content that comes in pieces. A change of one byte always changes it; of other changes it misses 1 in 2^64.
class ContentHash {
  public:
    void add(std::string_view piece);
    /// 16 hexadecimal digits.
    std::string name() const;

  private:
    std::uint64_t hash_ = 14695981039346656037ULL;
};

/// Name for content: its ContentHash as 16 hexadecimal digits. Equal contents have equal names on every machine.
std::string name_content(std::string_view content);

/// Appends the line "musim-checksum HASH\n", ContentHash of all bytes before it. HDF5 keeps its own end of file and ignores what follows,
/// so such a file opens everywhere.
void append_checksum(std::vector<char>& bytes);

/// HASH of a file's bytes that end with such a line.
std::string find_checksum(std::string_view bytes);

/// Reads a whole file against the line at its end; its HASH. Throws ResultError: the file, what is wrong, and what to do.
std::string require_checksum(const std::filesystem::path& file);

}  // namespace musim::lsdem::detail
