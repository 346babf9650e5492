#include "lsdem/run/specimen_batch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <variant>

#include "lsdem/results/folder_lock.hpp"
#include "lsdem/results/result_error.hpp"
#include "lsdem/results/run_warnings.hpp"
#include "lsdem/results/staged_files.hpp"
#include "lsdem/run/drawn_places.hpp"
#include "lsdem/run/run.hpp"
#include "lsdem/run/shared_progress.hpp"
#include "lsdem/run/specimen_file.hpp"
#include "lsdem/scene/build_model.hpp"
#include "lsdem/scene/scene_error.hpp"
#include "lsdem/scene/specimen_seed.hpp"
#include "records/error.hpp"
#include "scaling/side_by_side.hpp"

namespace musim::lsdem {
namespace {

using Clock = std::chrono::steady_clock;

/// 1 for each specimen that is missing, 0 for each that is there.
std::vector<double> find_work(const std::vector<std::optional<detail::FileLock>>& locks) {
    std::vector<double> work;
    for (const auto& lock : locks) work.push_back(lock ? 1.0 : 0.0);
    return work;
}

std::filesystem::path checkpoint_of(const std::filesystem::path& file) { return file.string() + ".checkpoint"; }

/// State that a killed preparation of the same specimen has left.
std::optional<PreparationState> find_unfinished(const SpecimenBatch& batch, const CheckpointSettings& checkpoint) {
    if (!std::filesystem::exists(checkpoint.file)) return std::nullopt;
    try {
        Checkpoint found = read_checkpoint(checkpoint.file, batch.version);
        if (found.scene == checkpoint.scene && found.preparation) return std::move(found.preparation);
    } catch (const std::runtime_error& error) {
        if (batch.on_warning) batch.on_warning(error.what());
    }
    return std::nullopt;
}

/// Lock of a specimen that is not there yet: it is this process's, and what killed ones have left beside it, besides the checkpoint, is
/// gone.
std::optional<detail::FileLock> keep_missing(const std::filesystem::path& file) {
    std::optional<detail::FileLock> lock;
    if (std::filesystem::exists(file)) return lock;
    lock.emplace(file);
    if (!std::filesystem::exists(file)) detail::remove_with_leftovers(file);
    return lock;
}

void note_fallen(const std::vector<MovedBlock>& fallen, const Specimen& specimen, SpecimenReport& report) {
    report.fallen = fallen.size();
    if (!fallen.empty()) report.what_fell = describe_fallen(fallen, make_block_table(specimen));
}

SpecimenReport make_specimen_file(const SpecimenBatch& batch, std::size_t index, detail::SharedProgress& progress) {
    const std::uint64_t seed = batch.seeds[index];
    const Clock::time_point start = Clock::now();
    const Scene scene = with_seed(batch.scene, seed);
    const Specimen upright = make_upright_specimen(scene);
    const PreparationSettings preparation = find_preparation(scene, upright);

    SpecimenReport report;
    report.seed = seed;
    report.blocks = upright.model.blocks.size();
    const std::string inputs = describe_inputs(scene, preparation);
    report.file = batch.folder / specimen_file_name(inputs);
    if (std::filesystem::exists(report.file)) {
        if (read_specimen_inputs(report.file) != inputs) {
            throw ResultError(report.file.string() + ": made from other inputs (a damaged file, or a rare accident of names); move it");
        }
        const StoredSpecimen stored = read_specimen(report.file);
        note_fallen(find_fallen(upright, stored.places), upright, report);
        report.reused = true;
        // a kill between the last two steps of making it
        remove_checkpoint(checkpoint_of(report.file));
        return report;
    }
    RunSettings settings;
    settings.threads = scaling::threads_of_each(batch.threads, batch.seeds.size());
    settings.observer.on_progress = [&](double fraction) { progress.update(index, fraction); };
    settings.checkpoint = CheckpointSettings{.file = checkpoint_of(report.file),
                                             .scene = inputs,
                                             .program_version = batch.version,
                                             .interval = batch.checkpoint_interval,
                                             .on_failure = batch.on_warning};
    const std::optional<PreparationState> from = find_unfinished(batch, *settings.checkpoint);
    report.resumed = from.has_value();
    const WorkToFollow to_follow{.block_steps = batch.runs_to_follow * static_cast<double>(make_time_plan(scene, upright.model).steps()) *
                                                static_cast<double>(upright.model.blocks.size())};
    report.prepared = prepare(upright, compute_time_step(scene, upright.model).value(), preparation, settings, from, to_follow);
    note_fallen(report.prepared.rest.fallen, upright, report);
    if (report.stands()) write_specimen(report.file, report.prepared, inputs, batch.version);
    remove_checkpoint(settings.checkpoint->file);
    report.wall_time = std::chrono::duration<double>(Clock::now() - start).count();
    return report;
}

}  // namespace

std::string specimen_file_of(const Scene& scene) {
    return specimen_file_name(describe_inputs(scene, find_preparation(scene, make_upright_specimen(scene))));
}

std::vector<SpecimenReport> make_specimens(const SpecimenBatch& batch) {
    if (batch.scene.preparation && batch.scene.preparation->none) {
        throw SceneError(fmt::format("{}: \"preparation\" is \"none\", so there is no specimen to lay; leave it out", batch.scene.place()));
    }
    // a scene that is refused leaves no folder
    std::vector<std::filesystem::path> files;
    for (const std::uint64_t seed : batch.seeds) files.push_back(batch.folder / specimen_file_of(with_seed(batch.scene, seed)));
    std::error_code error;
    std::filesystem::create_directories(batch.folder, error);
    if (error) {
        throw records::WriteError(fmt::format("{}: cannot be made ({}); choose another folder", batch.folder.string(), error.message()));
    }
    // all are kept, or refused, before the first is computed
    std::vector<std::optional<detail::FileLock>> locks;
    for (const std::filesystem::path& file : files) locks.push_back(keep_missing(file));
    detail::SharedProgress progress(find_work(locks), batch.on_progress);
    std::vector<SpecimenReport> reports(batch.seeds.size());
    std::vector<std::function<void()>> jobs;
    for (std::size_t i = 0; i < batch.seeds.size(); ++i) {
        jobs.emplace_back([&, i] {
            reports[i] = make_specimen_file(batch, i, progress);
            if (batch.runs_to_follow == 0.0) progress.update(i, 1.0);
        });
    }
    scaling::run_side_by_side(jobs, batch.threads);
    return reports;
}

}  // namespace musim::lsdem
