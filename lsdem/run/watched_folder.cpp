#include "lsdem/run/watched_folder.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>

#include "lsdem/results/checked_json.hpp"
#include "lsdem/results/checkpoint.hpp"
#include "lsdem/results/folder_contents.hpp"
#include "lsdem/results/folder_lock.hpp"
#include "lsdem/results/result_error.hpp"

namespace musim::lsdem {
namespace {

namespace fs = std::filesystem;

/// Where there are no locks: one that has reported nothing for so long does not work any more.
constexpr auto kSignOfLife = 5 * kProgressInterval;

bool reported_lately(const fs::path& folder) {
    std::error_code error;
    const fs::file_time_type given = fs::last_write_time(folder / kProgressName, error);
    return !error && fs::file_time_type::clock::now() - given < kSignOfLife;
}

bool works_in(const fs::path& folder) { return detail::is_locked(folder).value_or(reported_lately(folder)); }

/// A folder itself and its members, if it is of an ensemble.
std::vector<fs::path> list_folders(const fs::path& directory) {
    std::vector<fs::path> members;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(directory / "members", error)) members.push_back(entry.path());
    std::sort(members.begin(), members.end());
    members.insert(members.begin(), directory);
    return members;
}

/// The files that end the work on a folder; each has its status under a key of its own, or none.
struct ResultFile {
    const char* name;
    const char* key;
};
constexpr ResultFile kResultFiles[]{
    {"summary.json", "status"}, {"sequence.json", "status"}, {"pair.json", "consistent"}, {"ensemble.json", nullptr}};

std::string read_status(const fs::path& file, const char* key) {
    nlohmann::json json;
    try {
        json = read_checked_json(file);
    } catch (const ResultError&) {
        return "damaged";
    }
    if (key == nullptr || !json.contains(key)) return {};
    const nlohmann::json& value = json[key];
    if (value.is_boolean()) return value.get<bool>() ? "consistent" : "distorted";
    return value.is_string() ? value.get<std::string>() : std::string();
}

}  // namespace

WatchedFolder look_into(const fs::path& directory) {
    WatchedFolder watched;
    bool works = works_in(directory);
    for (const fs::path& folder : list_folders(directory)) {
        std::optional<ProgressState> state = read_progress_file(folder);
        if (!state) continue;
        watched.runs.push_back({folder, works_in(folder), std::move(*state)});
        works = works || watched.runs.back().works;
    }
    if (works) {
        watched.state = FolderState::working;
        return watched;
    }
    if (!watched.runs.empty() || fs::exists(directory / kCheckpointName) ||
        (fs::exists(directory / kContentsName) && !is_complete(directory))) {
        watched.state = FolderState::killed;
        return watched;
    }
    for (const ResultFile& file : kResultFiles) {
        if (!fs::exists(directory / file.name)) continue;
        watched.state = FolderState::finished;
        watched.status = read_status(directory / file.name, file.key);
        return watched;
    }
    return watched;
}

}  // namespace musim::lsdem
