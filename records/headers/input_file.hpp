#pragma once

#include <filesystem>
#include <string_view>

namespace musim::records::detail {

/// A file being read, text or binary, as far as messages name it.
class InputFile {
  public:
    explicit InputFile(std::filesystem::path path) : path_(std::move(path)) {}
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    const std::filesystem::path& path() const { return path_; }

    /// Throws ReadError `path: what_why; what_to_do`.
    [[noreturn]] void fail(std::string_view what_why, std::string_view what_to_do) const;

  protected:
    ~InputFile() = default;

  private:
    std::filesystem::path path_;
};

}  // namespace musim::records::detail
