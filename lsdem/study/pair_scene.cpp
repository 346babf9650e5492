#include "lsdem/study/pair_scene.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "lsdem/scene/block_heights.hpp"
#include "lsdem/scene/material_presets.hpp"
#include "lsdem/scene/motions.hpp"
#include "lsdem/scene/scale_scene.hpp"
#include "lsdem/scene/scene_error.hpp"
#include "lsdem/study/lay_specimen.hpp"
#include "lsdem/study/run.hpp"
#include "lsdem/study/scale_specimen.hpp"

namespace musim::lsdem::study {
namespace {

using scaling::Similitude;

/// A scale within this of a preset's is that scale: 1/25 typed as 0.04 is meant. Only chooses a default material.
constexpr double kSameScale = 1e-6;

/// A model's scene with its similitude to the prototype and what that distorts.
struct ScaledScene {
    scene::Scene scene;
    Similitude similitude;
    std::vector<scaling::Distortion> distortions;
};

/// A model with one property of a material of its own.
struct LoneScene {
    std::string property;
    double factor = 1.0;
    scene::Scene scene;
    Similitude similitude;
};

const scene::MaterialPreset& find_preset(const ModelChoice& choice) {
    if (!choice.material.empty()) return scene::find_material_preset(choice.material);
    for (const std::string& name : scene::material_preset_names()) {
        const scene::MaterialPreset& preset = scene::find_material_preset(name);
        if (std::abs(preset.length_scale / choice.length - 1.0) < kSameScale) return preset;
    }
    throw scene::SceneError(
        fmt::format("materials own: no preset was measured at {}; name one with --material", make_scale_label(choice.length)));
}

ScaledScene scale_by_law(const scene::Scene& prototype, const ModelChoice& choice) {
    const Similitude similitude = choice.similitude ? *choice.similitude : Similitude({.length = choice.length}, scaling::Law::exact);
    return {scene::scale_scene(prototype, similitude), similitude, scaling::find_distortions(similitude)};
}

ScaledScene scale_with_own(const scene::Scene& prototype, const ModelChoice& choice) {
    const scene::MaterialPreset& preset = find_preset(choice);
    const scene::BlockMaterial& from = prototype.material;
    const scaling::ScaleFactors factors{.length = choice.length,
                                        .friction = preset.material.friction / from.friction,
                                        .gravity = 1.0,
                                        .density = preset.material.density.value() / from.density.value()};
    const Similitude similitude(factors, scaling::Law::mu);
    ScaledScene scaled{scene::scale_with_own_material(prototype, similitude, preset), similitude, {}};

    const scene::BlockMaterial& to = scaled.scene.material;
    const auto block = scene::reference_block(prototype);
    const auto heights = scene::find_height_variation(scaled.scene);
    const scaling::ModelFacts facts{.friction_prototype = from.friction,
                                    .slenderness = {block[0] / block[2], block[1] / block[2]},
                                    .normal_stiffness = to.normal_stiffness / from.normal_stiffness,
                                    .shear_stiffness = to.shear_stiffness / from.shear_stiffness,
                                    .restitution = to.restitution / from.restitution,
                                    .height_deviation = heights ? std::optional(choice.length) : std::nullopt};
    scaled.distortions = scaling::find_distortions(similitude, facts);
    return scaled;
}

/// One scene for every property in which `own` is not what its similitude asks for.
std::vector<LoneScene> find_lone_scenes(const scene::Scene& prototype, const ScaledScene& own) {
    const Similitude exact({.length = own.similitude.length(), .density = own.similitude.density()}, scaling::Law::exact);
    const scene::Scene by_law = scene::scale_scene(prototype, own.similitude), twin = scene::scale_scene(prototype, exact);
    const scene::BlockMaterial &has = own.scene.material, &asked = by_law.material;
    std::vector<LoneScene> scenes;
    const auto add = [&](const char* property, double factor, const scene::Scene& scene, const Similitude& similitude,
                         const auto& distort) {
        if (std::abs(factor - 1.0) <= scaling::kFactorRounding) return;
        scenes.push_back({property, factor, scene, similitude});
        scenes.back().scene.time.step.reset();
        distort(scenes.back().scene.material);
    };
    using Material = scene::BlockMaterial;
    add("friction", own.similitude.friction(), by_law, own.similitude, [](Material&) {});
    const double normal = has.normal_stiffness / asked.normal_stiffness, shear = has.shear_stiffness / asked.shear_stiffness,
                 restitution = has.restitution / asked.restitution;
    add("normal stiffness", normal, twin, exact, [&](Material& material) { material.normal_stiffness *= normal; });
    add("shear stiffness", shear, twin, exact, [&](Material& material) { material.shear_stiffness *= shear; });
    add("restitution", restitution, twin, exact, [&](Material& material) { material.restitution = has.restitution; });
    return scenes;
}

/// A scene that steps as its own stiffness asks.
PairMember make_member(const std::string& label, const scene::Scene& scene, const Similitude& similitude,
                       const std::vector<scaling::Distortion>& distortions = {}) {
    Specimen specimen = make_specimen(scene);
    const TimePlan plan = make_time_plan(scene, specimen.model);
    return {label, std::move(specimen), plan, similitude, distortions};
}

PairMember lay_prototype(const scene::Scene& scene, const RunSettings& settings) {
    LaidSpecimen laid = lay_specimen(scene, settings);
    const TimePlan plan = make_time_plan(scene, laid.specimen.model);
    return {"prototype", std::move(laid.specimen), plan, Similitude({}, scaling::Law::exact), {}, laid.rest};
}

PairMember make_image(const PairMember& prototype, const std::string& label, const ScaledScene& scaled) {
    return {label,
            scale_specimen(prototype.specimen, scaled.similitude),
            prototype.plan.scaled(scaled.similitude.time()),
            scaled.similitude,
            scaled.distortions,
            prototype.rest};
}

}  // namespace

std::string make_scale_label(double length) {
    const double inverse = 1.0 / length;
    const double whole = std::round(inverse);
    return whole >= 1.0 && std::abs(inverse / whole - 1.0) < kSameScale ? fmt::format("1:{:.0f}", whole) : fmt::format("x{:.6g}", length);
}

ScenePair pair_scene(const scene::Scene& prototype, const std::vector<ModelChoice>& models, Materials materials,
                     const RunSettings& settings, const PairSceneSettings& how) {
    scene::require_single_motion(prototype, "a pair");
    const PairMember original = lay_prototype(prototype, settings);

    ScenePair pair{.prototype = prototype, .models = {}, .scales = find_motion_scales(original.specimen), .study = {}};
    std::vector<PairMember> members, lone_members;
    std::vector<std::vector<LoneScene>> lone_scenes;
    for (const ModelChoice& choice : models) {
        const std::string label = make_scale_label(choice.length);
        ScaledScene scaled = materials == Materials::exact ? scale_by_law(prototype, choice) : scale_with_own(prototype, choice);
        const bool has_image = materials == Materials::exact && scaled.similitude.law() == scaling::Law::exact;
        members.push_back(has_image && how.specimen == PairSpecimen::one
                              ? make_image(original, label, scaled)
                              : make_member(label, scaled.scene, scaled.similitude, scaled.distortions));
        // an exact model steps as its prototype does
        if (materials == Materials::exact) members.back().plan = original.plan.scaled(scaled.similitude.time());
        lone_scenes.push_back(how.each_alone && materials == Materials::own ? find_lone_scenes(prototype, scaled)
                                                                            : std::vector<LoneScene>{});
        for (const LoneScene& lone : lone_scenes.back()) {
            lone_members.push_back(make_member(label + ", " + lone.property, lone.scene, lone.similitude));
        }
        pair.models.push_back(std::move(scaled.scene));
    }
    members.insert(members.end(), std::make_move_iterator(lone_members.begin()), std::make_move_iterator(lone_members.end()));
    pair.study = run_pair(original, members, materials, settings, how.judging);

    // the runs beside the models go to the models they belong to
    std::vector<PairedRun>& runs = pair.study.models;
    std::size_t run = models.size();
    for (std::size_t m = 0; m < models.size(); ++m) {
        for (const LoneScene& lone : lone_scenes[m]) {
            runs[m].alone.push_back({lone.property, lone.factor, runs[run].run.status, runs[run].difference});
            ++run;
        }
    }
    runs.erase(runs.begin() + static_cast<std::ptrdiff_t>(models.size()), runs.end());
    return pair;
}

}  // namespace musim::lsdem::study
