#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/scene/scene.hpp"

namespace musim::lsdem {

/// Origin of results: command and version, and by name the parts of scenes and the options. Equal origins make equal results.
struct ResultOrigin {
    std::string command;  ///< "run", "pair", ...
    std::string program_version;
    /// A part of a scene ("material") by a hash of it, where the contents of a file stand for its path; an option ("--twins") by its value.
    std::map<std::string, std::string> parts;
    /// Options by name that say how many of something there are, where the results of fewer are a beginning of these.
    std::map<std::string, std::size_t> counts = {};

    /// Adds the parts of a scene; `prefix` parts several. Throws records::ReadError for a file of it that cannot be read.
    void add(const Scene& scene, const std::string& prefix = "");

    bool operator==(const ResultOrigin&) const = default;
};

/// The file of a results folder that says what it holds.
inline constexpr const char* kContentsName = "contents.json";

struct FolderContents {
    ResultOrigin origin;
    bool complete = false;           ///< false: its files were being replaced
    std::vector<std::string> files;  ///< relative paths
};

/// Reads DIRECTORY/contents.json. Nothing when there is none. Throws ResultError when it is damaged.
std::optional<FolderContents> read_contents(const std::filesystem::path& directory);

/// Writes it in one step. Throws records::WriteError.
void write_contents(const std::filesystem::path& directory, const FolderContents& contents);

/// The results in a folder as relative paths: what its contents.json lists; without a usable one the results known by their names.
std::vector<std::string> list_results(const std::filesystem::path& directory);

/// Does a folder say that its results are of that origin?
bool is_of(const std::filesystem::path& directory, const ResultOrigin& origin);

/// Does a folder say what it holds, and that all of it is there?
bool is_complete(const std::filesystem::path& directory);

/// Throws ResultError for a folder whose files were being replaced when the program was killed: old ones may stand beside new ones.
void require_complete(const std::filesystem::path& directory);

/// Refuses a folder with results of another origin, or of one that is not known; those of fewer of what `counts` has are the beginning of
/// these. Throws ResultError `FILE: what differs; what to do`.
void refuse_other_results(const std::filesystem::path& directory, const ResultOrigin& origin);

}  // namespace musim::lsdem
