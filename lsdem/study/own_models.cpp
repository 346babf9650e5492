#include "lsdem/study/own_models.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>

#include "lsdem/run/shared_progress.hpp"
#include "lsdem/scene/specimen_seed.hpp"
#include "lsdem/study/pair_text.hpp"
#include "scaling/side_by_side.hpp"

namespace musim::lsdem {
namespace {

constexpr double kBeyondChanceEach = kBeyondChance / static_cast<double>(std::size(kReportedQuantities));

const QuantityCheck* find_same(const std::vector<QuantityCheck>& checks, const QuantityCheck& wanted) {
    const auto found = std::find_if(checks.begin(), checks.end(), [&](const QuantityCheck& check) {
        return check.key == wanted.key && check.level == wanted.level && check.name == wanted.name;
    });
    return found == checks.end() ? nullptr : &*found;
}

std::string describe_quantity(const PairStudy& study, const OwnQuantity& quantity) {
    std::vector<std::string> chance;
    if (!study.twins.empty()) chance.push_back("twins " + format_range(quantity.check.twins));
    if (quantity.of_specimens) chance.push_back("other specimens " + format_range(*quantity.of_specimens));
    if (quantity.check.difference < kRoundingLevel) {
        return quantity.name + " the same" + (chance.empty() ? "" : fmt::format(" ({})", join_words(chance)));
    }
    const char* const side = quantity.check.model < quantity.check.prototype ? "lower" : "higher";
    const std::string text = fmt::format("{} {} {}", quantity.name, format_percent(quantity.check.difference), side);
    if (chance.empty()) return text;
    return text + fmt::format(" ({}: {})", join_words(chance), quantity.beyond_chance ? "more than chance" : "chance may do that");
}

std::string describe_acceptance(const PairStudy& study, const OwnJudgement& judgement, const PairedRun& model) {
    const double tolerance = *study.tolerance;
    if (model.run.status == RunStatus::diverged) return " NOT accepted: it diverged.";
    const std::string limit = format_percent(tolerance);
    if (*judgement.accepted && model.judgement.within_rounding) return " Accepted: the prototype again, to rounding.";
    if (*judgement.accepted) {
        const char* const others = study.specimen_traces.empty() ? "" : " and other specimens";
        return fmt::format(" Accepted: all within {}{}.", limit, study.twins.empty() ? "" : fmt::format(", as twins{} are", others));
    }
    std::vector<std::string> beyond;
    for (const OwnQuantity& quantity : judgement.quantities) {
        if (quantity.check.difference > tolerance) beyond.push_back(quantity.name);
    }
    if (!beyond.empty()) {
        const bool several = beyond.size() > 1 || beyond.front().ends_with('s');
        return fmt::format(" NOT accepted: {} differ{} by more than {}.", join_words(beyond), several ? "" : "s", limit);
    }
    return fmt::format(" NOT accepted: within {}, but chance alone does more; one test cannot show that much.", limit);
}

}  // namespace

std::vector<RunTrace> run_other_specimens(const Scene& scene, const RunResult& prototype, std::size_t count, const RunSettings& settings) {
    std::vector<RunTrace> traces(count);
    const int each = scaling::threads_of_each(settings.threads, count);
    detail::SharedProgress progress(count, settings.observer.on_progress);
    std::vector<std::function<void()>> jobs;
    for (std::size_t i = 0; i < count; ++i) {
        jobs.emplace_back([&, i] {
            constexpr double kLaying = 0.5;  // of the progress of one, a guess
            const Scene other = with_seed(scene, seed_of(scene) + 1 + i);
            const auto settings_of = [&](const char* what) {
                RunSettings own{.threads = each, .checkpoint = settings.checkpoint};
                if (own.checkpoint) own.checkpoint->file /= fmt::format("other-{}.{}", i + 1, what);
                return own;
            };
            RunSettings laying = settings_of("specimen");
            laying.observer.on_preparation = [&](double part) { progress.update(i, kLaying * part); };
            PairMember member = lay_member("other", other, scaling::Similitude(), laying);
            drop_frames(member);
            RunSettings running = settings_of("checkpoint");
            running.observer.on_progress = [&](double part) { progress.update(i, kLaying + (1.0 - kLaying) * part); };
            const RunResult run = run_member(member, running);
            traces[i] = trace_run(prototype, run, member.similitude);
            progress.update(i, 1.0);
        });
    }
    scaling::run_side_by_side(jobs, settings.threads);
    return traces;
}

OwnJudgement judge_own(const PairStudy& study, const PairedRun& model) {
    OwnJudgement judgement;
    const bool twins_part = study.yardstick().is_within_run();
    const std::vector<QuantityCheck> of_specimens = Yardstick(study.prototype, study.specimen_traces).check_quantities(model.trace);
    bool accepted = model.run.status != RunStatus::diverged;
    for (const auto& [key, name] : kReportedQuantities) {
        const QuantityCheck* const check = find_top(model.judgement.quantities, key);
        if (check == nullptr) continue;
        OwnQuantity quantity{name, *check, {}, check->difference > kPartingLevel};
        if (twins_part) quantity.beyond_chance = check->probability < kBeyondChanceEach;
        if (!study.specimen_traces.empty()) {
            const QuantityCheck& other = *find_same(of_specimens, *check);
            quantity.of_specimens = other.twins;
            quantity.beyond_chance = quantity.beyond_chance && other.probability < kBeyondChanceEach;
        }
        // a model that does not part from the prototype owes nothing to chance
        double largest = check->difference;
        if (!model.judgement.within_rounding) {
            largest = std::max({largest, check->twins.largest(), quantity.of_specimens.value_or(DifferenceRange()).largest()});
        }
        accepted = accepted && largest <= study.tolerance.value_or(0.0);
        judgement.quantities.push_back(std::move(quantity));
    }
    if (study.tolerance) judgement.accepted = accepted;
    return judgement;
}

std::string describe_own(const PairStudy& study, const PairedRun& model) {
    const OwnJudgement judgement = judge_own(study, model);
    std::vector<std::string> parts;
    for (const OwnQuantity& quantity : judgement.quantities) parts.push_back(describe_quantity(study, quantity));
    const std::string material = model.scene ? "" : " of " + model.material;
    std::string text = fmt::format("Model {}{}: {}.", model.name(), material, join_words(parts));
    if (judgement.accepted) text += describe_acceptance(study, judgement, model);
    return text;
}

}  // namespace musim::lsdem
