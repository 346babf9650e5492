#pragma once

#include <doctest/doctest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/temporary_folder.hpp"

namespace musim::lsdem {

/// All files below a directory but for the wall times in them.
inline std::map<std::string, std::string> read_stage_files(const std::filesystem::path& directory) {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(directory)) {
        if (!entry.is_regular_file()) continue;
        std::string bytes = musim::tests::bytes_of(entry.path());
        if (entry.path().filename() == "summary.json") {
            auto summary = nlohmann::json::parse(bytes);
            summary.erase("wall_s");
            summary.erase("checksum");  // of the wall time, too
            bytes = summary.dump();
        }
        files[std::filesystem::relative(entry.path(), directory).string()] = bytes;
    }
    return files;
}

/// Both directories have the same files.
inline void check_same_files(const std::filesystem::path& a, const std::filesystem::path& b) {
    const auto left = read_stage_files(a), right = read_stage_files(b);
    REQUIRE(left.size() == right.size());
    for (const auto& file : left) {
        const std::string& name = file.first;
        REQUIRE_MESSAGE(right.contains(name), name);
        CHECK_MESSAGE(file.second == right.at(name), name);
    }
}

}  // namespace musim::lsdem
