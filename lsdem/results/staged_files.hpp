#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "lsdem/results/folder_lock.hpp"

namespace musim::lsdem::detail {

/// Files that appear in a directory all together or not at all.
///
/// They are written into a hidden folder of that directory and moved by commit(). Without commit() the destructor removes what was
/// written, and the directories that were made for it.
class StagedFiles {
  public:
    /// Makes the directory and its parents, and keeps it to itself. Throws records::WriteError when it cannot.
    explicit StagedFiles(std::filesystem::path directory);
    ~StagedFiles();
    StagedFiles(const StagedFiles&) = delete;
    StagedFiles& operator=(const StagedFiles&) = delete;

    /// Writes a file; `name` may hold folders. Throws records::WriteError with the system's reason, e.g. a full disk.
    void write(const std::filesystem::path& name, std::string_view bytes);

    /// Moves all files to their places, replacing older ones; more may be written and moved after that. Throws records::WriteError.
    void commit();

    const std::filesystem::path& directory() const { return directory_; }

    /// Written since the last commit().
    const std::vector<std::filesystem::path>& names() const { return names_; }

  private:
    void remove_all() noexcept;

    std::filesystem::path directory_;
    std::optional<FolderLock> lock_;
    std::filesystem::path staging_;
    std::vector<std::filesystem::path> created_;  ///< directories that were not there before, innermost first
    std::vector<std::filesystem::path> names_;
};

/// Removes what a kill left of a file that was being written by records::write_file_atomically().
void remove_leftovers(const std::filesystem::path& file) noexcept;

/// Removes a file that records::write_file_atomically() writes again and again, and what a kill left of one that was being written. Nothing
/// happens when there is none.
void remove_with_leftovers(const std::filesystem::path& file) noexcept;

}  // namespace musim::lsdem::detail
