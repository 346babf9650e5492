#include "tests/benches/similitude_bench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <stdexcept>

#include "lsdem/run/run.hpp"
#include "lsdem/study/pair.hpp"
#include "scaling/side_by_side.hpp"

namespace musim::lsdem {
namespace {

/// Two curves are one up to this many times what the copy differs by: both start from one rounding error per block.
constexpr double kCopyFactor = 3.0;

/// A run scaled back.
struct ScaledRun {
    ScaledResponse response;
    bool diverged = false;
};

/// A prototype, and its copy, blocks moved by a last place, as a measure of what rounding becomes.
struct PrototypeRuns {
    Scene scene;
    ScaledRun run, copy;
};

ScaledResponse scale_back(const RunResult& run, BenchScene scene, double start, const TwinScales& scales) {
    const scaling::Similitude& similitude = scales.similitude;
    const History& history = run.history;
    const std::size_t count = run.spine.size(), top = count - 1;
    ScaledResponse response;
    for (std::size_t k = 0; k < history.samples(); ++k) {
        const std::size_t i = k * count + top;
        const double behind = history.base[k].displacement.x() - (history.spine_position[i].x() - history.spine_position[top].x());
        response.time.push_back(history.time[k] / similitude.time() - start);
        response.value.push_back(scene == BenchScene::rock ? -history.spine_rotation[i].y() * scales.heights
                                                           : behind / similitude.length());
        response.speed.push_back((history.base[k].velocity.x() - history.spine_velocity[i].x()) / similitude.velocity());
    }
    return response;
}

/// When the base of a prototype begins to move [s].
double find_start(const Scene& prototype) { return std::get<SignalMotion>(prototype.base_motion.source).start.value(); }

ScaledRun run_scaled(const Specimen& specimen, const TimePlan& plan, BenchScene scene, double start, const TwinScales& scales) {
    const RunResult run = simulate(specimen, plan);
    return {scale_back(run, scene, start, scales), run.status == RunStatus::diverged};
}

/// The model takes the prototype's steps, scaled, unless its springs ask for others.
ScaledRun run_model(const SimilitudeCase& wanted, const Scene& prototype) {
    const Scene scene = make_model_scene(wanted.scene, wanted.scales, wanted.broken);
    const Specimen specimen = make_upright_specimen(scene);
    const TimePlan plan = wanted.broken.shifts_frequencies()
                              ? make_time_plan(scene, specimen.model, Sampling::at_rate)
                              : make_time_plan(prototype, make_upright_specimen(prototype).model).scaled(wanted.scales.similitude.time());
    return run_scaled(specimen, plan, wanted.scene, wanted.broken.of(BrokenGroup::duration) * find_start(prototype), wanted.scales);
}

/// A parabola through three values at −1, 0, 1: where it is greatest, and how great.
struct Vertex {
    double place, value;
};

Vertex find_vertex(double before, double at, double after) {
    const double slope = 0.5 * (after - before), bend = before - 2.0 * at + after;
    if (!(bend < 0.0)) return {0.0, at};
    return {-slope / bend, at - 0.5 * slope * slope / bend};
}

double rms_difference(const std::vector<double>& prototype, const std::vector<double>& model) {
    double difference = 0.0, size = 0.0;
    for (std::size_t k = 0; k < prototype.size(); ++k) {
        difference += (model[k] - prototype[k]) * (model[k] - prototype[k]);
        size += prototype[k] * prototype[k];
    }
    return std::sqrt(difference / size);
}

}  // namespace

double compare_responses(const ScaledResponse& prototype, const ScaledResponse& model) {
    if (prototype.time.size() != model.time.size()) {
        throw std::invalid_argument(fmt::format("responses: {} and {} samples cannot be compared (must be as many); give both one plan",
                                                prototype.time.size(), model.time.size()));
    }
    return std::max(rms_difference(prototype.value, model.value), rms_difference(prototype.speed, model.speed));
}

double measure(const ScaledResponse& response, Measure which) {
    const std::vector<double>& value = response.value;
    const auto size = [&](std::size_t k) { return std::abs(value[k]); };
    std::size_t peak = 0;
    for (std::size_t k = 0; k < value.size(); ++k) {
        if (size(k) > size(peak)) peak = k;
    }
    if (peak == 0 || peak + 1 == value.size()) return which == Measure::peak ? size(peak) : response.time[peak];
    const Vertex vertex = find_vertex(size(peak - 1), size(peak), size(peak + 1));
    return which == Measure::peak ? vertex.value : response.time[peak] + vertex.place * (response.time[peak + 1] - response.time[peak]);
}

bool SimilitudeOutcome::holds() const {
    if (diverged) return false;
    if (wanted.collapses) return difference <= yardstick;
    const Prediction& theory = wanted.prediction;
    const bool parts = std::abs(theory.ratio - 1.0) > theory.tolerance;
    return std::abs(ratio - theory.ratio) <= theory.tolerance && (!parts || difference > yardstick);
}

bool all_hold(const std::vector<SimilitudeOutcome>& outcomes) {
    return std::all_of(outcomes.begin(), outcomes.end(), [](const SimilitudeOutcome& outcome) { return outcome.holds(); });
}

std::vector<SimilitudeOutcome> run_similitude_cases(const std::vector<SimilitudeCase>& cases, int threads,
                                                    const std::function<void(double)>& on_progress) {
    const TwinScales whole{scaling::Similitude()};
    std::map<BenchScene, PrototypeRuns> prototypes;
    for (const SimilitudeCase& wanted : cases) prototypes[wanted.scene].scene = make_bench_scene(wanted.scene);

    std::vector<ScaledRun> models(cases.size());
    std::vector<std::function<void()>> jobs;
    for (std::size_t c = 0; c < cases.size(); ++c) {
        jobs.emplace_back([&, c] { models[c] = run_model(cases[c], prototypes.at(cases[c].scene).scene); });
    }
    for (auto& entry : prototypes) {
        const BenchScene which = entry.first;
        PrototypeRuns& runs = entry.second;
        const auto add = [&jobs, &runs, &whole, which](ScaledRun& to, const std::function<Specimen()>& make) {
            jobs.emplace_back([&runs, &whole, &to, which, make] {
                const TimePlan plan = make_time_plan(runs.scene, make_upright_specimen(runs.scene).model);
                to = run_scaled(make(), plan, which, find_start(runs.scene), whole);
            });
        };
        add(runs.run, [&runs] { return make_upright_specimen(runs.scene); });
        add(runs.copy, [&runs] { return make_moved_copy(make_upright_specimen(runs.scene)); });
    }
    scaling::run_side_by_side(jobs, threads, on_progress);

    std::vector<SimilitudeOutcome> outcomes;
    for (std::size_t c = 0; c < cases.size(); ++c) {
        const PrototypeRuns& prototype = prototypes.at(cases[c].scene);
        const double copy = compare_responses(prototype.run.response, prototype.copy.response);
        SimilitudeOutcome outcome{.wanted = cases[c],
                                  .yardstick = std::max(kRoundingLevel, kCopyFactor * copy),
                                  .diverged = prototype.run.diverged || prototype.copy.diverged || models[c].diverged,
                                  .prototype = prototype.run.response,
                                  .model = std::move(models[c].response)};
        if (!outcome.diverged) {
            outcome.ratio = measure(outcome.model, cases[c].measure) / measure(outcome.prototype, cases[c].measure);
            outcome.difference = compare_responses(outcome.prototype, outcome.model);
        }
        outcomes.push_back(std::move(outcome));
    }
    return outcomes;
}

std::string make_similitude_csv(const std::vector<SimilitudeOutcome>& outcomes) {
    std::string csv =
        "law,scene,length,friction,gravity,density,acceleration,heights,broken,factor,measure,predicted,tolerance,measured,difference,"
        "yardstick,holds\n";
    for (const SimilitudeOutcome& o : outcomes) {
        const SimilitudeCase& c = o.wanted;
        const scaling::Similitude& s = c.scales.similitude;
        fmt::format_to(std::back_inserter(csv), "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", c.law, to_string(c.scene),
                       s.length(), s.friction(), s.gravity(), s.density(), s.acceleration(), c.scales.heights, to_string(c.broken.group),
                       c.broken.factor, to_string(c.measure), c.prediction.ratio, c.prediction.tolerance, o.ratio, o.difference,
                       o.yardstick, o.holds() ? 1 : 0);
    }
    return csv;
}

}  // namespace musim::lsdem
