#pragma once

#include <filesystem>
#include <optional>

namespace musim::lsdem::study::detail {

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

/// Does a process hold a directory now? Nothing on file systems that cannot tell.
std::optional<bool> is_locked(const std::filesystem::path& directory);

}  // namespace musim::lsdem::study::detail
