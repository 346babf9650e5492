#include "lsdem/results/staged_files.hpp"

#include <fmt/format.h>

#include <string>
#include <system_error>
#include <utility>

#include "records/atomic_file.hpp"

namespace musim::lsdem::detail {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStagingFolder = ".unfinished";

void require(const std::error_code& error, const fs::path& path, const char* what) {
    if (error) {
        throw records::WriteError(fmt::format("{}: cannot {} ({}); choose another output directory", path.string(), what, error.message()));
    }
}

void make_directories(const fs::path& directory) {
    std::error_code error;
    fs::create_directories(directory, error);
    if (!error && !fs::is_directory(directory)) error = std::make_error_code(std::errc::not_a_directory);
    require(error, directory, "be used as a directory");
}

/// The parts of a path that do not exist, innermost first.
std::vector<fs::path> find_missing(const fs::path& directory) {
    std::vector<fs::path> missing;
    std::error_code ignored;
    for (fs::path part = fs::absolute(directory).lexically_normal(); part.has_relative_path() && !fs::exists(part, ignored);
         part = part.parent_path()) {
        if (part.has_filename()) missing.push_back(part);
    }
    return missing;
}

}  // namespace

StagedFiles::StagedFiles(fs::path directory)
    : directory_(std::move(directory)), staging_(directory_ / kStagingFolder), created_(find_missing(directory_)) {
    try {
        make_directories(directory_);
        lock_.emplace(directory_);
        make_directories(staging_);
    } catch (...) {
        remove_all();
        throw;
    }
}

StagedFiles::~StagedFiles() { remove_all(); }

void StagedFiles::write(const fs::path& name, std::string_view bytes) {
    make_directories((staging_ / name).parent_path());
    records::write_file_atomically(staging_ / name, bytes);
    names_.push_back(name);
}

void StagedFiles::commit() {
    for (const fs::path& name : names_) {
        make_directories((directory_ / name).parent_path());
        std::error_code error;
        fs::rename(staging_ / name, directory_ / name, error);
        require(error, directory_ / name, "be replaced");
    }
    names_.clear();
    created_.clear();
}

void StagedFiles::remove_all() noexcept {
    std::error_code ignored;
    // what another process keeps is its own
    if (lock_) fs::remove_all(staging_, ignored);
    // one that is not empty stays
    for (const fs::path& made : created_) fs::remove(made, ignored);
}

void remove_leftovers(const fs::path& file) noexcept {
    std::error_code ignored;
    const std::string begin = fmt::format(".{}.", file.filename().string());
    std::vector<fs::path> leftovers;
    for (fs::directory_iterator entry(file.parent_path(), ignored), last; !ignored && entry != last; entry.increment(ignored)) {
        const std::string name = entry->path().filename().string();
        if (name.starts_with(begin) && name.ends_with(".tmp")) leftovers.push_back(entry->path());
    }
    for (const fs::path& leftover : leftovers) fs::remove(leftover, ignored);
}

void remove_with_leftovers(const fs::path& file) noexcept {
    std::error_code ignored;
    fs::remove(file, ignored);
    remove_leftovers(file);
}

}  // namespace musim::lsdem::detail
