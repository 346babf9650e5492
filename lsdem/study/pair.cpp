#include "lsdem/study/pair.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <thread>

#include "lsdem/study/detail/shared_progress.hpp"

namespace musim::lsdem::study {
namespace {

/// One simulation to carry out.
struct Job {
    const Specimen* specimen;
    TimePlan plan;
    RunResult result = {};
};

/// Runs all jobs, as many side by side as there are threads: separate runs need no barriers, so this beats sharing one run's blocks.
void run_all(std::vector<Job>& jobs, const RunSettings& settings) {
    const int available = settings.threads > 0 ? settings.threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    const int workers = std::min(available, static_cast<int>(jobs.size()));
    detail::SharedProgress progress(jobs.size(), settings.on_progress);
    std::atomic<std::size_t> next{0};
    std::vector<std::exception_ptr> failures(jobs.size());

    const auto work = [&] {
        for (std::size_t j = next++; j < jobs.size(); j = next++) {
            RunSettings own{.threads = available / workers, .on_progress = {}};
            if (settings.on_progress) own.on_progress = [&progress, j](double fraction) { progress.update(j, fraction); };
            try {
                jobs[j].result = simulate(*jobs[j].specimen, jobs[j].plan, own);
            } catch (...) {
                failures[j] = std::current_exception();
            }
        }
    };
    std::vector<std::thread> team;
    for (int w = 1; w < workers; ++w) team.emplace_back(work);
    work();
    for (std::thread& thread : team) thread.join();
    for (const std::exception_ptr& failure : failures) {
        if (failure) std::rethrow_exception(failure);
    }
}

}  // namespace

std::string name_folder(std::string label) {
    std::replace(label.begin(), label.end(), ':', '-');
    return label;
}

std::string to_string(Materials materials) { return materials == Materials::exact ? "exact" : "own"; }

bool PairStudy::consistent() const {
    return std::all_of(models.begin(), models.end(), [](const PairedRun& model) { return model.consistent; });
}

bool PairStudy::diverged() const {
    const auto has_diverged = [](const RunResult& run) { return run.status == RunStatus::diverged; };
    return has_diverged(prototype) || has_diverged(shadow.run) ||
           std::any_of(models.begin(), models.end(), [&](const PairedRun& model) { return has_diverged(model.run); });
}

bool is_consistent(const RunDifference& difference, const RunDifference& shadow) {
    return difference.rms_velocity < kShadowFactor * shadow.rms_velocity || difference.rms_velocity < kRoundingLevel;
}

PairStudy run_pair(const PairMember& prototype, const std::vector<PairMember>& models, Materials materials, const RunSettings& settings) {
    const Specimen shadow = make_shadow(prototype.specimen);
    std::vector<Job> jobs{{&prototype.specimen, prototype.plan}, {&shadow, prototype.plan}};
    for (const PairMember& model : models) jobs.push_back({&model.specimen, model.plan});
    run_all(jobs, settings);

    PairStudy study{.materials = materials,
                    .prototype = std::move(jobs[0].result),
                    .shadow = {"shadow", prototype.similitude, {}, std::move(jobs[1].result), {}, true},
                    .models = {}};
    study.shadow.difference = compare_runs(study.prototype, study.shadow.run, prototype.similitude);
    for (std::size_t m = 0; m < models.size(); ++m) {
        PairedRun paired{models[m].label, models[m].similitude, models[m].distortions, std::move(jobs[m + 2].result), {}, true};
        paired.difference = compare_runs(study.prototype, paired.run, paired.similitude);
        if (materials == Materials::exact) paired.consistent = is_consistent(paired.difference, study.shadow.difference);
        study.models.push_back(std::move(paired));
    }
    return study;
}

}  // namespace musim::lsdem::study
