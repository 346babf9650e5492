#include "lsdem/run/sequence_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "lsdem/base_motion.hpp"
#include "lsdem/scene/base_components.hpp"
#include "lsdem/scene/motions.hpp"
#include "lsdem/scene/scene_error.hpp"
#include "scaling/setting.hpp"

namespace musim::lsdem {
namespace {

/// A folder's name stays readable in a listing.
constexpr std::size_t kLongestName = 40;

/// stage-01-NAME, with a dash for what is neither letter nor digit.
std::string make_folder_name(std::size_t stage, std::size_t stages, const std::string& name) {
    std::string plain = name.substr(0, kLongestName);
    for (char& c : plain) {
        if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_') c = '-';
    }
    const std::size_t digits = std::max<std::size_t>(2, std::to_string(stages).size());
    return fmt::format("stage-{:0{}}-{}", stage + 1, digits, plain);
}

double find_peak_velocity(const BaseComponents& motion) {
    double peak = 0.0;
    for (const BaseComponent& c : motion.shift)
        for (const double v : c.velocity) peak = std::max(peak, std::abs(v));
    return peak;
}

double find_peak_acceleration(const BaseComponents& motion) {
    double peak = 0.0;
    for (const BaseComponent& c : motion.shift)
        for (std::size_t k = 1; k < c.velocity.size(); ++k) peak = std::max(peak, std::abs(c.velocity[k] - c.velocity[k - 1]) / c.dt);
    return peak;
}

/// Refuses two motions between which the base would jump.
void check_seam(const Scene& scene, const SequenceStage& before, std::size_t entry, const SequenceStage& after) {
    const auto name = [&](const SequenceStage& stage) { return fmt::format("{} (\"{}\")", stage.folder, stage.name); };
    const Vector3 end = BaseMotion(before.motion).velocity(before.plan.duration());
    if (after.settle) {
        if (end.isZero(0.0) || find_peak_acceleration(before.motion) > 0.0) return;
        throw SceneError(
            fmt::format("{}: /motions/{}: at the end of {} the base still has the velocity that it took at once (nothing says how it is "
                        "to stop for {}); use a motion that ends at rest",
                        scene.place(), entry, name(before), name(after)));
    }
    const double jump = (BaseMotion(after.motion).velocity(0.0) - end).norm();
    if (jump <= kSeamlessVelocity * std::max(find_peak_velocity(before.motion), find_peak_velocity(after.motion))) return;
    throw SceneError(
        fmt::format("{}: /motions/{}: the base would jump by {:.3g} m/s from {} to {} (without a rest phase between them one must begin "
                    "with the velocity that the other ends with); leave \"settle\": false out, or give the first a longer \"duration\"",
                    scene.place(), entry, jump, name(before), name(after)));
}

}  // namespace

SequencePlan plan_sequence(const Scene& scene, Sampling sampling) {
    std::vector<StageScene> scenes = expand_motions(scene);
    if (scenes.empty()) {
        throw SceneError(fmt::format("{}: has no list of motions (one motion is a plain run)", scene.place()),
                         Remedy{"use ", Setting::single_run, ", or give \"motions\""});
    }
    SequencePlan plan;
    plan.specimen = make_upright_specimen(scenes.front().scene);
    plan.settling = find_preparation(scene, plan.specimen).settling;
    for (std::size_t k = 0; k < scenes.size(); ++k) {
        SequenceStage stage{.name = scenes[k].name,
                            .folder = make_folder_name(k, scenes.size(), scenes[k].name),
                            .settle = scenes[k].settle,
                            .scene = std::move(scenes[k].scene),
                            .motion = {},
                            .plan = {}};
        stage.motion =
            make_base_components(stage.scene.base_motion, fmt::format("{}: /motions/{}/base_motion", scene.place(), scenes[k].entry));
        if (stage.motion.turns()) {
            throw SceneError(
                fmt::format("{}: /motions/{}: turns the base (in a list of motions each begins where the one before left the "
                            "base, which only slides there); take its turn out, or run it as a scene of its own",
                            scene.place(), scenes[k].entry));
        }
        plan.stages.push_back(std::move(stage));
    }
    // one step for all, that fits the samples of the shortest
    const auto shortest = std::min_element(plan.stages.begin(), plan.stages.end(), [](const SequenceStage& a, const SequenceStage& b) {
        return a.scene.time.duration.value() < b.scene.time.duration.value();
    });
    const double time_step = make_time_plan(shortest->scene, plan.specimen.model, sampling).time_step;
    for (std::size_t k = 0; k < plan.stages.size(); ++k) {
        plan.stages[k].plan = make_time_plan(plan.stages[k].scene, time_step);
        if (k > 0) check_seam(scene, plan.stages[k - 1], scenes[k].entry, plan.stages[k]);
    }
    return plan;
}

BaseComponents make_stop(const BaseComponents& motion, const Vector3& velocity) {
    const double time = velocity.cwiseAbs().maxCoeff() / find_peak_acceleration(motion);
    BaseComponents stop;
    for (Eigen::Index axis = 0; axis < 3; ++axis)
        stop.shift[static_cast<std::size_t>(axis)] = {.start = 0.0, .dt = time, .velocity = {velocity[axis], 0.0}};
    return stop;
}

}  // namespace musim::lsdem
