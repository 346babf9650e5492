#include "lsdem/study/run.hpp"

#include <algorithm>
#include <cmath>

#include "lsdem/scene/build_model.hpp"

namespace musim::lsdem::study {
namespace {

/// Nearest whole number, one at least.
std::uint64_t round_count(double value) { return static_cast<std::uint64_t>(std::max(1.0, std::round(value))); }

}  // namespace

Specimen make_specimen(const scene::Scene& scene) {
    scene::BuiltModel built = scene::build_model(scene);
    return {std::move(built.model), {built.structure.spine.block, built.structure.spine.level}, std::move(built.structure.layer)};
}

TimePlan make_time_plan(const scene::Scene& scene, const Model& model) {
    TimePlan plan{.time_step = scene::compute_time_step(scene, model).value()};
    const double spine_rate = scene.output.spine_rate.value();
    if (spine_rate > 0.0) {
        const double interval = 1.0 / spine_rate;
        if (scene.time.step) {
            plan.steps_per_sample = round_count(interval / plan.time_step);
        } else {
            plan.steps_per_sample = round_count(std::ceil(interval / plan.time_step));
            plan.time_step = interval / static_cast<double>(plan.steps_per_sample);
        }
    }
    const double sample_interval = static_cast<double>(plan.steps_per_sample) * plan.time_step;
    plan.samples = round_count(scene.time.duration.value() / sample_interval);
    if (scene.output.frame_rate) plan.samples_per_frame = round_count(1.0 / (scene.output.frame_rate->value() * sample_interval));
    return plan;
}

RunResult run_scene(const scene::Scene& scene, const RunSettings& settings) {
    const Specimen specimen = make_specimen(scene);
    return simulate(specimen, make_time_plan(scene, specimen.model), settings);
}

}  // namespace musim::lsdem::study
