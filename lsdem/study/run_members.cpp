#include "lsdem/study/run_members.hpp"

#include <exception>
#include <mutex>

#include "lsdem/results/write_results.hpp"
#include "lsdem/run/joined_progress.hpp"
#include "lsdem/run/progress_file.hpp"
#include "lsdem/run/run.hpp"
#include "lsdem/run/shared_progress.hpp"
#include "scaling/interruption.hpp"
#include "scaling/side_by_side.hpp"

namespace musim::lsdem {
namespace {

namespace fs = std::filesystem;

/// The HDF5 library need not be one for several threads.
std::mutex& result_file_mutex() {
    static std::mutex mutex;
    return mutex;
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
                                                              .scene = member.scene_text,
                                                              .program_version = settings.version,
                                                              .interval = settings.checkpoint_interval,
                                                              .on_failure = settings.on_no_checkpoint}};
    progress_file.listen_to(run_settings.observer);
    report.resumed = fs::exists(checkpoint);
    const RunResult run = report.resumed ? resume_scene(member.scene, read_checkpoint(checkpoint, settings.version), run_settings)
                                         : run_scene(member.scene, run_settings);
    const std::lock_guard lock(result_file_mutex());
    folder.add_run("", run, {.scene = member.scene_text, .program_version = settings.version});
    folder.commit();
    remove_checkpoint(checkpoint);
}

}  // namespace

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
