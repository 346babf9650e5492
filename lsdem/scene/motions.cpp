#include "lsdem/scene/motions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "lsdem/scene/base_components.hpp"
#include "lsdem/scene/detail/scene_fields.hpp"
#include "lsdem/scene/scene_error.hpp"
#include "scaling/detail/overloaded.hpp"
#include "scaling/setting.hpp"

namespace musim::lsdem {
namespace {

using scaling::detail::Overloaded;

std::string name_of(const MotionEntry& entry) {
    if (!entry.name.empty()) return entry.name;
    return std::visit(Overloaded{[](std::monostate) { return std::string("still"); },
                                 [](const RecordMotion& motion) { return motion.file.stem().string(); },
                                 [](const SignalMotion& motion) { return std::string(detail::kSignalKinds.at(motion.signal.index())); },
                                 [](const TiltMotion&) { return std::string("tilt"); }},
                      entry.base_motion.source);
}

/// When the last component ends.
scaling::Time find_end(const SceneMotion& motion, const std::string& place) {
    double end = 0.0;
    for (const BaseComponent& c : make_base_components(motion, place).all()) {
        if (c.velocity.size() > 1) end = std::max(end, c.start + static_cast<double>(c.velocity.size() - 1) * c.dt);
    }
    return scaling::Time::from_value(end);
}

/// When the last component comes to rest for good, if it does so after `duration` by more than a sample [s].
std::optional<double> find_end_beyond(const BaseComponents& motion, double duration) {
    std::optional<double> end;
    for (const BaseComponent& c : motion.all()) {
        // one sample alone is a velocity that is kept
        if (c.velocity.size() < 2) continue;
        const auto last = std::find_if(c.velocity.rbegin(), c.velocity.rend(), [](double v) { return v != 0.0; });
        const double rest = c.start + static_cast<double>(c.velocity.rend() - last) * c.dt;
        if (last != c.velocity.rend() && rest > duration + 2.0 * c.dt) end = std::max(end.value_or(0.0), rest);
    }
    return end;
}

}  // namespace

std::vector<std::string> describe_cut_motions(const Scene& scene) {
    std::vector<std::string> cut;
    const auto look_at = [&](const SceneMotion& motion, double duration, const std::string& place) {
        const std::optional<double> end = find_end_beyond(make_base_components(motion, place), duration);
        if (end) {
            cut.push_back(fmt::format("{}: the motion lasts {:.4g} s, and \"duration\" cuts it at {:.4g} s (what comes after is not run)",
                                      place, *end, duration));
        }
    };
    if (scene.motions.empty()) look_at(scene.base_motion, scene.time.duration.value(), "/base_motion");
    for (std::size_t k = 0; k < scene.motions.size(); ++k) {
        const MotionEntry& entry = scene.motions[k];
        const double duration = entry.duration.value_or(scene.time.duration).value();
        if (duration > 0.0) look_at(entry.base_motion, duration, fmt::format("/motions/{}/base_motion", k));
    }
    return cut;
}

std::vector<StageScene> expand_motions(const Scene& scene) {
    std::vector<StageScene> stages;
    for (std::size_t k = 0; k < scene.motions.size(); ++k) {
        const MotionEntry& entry = scene.motions[k];
        StageScene stage{.name = name_of(entry), .entry = k, .settle = entry.settle, .scene = scene};
        stage.scene.motions.clear();
        stage.scene.base_motion = entry.base_motion;
        scaling::Time& duration = stage.scene.time.duration;
        if (entry.duration) duration = *entry.duration;
        if (!(duration.value() > 0.0)) duration = find_end(entry.base_motion, fmt::format("{}: /motions/{}/base_motion", scene.place(), k));
        if (!(duration.value() > 0.0)) {
            throw SceneError(
                fmt::format("{}: /motions/{}: the motion has no end that could give its duration; give a \"duration\"", scene.place(), k));
        }
        for (int i = 0; i < entry.repeat; ++i) stages.push_back(stage);
    }
    return stages;
}

void require_single_motion(const Scene& scene, const std::string& what) {
    if (scene.motions.empty()) return;
    throw SceneError(fmt::format("{}: /motions: {} takes one motion (this is a list of them, for one structure)", scene.place(), what),
                     Remedy{"use ", Setting::sequence, ", or give a \"base_motion\" instead"});
}

}  // namespace musim::lsdem
