#include "lsdem/scene/motions.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "lsdem/scene/base_components.hpp"
#include "lsdem/scene/scene_error.hpp"
#include "scaling/detail/overloaded.hpp"

namespace musim::lsdem::scene {
namespace {

using scaling::detail::Overloaded;

std::string name_of(const SignalMotion& motion) {
    return std::visit(Overloaded{[](const StepSignal&) { return "step"; }, [](const SineSignal&) { return "sine"; },
                                 [](const HalfSineSignal&) { return "half_sine"; }, [](const RickerSignal&) { return "ricker"; },
                                 [](const SyntheticSignal&) { return "synthetic"; }},
                      motion.signal);
}

std::string name_of(const MotionEntry& entry) {
    if (!entry.name.empty()) return entry.name;
    return std::visit(Overloaded{[](std::monostate) { return std::string("still"); },
                                 [](const RecordMotion& motion) { return motion.file.stem().string(); },
                                 [](const SignalMotion& motion) { return name_of(motion); }},
                      entry.base_motion.source);
}

/// When the last component ends.
scaling::Time find_end(const BaseMotion& motion, const std::string& place) {
    double end = 0.0;
    for (const BaseComponent& c : make_base_components(motion, place)) {
        if (c.velocity.size() > 1) end = std::max(end, c.start + static_cast<double>(c.velocity.size() - 1) * c.dt);
    }
    return scaling::Time::from_value(end);
}

}  // namespace

std::vector<StageScene> expand_motions(const Scene& scene) {
    std::vector<StageScene> stages;
    for (std::size_t k = 0; k < scene.motions.size(); ++k) {
        const MotionEntry& entry = scene.motions[k];
        StageScene stage{.name = name_of(entry), .entry = k, .settle = entry.settle, .scene = scene};
        stage.scene.motions.clear();
        stage.scene.base_motion = entry.base_motion;
        scaling::Time& duration = stage.scene.time.duration;
        if (entry.duration) duration = *entry.duration;
        if (!(duration.value() > 0.0)) duration = find_end(entry.base_motion, fmt::format("/motions/{}/base_motion", k));
        if (!(duration.value() > 0.0)) {
            throw SceneError(fmt::format(
                "scene \"{}\": /motions/{}: the motion has no end that could give its duration; give a \"duration\"", scene.name, k));
        }
        for (int i = 0; i < entry.repeat; ++i) stages.push_back(stage);
    }
    return stages;
}

void require_single_motion(const Scene& scene, const std::string& what) {
    if (scene.motions.empty()) return;
    throw SceneError(fmt::format(
        "scene \"{}\": /motions: {} takes one motion (this is a list of them, for one structure); use `musim sequence`, or give a "
        "\"base_motion\" instead",
        scene.name, what));
}

}  // namespace musim::lsdem::scene
