#pragma once

#include <filesystem>
#include <optional>
#include <utility>

namespace musim::lsdem::detail {

/// Keeps a directory to one process: the lock goes with the process, however that ends, and leaves no file. On file systems that cannot
/// lock a directory it holds nothing off.
class FolderLock {
  public:
    /// Throws records::WriteError when another holds it.
    explicit FolderLock(const std::filesystem::path& directory);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

  private:
    int descriptor_;
};

/// Keeps a file that is to be made to one process, as FolderLock a directory, by a hidden file beside it, which goes with the lock. A kill
/// leaves that file behind, unlocked, for the next to take.
class FileLock {
  public:
    /// Throws records::WriteError when another process holds it, or nothing can be written beside the file.
    explicit FileLock(const std::filesystem::path& file);
    FileLock(FileLock&& other) noexcept : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}
    FileLock& operator=(FileLock&&) = delete;
    ~FileLock();

  private:
    std::filesystem::path path_;
    int descriptor_ = -1;
};

/// Does a process hold a directory now? Nothing on file systems that do not know.
std::optional<bool> is_locked(const std::filesystem::path& directory);

}  // namespace musim::lsdem::detail
