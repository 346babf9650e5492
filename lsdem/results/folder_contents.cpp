#include "lsdem/results/folder_contents.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>

#include "lsdem/results/checked_json.hpp"
#include "lsdem/results/checksum.hpp"
#include "lsdem/results/result_error.hpp"
#include "lsdem/results/scene_files.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "records/atomic_file.hpp"
#include "scaling/setting.hpp"

namespace musim::lsdem {
namespace {

namespace fs = std::filesystem;

constexpr const char* kContentsFormat = "musim-contents/1";

/// Files by which results are known where contents.json does not list them.
constexpr const char* kResultNames[]{"result.h5", "summary.json", "sequence.json", "pair.json", "ensemble.json"};

/// "material, time, --twins": what results that are here to be cannot take from those that are there.
std::string name_differences(const ResultOrigin& there, const ResultOrigin& here) {
    std::set<std::string> names;
    for (const auto* parts : {&there.parts, &here.parts}) {
        for (const auto& [name, value] : *parts) {
            const auto other = parts == &there.parts ? here.parts.find(name) : there.parts.find(name);
            const bool missing = other == (parts == &there.parts ? here.parts.end() : there.parts.end());
            if (missing || other->second != value) names.insert(name);
        }
    }
    for (const auto& [name, count] : there.counts) {
        const auto other = here.counts.find(name);
        if (other == here.counts.end() || other->second < count) names.insert(name);
    }
    for (const auto& [name, count] : here.counts) {
        if (!there.counts.contains(name)) names.insert(name);
    }
    return fmt::format("{}", fmt::join(names, ", "));
}

/// Nothing, too, when it is damaged.
std::optional<FolderContents> read_usable_contents(const fs::path& directory) {
    try {
        return read_contents(directory);
    } catch (const ResultError&) {
        return std::nullopt;
    }
}

[[noreturn]] void refuse_overwriting(const fs::path& file, const std::string& what) {
    throw ResultError(fmt::format("{}: {}", file.string(), what), Remedy{"choose another directory, or take ", Setting::overwriting});
}

}  // namespace

void ResultOrigin::add(const Scene& scene, const std::string& prefix) {
    const auto text = nlohmann::json::parse(write_scene(with_file_contents(scene)));
    for (const auto& [key, value] : text.items()) parts[prefix + key] = detail::name_content(value.dump());
}

std::optional<FolderContents> read_contents(const fs::path& directory) {
    const fs::path file = directory / kContentsName;
    if (!fs::exists(file)) return std::nullopt;
    const nlohmann::json object = read_checked_json(file);
    try {
        if (object.at("format") != kContentsFormat) throw ResultError(file.string() + ": is of another version; remove it");
        return FolderContents{.origin = {.command = object.at("command"),
                                         .program_version = object.at("program_version"),
                                         .parts = object.at("parts").get<std::map<std::string, std::string>>(),
                                         .counts = object.value("counts", std::map<std::string, std::size_t>())},
                              .complete = object.at("complete"),
                              .files = object.at("files").get<std::vector<std::string>>()};
    } catch (const nlohmann::json::exception& error) {
        throw ResultError(fmt::format("{}: is of another version ({}); remove it", file.string(), error.what()));
    }
}

void write_contents(const fs::path& directory, const FolderContents& contents) {
    records::write_file_atomically(directory / kContentsName, make_checked_json({{"format", kContentsFormat},
                                                                                 {"command", contents.origin.command},
                                                                                 {"program_version", contents.origin.program_version},
                                                                                 {"parts", contents.origin.parts},
                                                                                 {"counts", contents.origin.counts},
                                                                                 {"complete", contents.complete},
                                                                                 {"files", contents.files}}));
}

std::vector<std::string> list_results(const fs::path& directory) {
    if (auto contents = read_usable_contents(directory)) return std::move(contents->files);
    std::vector<std::string> found;
    for (const char* name : kResultNames) {
        if (fs::exists(directory / name)) found.emplace_back(name);
    }
    return found;
}

bool is_of(const fs::path& directory, const ResultOrigin& origin) {
    const auto contents = read_usable_contents(directory);
    return contents && contents->origin == origin;
}

bool is_complete(const fs::path& directory) {
    const auto contents = read_usable_contents(directory);
    return contents && contents->complete;
}

void require_complete(const fs::path& directory) {
    const auto contents = read_contents(directory);
    if (contents && !contents->complete) {
        throw ResultError(fmt::format(
            "{}: the program was killed while it replaced the results here, old files may stand beside new ones; give the command `musim "
            "{}` again that made them",
            directory.string(), contents->origin.command));
    }
}

void refuse_other_results(const fs::path& directory, const ResultOrigin& origin) {
    const auto there = read_usable_contents(directory);
    const fs::path file = directory / kContentsName;
    if (!there) {
        if (fs::exists(file)) refuse_overwriting(file, "is damaged, or of another version: it is not known what these results are of");
        for (const char* name : kResultNames) {
            if (fs::exists(directory / name)) refuse_overwriting(directory / name, "it is not known what these results were made from");
        }
        return;
    }
    if (there->origin.command != origin.command) {
        refuse_overwriting(file, fmt::format("here are results of `musim {}`", there->origin.command));
    }
    if (there->origin.program_version != origin.program_version) {
        refuse_overwriting(file,
                           fmt::format("here are results of musim {}, this is {}", there->origin.program_version, origin.program_version));
    }
    if (const std::string names = name_differences(there->origin, origin); !names.empty()) {
        refuse_overwriting(file, fmt::format("here are results of another scene or other settings (these differ: {})", names));
    }
}

}  // namespace musim::lsdem
