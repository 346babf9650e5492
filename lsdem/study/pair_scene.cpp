#include "lsdem/study/pair_scene.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "lsdem/scene/block_heights.hpp"
#include "lsdem/scene/material_presets.hpp"
#include "lsdem/scene/motions.hpp"
#include "lsdem/scene/scale_scene.hpp"
#include "lsdem/scene/scene_error.hpp"
#include "lsdem/study/run.hpp"

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

const scene::MaterialPreset& find_preset(const ModelChoice& choice) {
    if (!choice.material.empty()) return scene::find_material_preset(choice.material);
    for (const std::string& name : scene::material_preset_names()) {
        const scene::MaterialPreset& preset = scene::find_material_preset(name);
        if (std::abs(preset.length_scale / choice.length - 1.0) < kSameScale) return preset;
    }
    throw scene::SceneError(
        fmt::format("materials own: no preset was measured at {}; name one with --material", make_scale_label(choice.length)));
}

ScaledScene scale_exactly(const scene::Scene& prototype, double length) {
    const Similitude similitude({.length = length}, scaling::Law::exact);
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

}  // namespace

std::string make_scale_label(double length) {
    const double inverse = 1.0 / length;
    const double whole = std::round(inverse);
    return whole >= 1.0 && std::abs(inverse / whole - 1.0) < kSameScale ? fmt::format("1:{:.0f}", whole) : fmt::format("x{:.6g}", length);
}

ScenePair pair_scene(const scene::Scene& prototype, const std::vector<ModelChoice>& models, Materials materials,
                     const RunSettings& settings) {
    scene::require_single_motion(prototype, "a pair");
    const Similitude identity({}, scaling::Law::exact);
    Specimen specimen = make_specimen(prototype);
    const TimePlan plan = make_time_plan(prototype, specimen.model);
    const PairMember original{"prototype", std::move(specimen), plan, identity};

    ScenePair pair{.prototype = prototype,
                   .models = {},
                   .scales = find_motion_scales(original.specimen),
                   .study = {{}, {}, {"", identity, {}, {}, {}, {}}, {}}};
    std::vector<PairMember> members;
    for (const ModelChoice& choice : models) {
        ScaledScene scaled = materials == Materials::exact ? scale_exactly(prototype, choice.length) : scale_with_own(prototype, choice);
        Specimen model = make_specimen(scaled.scene);
        // an exact model steps as its prototype does; one of its own material as its own stiffness asks
        const TimePlan model_plan =
            materials == Materials::exact ? plan.scaled(scaled.similitude.time()) : make_time_plan(scaled.scene, model.model);
        members.push_back({make_scale_label(choice.length), std::move(model), model_plan, scaled.similitude, scaled.distortions});
        pair.models.push_back(std::move(scaled.scene));
    }
    pair.study = run_pair(original, members, materials, settings);
    return pair;
}

}  // namespace musim::lsdem::study
