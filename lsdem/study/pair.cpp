#include "lsdem/study/pair.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "lsdem/run/shared_progress.hpp"
#include "lsdem/study/twin_specimen.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "scaling/random_bits.hpp"
#include "scaling/side_by_side.hpp"

namespace musim::lsdem {
namespace {

/// A model is surely no twin, or surely one, where its judgement is this far from the limits: then no more twins are asked for.
constexpr double kSurelyInTime = 2.0;

/// The image whose every number is a power of two of the prototype's: all of its bits must agree.
constexpr double kExactLength = 0.25;

/// With the image that must agree in all bits.
std::size_t work_of_twins(std::size_t twins) { return twins > 0 ? twins + 1 : 0; }

/// One simulation to carry out.
struct Job {
    const PairMember* member;
    double work = 1.0;  ///< in runs of the prototype
    RunResult result = {};
};

/// Checkpoint of one run, in the folder of all.
std::optional<CheckpointSettings> checkpoint_of(const RunSettings& settings, const PairMember& member) {
    std::optional<CheckpointSettings> own = settings.checkpoint;
    if (own) own->file /= name_folder(member.label) + ".checkpoint";
    return own;
}

/// Runs all, as many side by side as there are threads: separate runs need no barriers, so this beats sharing one run's blocks. Progress
/// goes from `from` to `to`.
void run_all(std::vector<Job>& jobs, const RunSettings& settings, double from, double to) {
    const std::function<void(double)> report = [&](double part) {
        if (settings.observer.on_progress) settings.observer.on_progress(from + (to - from) * part);
    };
    std::vector<double> work_of;
    for (const Job& job : jobs) work_of.push_back(job.work);
    detail::SharedProgress progress(work_of, report);
    std::vector<std::function<void()>> work;
    for (std::size_t j = 0; j < jobs.size(); ++j) {
        work.emplace_back([&, j] {
            const RunSettings own{.threads = scaling::threads_of_each(settings.threads, jobs.size()),
                                  .observer = {.on_progress = [&progress, j](double part) { progress.update(j, part); }},
                                  .checkpoint = checkpoint_of(settings, *jobs[j].member)};
            jobs[j].result = run_member(*jobs[j].member, own);
            progress.update(j, 1.0);
        });
    }
    scaling::run_side_by_side(work, settings.threads);
}

bool has_diverged(const RunResult& run) { return run.status == RunStatus::diverged; }

PairedRun compare(const RunResult& prototype, const PairMember& member, RunResult run) {
    run.similitude = member.similitude;
    PairedRun paired{member.label, member.distortions, std::move(run), {}};
    paired.difference = compare_runs(prototype, paired.run, member.similitude);
    paired.trace = trace_run(prototype, paired.run, member.similitude);
    paired.material = member.material;
    paired.trace.settled_anew = !member.is_image && !member.scene && member.materials == Materials::exact;
    paired.is_image = member.is_image;
    paired.materials = member.materials;
    paired.scene = member.scene;
    paired.law = member.law;
    paired.asked = member.asked;
    return paired;
}

PairMember make_half_step(const PairMember& prototype) {
    PairMember half = prototype;
    half.label = "half step";
    half.plan = half.plan.with_finer_step(2);
    if (half.staged) half.staged = half.staged->with_finer_step(2);
    drop_frames(half);
    return half;
}

PairMember make_twin_member(const PairMember& prototype, const std::string& label, const TwinChoice& choice) {
    const scaling::Similitude similitude = scaling::make_similitude("exact", {.length = choice.length});
    PairMember twin = make_image(prototype, label, similitude);
    twin.specimen = make_twin(prototype.specimen, choice);
    drop_frames(twin);
    return twin;
}

/// A pair on its way.
class PairRunner {
  public:
    PairRunner(const PairMember& prototype, const std::vector<PairMember>& models, const RunSettings& settings, const PairSettings& judging,
               PairStudy& study)
        : prototype_(prototype), models_(models), settings_(settings), judging_(judging), study_(study) {
        most_twins_ = judging.twins.value_or(kMostTwins);
        expected_ = static_cast<double>(count_runs(models.size(), judging));
    }

    /// No fewer twins than these are run from now on, see PairSettings::on_spare.
    void expect_twins(std::size_t fewest) const {
        if (judging_.on_spare) judging_.on_spare(static_cast<double>(work_of_twins(most_twins_) - work_of_twins(fewest)) / expected_);
    }

    void run_models() {
        const PairMember half = make_half_step(prototype_);
        std::vector<Job> jobs{{&prototype_}};
        for (const PairMember& model : models_) jobs.push_back({&model});
        if (judging_.half_step) jobs.push_back({&half, kHalfStepWork});
        run(jobs);
        study_.prototype = std::move(jobs[0].result);
        for (std::size_t m = 0; m < models_.size(); ++m) {
            study_.models.push_back(compare(study_.prototype, models_[m], std::move(jobs[m + 1].result)));
        }
        if (judging_.half_step) study_.half_step = compare(study_.prototype, half, std::move(jobs.back().result));
    }

    /// Runs twins up to this number, and the image that must agree in all bits.
    void run_twins(std::size_t count) {
        const std::vector<TwinChoice> choices = choose_twins(count, judging_.seed);
        const std::size_t first = study_.twins.size();
        std::vector<PairMember> members;
        members.reserve(count - first + 1);
        for (std::size_t i = first; i < count; ++i) {
            members.push_back(make_twin_member(prototype_, fmt::format("twin {}", i + 1), choices[i]));
        }
        const bool checks_bits = !study_.same_bits.has_value();
        if (checks_bits) members.push_back(make_twin_member(prototype_, "quarter", {.length = kExactLength}));
        std::vector<Job> jobs;
        jobs.reserve(members.size());
        for (const PairMember& member : members) jobs.push_back({&member});
        run(jobs);
        for (std::size_t j = 0; j < jobs.size(); ++j) {
            const RunResult& run = jobs[j].result;
            const RunDifference difference = compare_runs(study_.prototype, run, members[j].similitude);
            if (first + j == count) {
                study_.same_bits = difference.bitwise_identical;
                continue;
            }
            study_.twins.push_back({choices[first + j], run.status, difference});
            study_.twin_traces.push_back(trace_run(study_.prototype, run, members[j].similitude));
            study_.twin_traces.back().image = !study_.twins.back().choice.last_place;
            widen_spread(run, members[j].similitude.velocity());
        }
    }

    void judge() {
        const Yardstick yardstick = study_.yardstick();
        for (PairedRun& model : study_.models) {
            model.judgement = yardstick.judge(model.trace);
            if (model.materials == Materials::own) model.judgement.agreement = Agreement::not_judged;
        }
    }

    std::size_t most_twins() const { return most_twins_; }

  private:
    void run(std::vector<Job>& jobs) {
        const double from = done_;
        for (const Job& job : jobs) done_ += job.work / expected_;
        run_all(jobs, settings_, std::min(from, 1.0), std::min(done_, 1.0));
    }

    void widen_spread(const RunResult& twin, double velocity) {
        const std::vector<Vector3>& of_prototype = study_.prototype.history.spine_velocity;
        study_.twin_spread.resize(of_prototype.size(), Vector3::Zero());
        for (std::size_t i = 0; i < std::min(of_prototype.size(), twin.history.spine_velocity.size()); ++i) {
            const Vector3 apart = twin.history.spine_velocity[i] / velocity - of_prototype[i];
            study_.twin_spread[i] = study_.twin_spread[i].cwiseMax(apart.cwiseAbs());
        }
    }

    const PairMember& prototype_;
    const std::vector<PairMember>& models_;
    const RunSettings& settings_;
    const PairSettings& judging_;
    PairStudy& study_;
    std::size_t most_twins_ = 0;
    double expected_ = 1.0, done_ = 0.0;
};

/// Do the twins so far decide all models?
bool is_decided(const PairStudy& study) {
    const Yardstick yardstick = study.yardstick();
    const std::optional<Yardstick::ImageLead> images = yardstick.lead_of_images();
    if (yardstick.is_within_run() || (images && images->lead > kSurelyInTime)) return false;
    return std::all_of(study.models.begin(), study.models.end(), [](const PairedRun& model) {
        return model.judgement.within_rounding || model.judgement.lead < kSurelyInTime || model.judgement.lead > 2.0 * kPartsTooEarly;
    });
}

}  // namespace

Agreement PairStudy::scaling() const {
    if (!same_bits.value_or(true)) return Agreement::differ;
    const std::optional<Yardstick::ImageLead> images = yardstick().lead_of_images();
    return images ? images->agreement() : Agreement::agree;
}

Agreement PairStudy::agreement() const {
    Agreement all = scaling();
    for (const PairedRun& model : models) all = worst({all, model.judgement.agreement});
    return all;
}

bool PairStudy::has(Materials materials) const {
    return std::any_of(models.begin(), models.end(), [&](const PairedRun& model) { return model.materials == materials; });
}

bool PairStudy::consistent() const {
    Agreement all = scaling();
    for (const PairedRun& model : models) {
        if (model.materials == Materials::exact) all = worst({all, model.judgement.agreement});
    }
    return all == Agreement::agree;
}

bool PairStudy::diverged() const {
    return has_diverged(prototype) || std::any_of(models.begin(), models.end(), [](const PairedRun& m) { return has_diverged(m.run); }) ||
           std::any_of(twins.begin(), twins.end(), [](const PairedTwin& twin) { return twin.status == RunStatus::diverged; });
}

std::vector<TwinChoice> choose_twins(std::size_t twins, std::uint64_t seed) {
    std::vector<TwinChoice> choices = choose_models(twins, seed);
    for (std::size_t i = 1; i < twins; i += 2) choices[i] = {.directions = scaling::random_bits(~seed, i), .last_place = true};
    return choices;
}

std::size_t count_runs(std::size_t models, const PairSettings& judging) {
    const std::size_t half_step = judging.half_step ? static_cast<std::size_t>(kHalfStepWork) : 0;
    return 1 + models + half_step + work_of_twins(judging.twins.value_or(kMostTwins));
}

PairStudy run_pair(const PairMember& prototype, const std::vector<PairMember>& models, const RunSettings& settings,
                   const PairSettings& judging) {
    PairStudy study;
    PairRunner work(prototype, models, settings, judging, study);
    // exact models that agree within rounding need none
    const bool exact = !models.empty() && std::all_of(models.begin(), models.end(),
                                                      [](const PairMember& model) { return model.materials == Materials::exact; });
    const std::size_t fewest = exact ? 0 : kFewestTwins;
    work.expect_twins(judging.twins.value_or(fewest));
    work.run_models();
    work.judge();
    const bool same = exact && std::all_of(study.models.begin(), study.models.end(),
                                           [](const PairedRun& model) { return model.judgement.within_rounding; });
    const bool wants_twins = judging.twins ? *judging.twins > 0 : !same;
    if (!wants_twins || has_diverged(study.prototype)) return study;
    work.expect_twins(judging.twins.value_or(kFewestTwins));
    work.run_twins(judging.twins ? *judging.twins : kFewestTwins);
    work.judge();
    if (judging.twins || is_decided(study)) return study;
    work.expect_twins(work.most_twins());
    work.run_twins(work.most_twins());
    work.judge();
    return study;
}

}  // namespace musim::lsdem
