#include "lsdem/study/ensemble_members.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <exception>
#include <nlohmann/json.hpp>
#include <utility>

#include "lsdem/results/checkpoint.hpp"
#include "lsdem/results/checksum.hpp"
#include "lsdem/results/folder_contents.hpp"
#include "lsdem/results/result_error.hpp"
#include "lsdem/results/scene_files.hpp"
#include "lsdem/results/write_results.hpp"
#include "lsdem/run/joined_progress.hpp"
#include "lsdem/run/progress_file.hpp"
#include "lsdem/run/run.hpp"
#include "lsdem/run/shared_progress.hpp"
#include "lsdem/scene/motions.hpp"
#include "lsdem/scene/scene_error.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "lsdem/scene/specimen_seed.hpp"
#include "scaling/interruption.hpp"
#include "scaling/setting.hpp"
#include "scaling/side_by_side.hpp"

namespace musim::lsdem {
namespace {

namespace fs = std::filesystem;

void require_ensemble(const Scene& scene) {
    require_single_motion(scene, "an ensemble");
    if (!draws_specimen(scene)) {
        throw SceneError(
            fmt::format("{}: all members would be the same (its blocks are of one height, and nothing scatters); give a column, tower or "
                        "wall a \"height_deviation\", or the scene a \"scatter\"",
                        scene.place()));
    }
    if (scene.preparation && scene.preparation->specimen) {
        throw SceneError(
            fmt::format("{}: names one specimen, {} (members have blocks of their own)", scene.place(),
                        scene.preparation->specimen->string()),
            Remedy{"leave \"preparation.specimen\" out: each is then prepared by itself, or comes from ", Setting::specimen_folder});
    }
    if (!scene.time.step && !(scene.output.spine_rate.value() > 0.0)) {
        throw SceneError(fmt::format(
            "{}: members would be sampled at different times (an automatic step depends on the blocks); give an \"output.spine_rate\"",
            scene.place()));
    }
}

/// The member whose blocks stand where `file` has them.
EnsembleMember with_specimen(const EnsembleMember& member, const std::filesystem::path& file, const std::string& version) {
    Scene scene = member.scene;
    Preparation preparation = scene.preparation.value_or(Preparation{});
    preparation.placing.reset();
    preparation.specimen = std::filesystem::absolute(file);
    scene.preparation = preparation;
    return make_member(std::move(scene), version);
}

void run_member(const EnsembleMember& member, const MemberSettings& settings, const std::function<void(double)>& on_progress,
                MemberReport& report) {
    const fs::path directory = member_folder(settings.directory, member);
    const fs::path checkpoint = directory / kCheckpointName;
    // the folder first: it keeps other processes off the member
    // its name follows from all that it is made from, so what is there is of the same
    ResultFolder folder(directory, {.command = "ensemble", .program_version = settings.version, .parts = {{"member", member.name}}},
                        Overwriting::force);
    JoinedProgress joined;
    ProgressFile progress_file(directory, member.scene.name);
    RunSettings run_settings{.threads = 1,
                             .observer = {.on_progress = [&](double fraction) { on_progress(joined.after_running(fraction)); },
                                          .on_preparation = [&](double fraction) { on_progress(joined.after_preparing(fraction)); }},
                             .checkpoint = CheckpointSettings{.file = checkpoint,
                                                              .scene = write_scene(member.scene),
                                                              .program_version = settings.version,
                                                              .interval = settings.checkpoint_interval,
                                                              .on_failure = settings.on_no_checkpoint}};
    progress_file.listen_to(run_settings.observer);
    report.resumed = fs::exists(checkpoint);
    const RunResult run = report.resumed ? resume_scene(member.scene, read_checkpoint(checkpoint, settings.version), run_settings)
                                         : run_scene(member.scene, run_settings);
    folder.add_run("", run, {.scene = write_scene(member.scene), .program_version = settings.version});
    folder.commit();
    remove_checkpoint(checkpoint);
}

}  // namespace

EnsembleMember make_member(Scene scene, const std::string& version) {
    EnsembleMember member;
    member.seed = seed_of(scene);
    member.scene = std::move(scene);
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

std::vector<SpecimenReport> use_specimens(std::vector<EnsembleMember>& members, SpecimenBatch batch) {
    batch.scene = members.front().scene;
    batch.seeds.clear();
    for (const EnsembleMember& member : members) batch.seeds.push_back(member.seed);
    const auto missing = std::count_if(members.begin(), members.end(), [&](const EnsembleMember& member) {
        return !std::filesystem::exists(batch.folder / specimen_file_of(member.scene));
    });
    // those whose specimens are there follow, too
    if (missing > 0) batch.runs_to_follow = static_cast<double>(members.size()) / static_cast<double>(missing);
    std::vector<SpecimenReport> reports = make_specimens(batch);
    for (std::size_t i = 0; i < members.size(); ++i) {
        if (reports[i].stands()) members[i] = with_specimen(members[i], reports[i].file, batch.version);
    }
    return reports;
}

void use_prepared_specimens(std::vector<EnsembleMember>& members, const std::filesystem::path& folder, const std::string& version) {
    for (EnsembleMember& member : members) {
        const std::filesystem::path file = folder / specimen_file_of(member.scene);
        if (!std::filesystem::exists(file)) {
            throw ResultError(fmt::format("{}: does not exist, so member {} has no name yet", file.string(), member.seed),
                              Remedy{"make it by ", Setting::preparation, " ", folder.string()});
        }
        member = with_specimen(member, file, version);
    }
}

std::vector<MemberReport> run_members(const std::vector<EnsembleMember>& members, const MemberSettings& settings) {
    std::vector<MemberReport> reports(members.size());
    std::vector<std::size_t> pending;
    for (std::size_t i = 0; i < members.size(); ++i) {
        reports[i].reused = find_state(settings.directory, members[i]) == MemberState::finished;
        if (!reports[i].reused) pending.push_back(i);
    }
    detail::SharedProgress progress(pending.size(), settings.on_progress);
    std::vector<std::function<void()>> jobs;
    for (std::size_t job = 0; job < pending.size(); ++job) {
        jobs.emplace_back([&, job] {
            const std::size_t i = pending[job];
            try {
                run_member(
                    members[i], settings, [&, job](double fraction) { progress.update(job, fraction); }, reports[i]);
            } catch (const scaling::Interrupted&) {
                throw;
            } catch (const std::exception& error) {
                reports[i].error = error.what();
            }
            progress.update(job, 1.0);
        });
    }
    scaling::run_side_by_side(jobs, settings.threads);
    return reports;
}

}  // namespace musim::lsdem
