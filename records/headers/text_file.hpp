#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "records/error.hpp"
#include "scaling/setting.hpp"

namespace musim::records::detail {

/// A file being read, text or binary, as far as messages name it.
class InputFile {
  public:
    explicit InputFile(std::filesystem::path path) : path_(std::move(path)) {}
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    const std::filesystem::path& path() const { return path_; }

    /// Throws ReadError `path: what_why; what_to_do`.
    [[noreturn]] void fail(std::string_view what_why, const Remedy& what_to_do) const;

  protected:
    ~InputFile() = default;

  private:
    std::filesystem::path path_;
};

/// Bytes of the largest file that is read, packed or unpacked: an hour of three components at 1000 Hz, 25 letters a value, is 0.27 GB.
inline constexpr std::size_t kLargestFileBytes = std::size_t{1} << 30U;

/// Bytes of a regular file. Throws ReadError when it is missing, a folder or device, unreadable, empty or larger than kLargestFileBytes.
std::string read_bytes(const std::filesystem::path& path);

/// Text in UTF-8 of bytes that begin with a byte-order mark of UTF-16; other bytes as they are.
std::string decode_utf16(std::string bytes);

/// A text file as lines, and the way readers complain about them.
class TextFile : public InputFile {
  public:
    /// Splits `bytes` at LF, CR LF or lone CR; blanks at the ends of lines, a byte-order mark and DOS end marks go.
    TextFile(std::filesystem::path path, std::string bytes);

    std::size_t size() const { return lines_.size(); }

    /// Empties the first `count` lines, so that those below keep their numbers. Throws ReadError when there are not more lines.
    void skip(std::size_t count);

    /// Line `index`, counted from 0; empty beyond the end.
    std::string_view line(std::size_t index) const { return index < lines_.size() ? lines_[index] : std::string_view{}; }

    /// `path:line` of line `index`, counted from 1 as editors do.
    std::string place_of(std::size_t index) const;

    using InputFile::fail;
    /// Throws ReadError `path:line: what_why; what_to_do`.
    [[noreturn]] void fail(std::size_t index, std::string_view what_why, const Remedy& what_to_do) const;

  private:
    std::string bytes_;
    std::vector<std::string_view> lines_;
};

/// The bytes of a binary file.
class BinaryFile : public InputFile {
  public:
    BinaryFile(std::filesystem::path path, std::string bytes) : InputFile(std::move(path)), bytes_(std::move(bytes)) {}

    std::string_view bytes() const { return bytes_; }

  private:
    std::string bytes_;
};

/// The number whose bytes stand at `at` in the given order; the caller has checked that at + sizeof(Number) lies within `bytes`.
template <class Number>
requires std::integral<Number> || std::floating_point<Number> Number number_at(std::string_view bytes, std::size_t at, std::endian order) {
    std::array<char, sizeof(Number)> raw{};
    for (std::size_t i = 0; i < raw.size(); ++i) raw[order == std::endian::native ? i : raw.size() - 1 - i] = bytes[at + i];
    return std::bit_cast<Number>(raw);
}

}  // namespace musim::records::detail
