#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "records/error.hpp"
#include "records/headers/input_file.hpp"

namespace musim::records::detail {

/// Bytes of a regular file. Throws ReadError when it is missing, a folder or device, unreadable or empty.
std::string read_bytes(const std::filesystem::path& path);

/// A text file as lines, and the way readers complain about them.
class TextFile : public InputFile {
  public:
    /// Splits `bytes` at LF, CR LF or lone CR; blanks at the ends of lines, a byte-order mark and DOS end marks go.
    TextFile(std::filesystem::path path, std::string bytes);

    std::size_t size() const { return lines_.size(); }

    /// Line `index`, counted from 0; empty beyond the end.
    std::string_view line(std::size_t index) const { return index < lines_.size() ? lines_[index] : std::string_view{}; }

    using InputFile::fail;
    /// Throws ReadError `path:line: what_why; what_to_do`, with the line counted from 1 as editors do.
    [[noreturn]] void fail(std::size_t index, std::string_view what_why, std::string_view what_to_do) const;

  private:
    std::string bytes_;
    std::vector<std::string_view> lines_;
};

}  // namespace musim::records::detail
