#include "lsdem/study/pair_models.hpp"

#include <cmath>

#include "lsdem/scene/block_heights.hpp"
#include "lsdem/scene/measured_material.hpp"
#include "lsdem/scene/motions.hpp"
#include "lsdem/scene/reference_block.hpp"
#include "lsdem/scene/scale_scene.hpp"
#include "scaling/laws/law_similitude.hpp"

namespace musim::lsdem {
namespace {

using scaling::Similitude;

ScaledScene scale_by_law(const Scene& prototype, const ModelChoice& choice) {
    const Similitude similitude = choice.similitude ? *choice.similitude : scaling::make_similitude("exact", {.length = choice.length});
    return {scale_scene(prototype, similitude), similitude, scaling::find_distortions(similitude)};
}

/// What a model has of its own, besides scale, density, friction and gravity.
std::vector<scaling::Distortion> find_own_distortions(const Scene& prototype, const Scene& model, const Similitude& similitude) {
    const BlockMaterial &from = prototype.material, &to = model.material;
    const auto block = reference_block(prototype);
    const auto heights = find_height_variation(prototype), of_model = find_height_variation(model);
    scaling::ModelProperties properties{.friction_prototype = from.friction,
                                        .slenderness = {block[0] / block[2], block[1] / block[2]},
                                        .normal_stiffness = to.normal_stiffness / from.normal_stiffness,
                                        .shear_stiffness = to.shear_stiffness / from.shear_stiffness,
                                        .restitution = to.restitution / from.restitution,
                                        .height_deviation = {}};
    if (heights && of_model) properties.height_deviation = of_model->deviation / heights->deviation;
    return scaling::find_distortions(similitude, properties);
}

ScaledScene scale_with_own(const Scene& prototype, const ModelChoice& choice) {
    const MeasuredMaterial own = choice.material.empty() ? find_material_at(choice.length) : find_measured_material(choice.material);
    const scaling::ScaleFactors factors{.length = choice.length,
                                        .friction = own.material.friction / prototype.material.friction,
                                        .gravity = 1.0,
                                        .density = own.material.density / prototype.material.density};
    const Similitude similitude = scaling::make_similitude("mu", factors);
    ScaledScene scaled{scale_with_own_material(prototype, similitude, own), similitude, {}, own.name};
    scaled.distortions = find_own_distortions(prototype, scaled.scene, similitude);
    return scaled;
}

double strength(const Scene& scene) {
    double squares = 0.0;
    for (const scaling::Acceleration& component : scene.gravity) squares += component.value() * component.value();
    return std::sqrt(squares);
}

/// A scene of its own as a model: it runs as long as the prototype does, and is sampled at the same dimensionless times.
ScaledScene take_as_model(const Scene& prototype, const Scene& model) {
    for (const Scene* scene : {&prototype, &model}) require_single_motion(*scene, "a pair of two scenes");
    const auto of_prototype = reference_block(prototype), of_model = reference_block(model);
    const scaling::ScaleFactors factors{.length = of_model[2] / of_prototype[2],
                                        .friction = model.material.friction / prototype.material.friction,
                                        .gravity = strength(model) / strength(prototype),
                                        .density = model.material.density / prototype.material.density};
    const Similitude similitude = scaling::make_similitude("mu", factors);
    ScaledScene scaled{model, similitude, {}, "scene \"" + model.name + "\""};
    scaled.scene.time.duration = prototype.time.duration * similitude.time();
    scaled.scene.time.step.reset();
    scaled.scene.output = prototype.output;
    if (scaled.scene.output.spine_rate.value() > 0.0) scaled.scene.output.spine_rate *= similitude.frequency();
    if (scaled.scene.output.frame_rate) *scaled.scene.output.frame_rate *= similitude.frequency();
    scaled.distortions = find_own_distortions(prototype, scaled.scene, similitude);
    return scaled;
}

}  // namespace

ScaledScene make_scaled(const Scene& prototype, const ModelChoice& choice, Materials materials) {
    if (choice.scene) return take_as_model(prototype, *choice.scene);
    return materials == Materials::exact ? scale_by_law(prototype, choice) : scale_with_own(prototype, choice);
}

std::vector<LoneScene> find_lone_scenes(const Scene& prototype, const ScaledScene& own) {
    const Similitude exact = scaling::make_similitude("exact", {.length = own.similitude.length(), .density = own.similitude.density()});
    const Scene by_law = scale_scene(prototype, own.similitude), twin = scale_scene(prototype, exact);
    const BlockMaterial &has = own.scene.material, &asked = by_law.material;
    std::vector<LoneScene> scenes;
    const auto add = [&](const char* property, double factor, const Scene& scene, const Similitude& similitude, const auto& distort) {
        if (std::abs(factor - 1.0) <= scaling::kFactorRounding) return;
        scenes.push_back({property, factor, scene, similitude});
        scenes.back().scene.time.step.reset();
        distort(scenes.back().scene.material);
    };
    add("friction", own.similitude.friction(), by_law, own.similitude, [](BlockMaterial&) {});
    const double normal = has.normal_stiffness / asked.normal_stiffness, shear = has.shear_stiffness / asked.shear_stiffness,
                 restitution = has.restitution / asked.restitution;
    add("normal stiffness", normal, twin, exact, [&](BlockMaterial& material) { material.normal_stiffness *= normal; });
    add("shear stiffness", shear, twin, exact, [&](BlockMaterial& material) { material.shear_stiffness *= shear; });
    add("restitution", restitution, twin, exact, [&](BlockMaterial& material) { material.restitution = has.restitution; });
    return scenes;
}

}  // namespace musim::lsdem
