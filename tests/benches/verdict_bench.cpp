#include "tests/benches/verdict_bench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "lsdem/response/line_fit.hpp"
#include "lsdem/run/run.hpp"
#include "lsdem/run/shared_progress.hpp"
#include "lsdem/scene/motions.hpp"
#include "lsdem/study/trace_file.hpp"
#include "lsdem/study/twin_files.hpp"
#include "lsdem/study/twin_specimen.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "scaling/random_bits.hpp"
#include "scaling/side_by_side.hpp"

namespace musim::lsdem {
namespace {

namespace fs = std::filesystem;

/// Lengths of models, and of wrong ones, are drawn apart from those of the twins, and from each other's.
constexpr std::uint64_t kSeedOfModels = 0x6d6f64656c73, kSeedOfErrors = 0x6572726f7273;

/// A size counts for the line of leads when half of its models are this many deviations above the twins: below, the lead is chance, not
/// the error.
constexpr double kSeenLead = 2.0;

/// A run to be held against the prototype.
struct Trial {
    std::string name;  ///< of its file
    TwinChoice choice;
    std::optional<ModelError> error = {};
    double size = 0.0;
    RunTrace trace = {};
    bool known = false;
};

JudgedModel to_judged(double length, const Judgement& judgement) {
    return {length, judgement.agreement, judgement.lead, judgement.lead_time, judgement.least_probability};
}

/// One scene on its way.
class BenchWork {
  public:
    BenchWork(const Scene& scene, const VerdictBenchPlan& plan, const TwinSettings& settings)
        : scene_(scene), plan_(plan), settings_(settings) {
        if (!settings.directory.empty()) {
            folder_ = twin_folder(settings.directory, scene, settings.version);
            make_folder(folder_);
        }
        for (std::size_t s = 0; s < plan.sets; ++s) {
            add_trials(fmt::format("twin_{}", plan.seed + s), choose_twins(plan.twins, plan.seed + s));
            add_trials(fmt::format("exact_{}", plan.seed + s), choose_models(plan.models, (plan.seed + s) ^ kSeedOfModels));
        }
        for (const ModelError error : plan.errors) {
            for (const double size : sizes_of(error)) {
                add_trials(fmt::format("{}_{:g}_{}", to_string(error), size, plan.seed),
                           choose_models(plan.images, (plan.seed + static_cast<std::uint64_t>(error)) ^ kSeedOfErrors), error, size);
            }
        }
    }

    VerdictBench run() {
        run_missing();
        VerdictBench bench{scene_.name, {}, {}};
        std::size_t next = 0;
        const auto take = [&](std::size_t count) {
            std::vector<Trial> trials(trials_.begin() + static_cast<std::ptrdiff_t>(next),
                                      trials_.begin() + static_cast<std::ptrdiff_t>(next + count));
            next += count;
            return trials;
        };
        std::vector<std::vector<Trial>> twins;
        for (std::size_t s = 0; s < plan_.sets; ++s) {
            twins.push_back(take(plan_.twins));
            const Yardstick yardstick = make_yardstick(twins.back());
            JudgedSet& set = bench.sets.emplace_back(JudgedSet{plan_.seed + s, yardstick.horizon(), yardstick.lead_of_images(), {}});
            for (const Trial& model : take(plan_.models)) {
                set.models.push_back(to_judged(model.choice.length, yardstick.judge(model.trace)));
            }
        }
        for (const ModelError error : plan_.errors) {
            for (const double size : sizes_of(error)) bench.errors.push_back(judge_error(error, size, take(plan_.images), twins));
        }
        return bench;
    }

  private:
    std::vector<double> sizes_of(ModelError error) const {
        return error == ModelError::lost_friction ? std::vector<double>{1.0} : plan_.sizes;
    }

    void add_trials(const std::string& name, const std::vector<TwinChoice>& choices, std::optional<ModelError> error = {},
                    double size = 0.0) {
        for (std::size_t i = 0; i < choices.size(); ++i) {
            trials_.push_back({.name = fmt::format("{}_{}.json", name, i), .choice = choices[i], .error = error, .size = size});
        }
    }

    void run_missing() {
        std::vector<std::size_t> pending;
        for (Trial& trial : trials_) {
            if (folder_.empty()) break;
            if (auto trace = read_trace(folder_ / trial.name)) {
                trial.trace = std::move(*trace);
                trial.known = true;
            }
        }
        for (std::size_t i = 0; i < trials_.size(); ++i) {
            if (!trials_[i].known) pending.push_back(i);
        }
        specimen_ = lay_twin_specimen(scene_, folder_, settings_, static_cast<double>(1 + pending.size()));
        time_plan_ = make_time_plan(scene_, specimen_.model);
        time_plan_.samples_per_frame = 0;
        detail::SharedProgress progress(1 + pending.size(), settings_.observer.on_progress);
        prototype_ = simulate(
            specimen_, time_plan_,
            {.threads = settings_.threads, .observer = {.on_progress = [&](double part) { progress.update(pending.size(), part); }}});
        std::vector<std::function<void()>> jobs;
        for (std::size_t j = 0; j < pending.size(); ++j) {
            jobs.emplace_back([this, &progress, &trial = trials_[pending[j]], j] {
                run_trial(trial, [&progress, j](double part) { progress.update(j, part); });
            });
        }
        scaling::run_side_by_side(jobs, settings_.threads);
    }

    void run_trial(Trial& trial, const std::function<void(double)>& on_progress) const {
        const scaling::Similitude similitude = scaling::make_similitude("exact", {.length = trial.choice.length});
        Specimen specimen = make_twin(specimen_, trial.choice);
        if (trial.error) inject(*trial.error, trial.size, specimen.model);
        const RunResult run = simulate(specimen, time_plan_.scaled(similitude.time()), {.observer = {.on_progress = on_progress}});
        trial.trace = trace_run(prototype_, run, similitude);
        trial.trace.image = !trial.choice.last_place;
        if (!folder_.empty()) write_trace(folder_ / trial.name, trial.trace);
    }

    Yardstick make_yardstick(const std::vector<Trial>& twins) const {
        std::vector<RunTrace> traces;
        traces.reserve(twins.size());
        for (const Trial& twin : twins) traces.push_back(twin.trace);
        return {prototype_, std::move(traces)};
    }

    JudgedError judge_error(ModelError error, double size, const std::vector<Trial>& wrong,
                            const std::vector<std::vector<Trial>>& twins) const {
        JudgedError judged{error, size, {}, {}};
        for (std::size_t i = 0; i < wrong.size(); ++i) {
            const std::vector<Trial>& set = twins[i % twins.size()];
            judged.alone.push_back(to_judged(wrong[i].choice.length, make_yardstick(set).judge(wrong[i].trace)));
            // the images of the set make the same error: other wrong models are what they would be
            std::vector<Trial> shared = set;
            std::size_t next = i;
            for (Trial& twin : shared) {
                if (twin.trace.image) twin = wrong[++next % wrong.size()];
            }
            const Yardstick yardstick = make_yardstick(shared);
            JudgedModel model = to_judged(wrong[i].choice.length, yardstick.judge(wrong[i].trace));
            const Yardstick::ImageLead images = yardstick.lead_of_images().value_or(Yardstick::ImageLead{});
            model.agreement = worst({model.agreement, images.agreement()});
            model.lead = images.lead, model.lead_time = images.time;
            judged.shared.push_back(model);
        }
        return judged;
    }

    const Scene& scene_;
    const VerdictBenchPlan& plan_;
    const TwinSettings& settings_;
    fs::path folder_;  ///< empty: nothing is kept
    std::vector<Trial> trials_;
    Specimen specimen_;
    TimePlan time_plan_;
    RunResult prototype_;
};

Tally make_tally(std::size_t count, std::size_t of) {
    using Binomial = boost::math::binomial_distribution<double>;
    if (of == 0) return {};
    const auto trials = static_cast<double>(of), found = static_cast<double>(count);
    return {count, of, count == 0 ? 0.0 : Binomial::find_lower_bound_on_p(trials, found, 0.025),
            count == of ? 1.0 : Binomial::find_upper_bound_on_p(trials, found, 0.025)};
}

std::size_t count_of(const std::vector<JudgedModel>& models, Agreement agreement) {
    return static_cast<std::size_t>(
        std::count_if(models.begin(), models.end(), [&](const JudgedModel& model) { return model.agreement == agreement; }));
}

}  // namespace

VerdictBench run_verdict_bench(const Scene& scene, const VerdictBenchPlan& plan, const TwinSettings& settings) {
    require_single_motion(scene, "a study of verdicts");
    return BenchWork(scene, plan, settings).run();
}

Tally tally(const std::vector<JudgedModel>& models, Agreement agreement) { return make_tally(count_of(models, agreement), models.size()); }

Tally tally_exact(const std::vector<VerdictBench>& benches, Agreement agreement) {
    std::size_t count = 0, of = 0;
    for (const VerdictBench& bench : benches) {
        for (const JudgedSet& set : bench.sets) count += count_of(set.models, agreement), of += set.models.size();
    }
    return make_tally(count, of);
}

std::optional<FoundSize> find_size(const VerdictBench& bench, ModelError error, std::vector<JudgedModel> JudgedError::*models) {
    std::vector<double> x, y;
    for (const JudgedError& judged : bench.errors) {
        if (judged.error != error) continue;
        std::vector<double> leads;
        for (const JudgedModel& model : judged.*models) leads.push_back(model.lead);
        std::nth_element(leads.begin(), leads.begin() + static_cast<std::ptrdiff_t>(leads.size() / 2), leads.end());
        if (leads.empty() || leads[leads.size() / 2] < kSeenLead) continue;
        for (const double lead : leads) x.push_back(std::log10(judged.size)), y.push_back(lead);
    }
    if (x.empty() || *std::min_element(x.begin(), x.end()) == *std::max_element(x.begin(), x.end())) return std::nullopt;
    const LineFit line = fit_line(x, y);
    if (!(line.slope > 0.0)) return std::nullopt;
    const auto count = static_cast<double>(x.size());
    double mean = 0.0, spread = 0.0;
    for (const double value : x) mean += value / count;
    for (const double value : x) spread += (value - mean) * (value - mean);
    const double sd = line.slope_error * std::sqrt(spread);
    // quantiles of the normal distribution: 95 % on one side, 95 % between both
    constexpr double kOf95 = 1.645, kBothSides = 1.96;
    const double at = (kPartsTooEarly + kOf95 * sd - line.intercept) / line.slope;
    const double error_of_at = sd * std::sqrt(1.0 / count + (at - mean) * (at - mean) / spread) / line.slope;
    return FoundSize{std::pow(10.0, at), std::pow(10.0, at - kBothSides * error_of_at), std::pow(10.0, at + kBothSides * error_of_at)};
}

}  // namespace musim::lsdem
