#include "lsdem/study/ensemble_members.hpp"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <utility>
#include <variant>

#include "lsdem/results/checkpoint.hpp"
#include "lsdem/results/content_name.hpp"
#include "lsdem/results/folder_contents.hpp"
#include "lsdem/results/scene_files.hpp"
#include "lsdem/run/specimen_batch.hpp"
#include "lsdem/scene/motions.hpp"
#include "lsdem/scene/scene_error.hpp"
#include "lsdem/scene/scene_json.hpp"

namespace musim::lsdem {
namespace {

namespace fs = std::filesystem;

/// Standard deviation of the block heights [m]; 0 for an explicit list of blocks.
double height_deviation_of(const Scene& scene) {
    return std::visit(
        [](const auto& structure) {
            if constexpr (requires { structure.height_deviation; }) return structure.height_deviation.value();
            return 0.0;
        },
        scene.structure);
}

void require_ensemble(const Scene& scene) {
    require_single_motion(scene, "an ensemble");
    if (!(height_deviation_of(scene) > 0.0)) {
        throw SceneError(
            fmt::format("{}: all members would be the same (its blocks are of one height); give a column, tower or wall a "
                        "\"height_deviation\"",
                        scene.place()));
    }
    if (scene.preparation && scene.preparation->specimen) {
        throw SceneError(fmt::format(
            "{}: names one specimen, {} (members have blocks of other heights); leave \"preparation.specimen\" out, each is then "
            "laid by itself, or comes from the folder of --specimens",
            scene.place(), scene.preparation->specimen->string()));
    }
    if (!scene.time.step && !(scene.output.spine_rate.value() > 0.0)) {
        throw SceneError(fmt::format(
            "{}: members would be sampled at different times (an automatic step depends on the blocks); give an \"output.spine_rate\"",
            scene.place()));
    }
}

}  // namespace

EnsembleMember make_member(Scene scene, const std::string& version) {
    EnsembleMember member;
    member.seed = seed_of(scene);
    member.scene = std::move(scene);
    member.scene_text = write_scene(member.scene);
    const std::string content = write_scene(with_file_contents(member.scene));
    member.name = "member-" + detail::name_content(nlohmann::json{content, version}.dump());
    return member;
}

std::vector<EnsembleMember> plan_ensemble(const Scene& scene, int members, const std::string& version) {
    require_ensemble(scene);
    std::vector<EnsembleMember> plan;
    plan.reserve(static_cast<std::size_t>(members));
    for (int i = 0; i < members; ++i) {
        plan.push_back(make_member(with_seed(scene, seed_of(scene) + static_cast<std::uint64_t>(i)), version));
    }
    return plan;
}

fs::path member_folder(const fs::path& directory, const EnsembleMember& member) { return directory / "members" / member.name; }

std::string to_string(MemberState state) {
    constexpr std::array kNames{"waiting", "unfinished", "finished"};
    return kNames.at(static_cast<std::size_t>(state));
}

MemberState find_state(const fs::path& directory, const EnsembleMember& member) {
    const fs::path folder = member_folder(directory, member);
    // a checkpoint goes last: results beside one may be the half of them
    if (fs::exists(folder / kCheckpointName)) return MemberState::unfinished;
    return is_complete(folder) ? MemberState::finished : MemberState::waiting;
}

bool is_scene_of(const std::string& scene_text, const EnsembleMember& member) {
    const auto forget = [](const fs::path&) { return fs::path("/file"); };
    return rename_files(parse_scene(scene_text), forget) == rename_files(member.scene, forget);
}

}  // namespace musim::lsdem
