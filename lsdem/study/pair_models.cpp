#include "lsdem/study/pair_models.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "lsdem/scene/block_heights.hpp"
#include "lsdem/scene/build_model.hpp"
#include "lsdem/scene/measured_material.hpp"
#include "lsdem/scene/motions.hpp"
#include "lsdem/scene/reference_block.hpp"
#include "lsdem/scene/scale_scene.hpp"
#include "scaling/laws/law_similitude.hpp"

namespace musim::lsdem {
namespace {

using scaling::Similitude;

/// Steps of the prototype that are longer than the model's own by less than this are safe: `safety` leaves more [-].
constexpr double kSafeStep = 1.1;

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
    ScaledScene scaled{scale_with_own_material(prototype, similitude, own), similitude, {}, own.name, Materials::own};
    scaled.distortions = find_own_distortions(prototype, scaled.scene, similitude);
    return scaled;
}

double strength(const Scene& scene) {
    double squares = 0.0;
    for (const scaling::Acceleration& component : scene.gravity) squares += component.value() * component.value();
    return std::sqrt(squares);
}

/// The same structure, as it is.
ScaledScene take_as_same(const Scene& prototype, const Scene& model) {
    const std::string way =
        fmt::format("{}: the structure of {}, block by block, judged like an exact model.", model.place(), prototype.place());
    ScaledScene same{model, Similitude(), {}, {}, Materials::exact};
    same.second = SecondScene{model.place(), way, true, find_scene_differences(prototype, model)};
    same.scene.time.duration = prototype.time.duration;
    same.scene.output = prototype.output;
    return same;
}

/// A model of its own, with its scale, or one that is to be judged as an exact one, as asked.
ScaledScene take_as_own(const Scene& prototype, const Scene& model, Materials materials, const std::string& why) {
    const auto of_prototype = reference_block(prototype), of_model = reference_block(model);
    const scaling::ScaleFactors factors{.length = of_model[2] / of_prototype[2],
                                        .friction = model.material.friction / prototype.material.friction,
                                        .gravity = strength(model) / strength(prototype),
                                        .density = model.material.density / prototype.material.density};
    const Similitude similitude = scaling::make_similitude("mu", factors);
    ScaledScene scaled{model, similitude, {}, "scene \"" + model.name + "\"", materials};
    const char* const judged =
        materials == Materials::own ? "a model of its own, held against chance" : "judged like an exact model, scaled back";
    scaled.second = SecondScene{model.place(), fmt::format("{}: {} ({}).", model.place(), judged, why)};
    scaled.scene.time.duration = prototype.time.duration * similitude.time();
    scaled.scene.time.step.reset();
    scaled.scene.output = prototype.output;
    if (scaled.scene.output.spine_rate.value() > 0.0) scaled.scene.output.spine_rate *= similitude.frequency();
    if (scaled.scene.output.frame_rate) *scaled.scene.output.frame_rate *= similitude.frequency();
    scaled.distortions = find_own_distortions(prototype, scaled.scene, similitude);
    return scaled;
}

ScaledScene take_as_model(const Scene& prototype, const Scene& model, std::optional<Materials> materials) {
    for (const Scene* scene : {&prototype, &model}) require_single_motion(*scene, "a pair of two scenes");
    const std::optional<std::string> other = find_other_structure(prototype, model);
    if (!other && materials != Materials::own) return take_as_same(prototype, model);
    return take_as_own(prototype, model, materials.value_or(Materials::own), materials ? "as asked" : *other);
}

}  // namespace

ScaledScene make_scaled(const Scene& prototype, const ModelChoice& choice, std::optional<Materials> materials) {
    if (choice.scene) return take_as_model(prototype, *choice.scene, materials);
    return materials == Materials::own ? scale_with_own(prototype, choice) : scale_by_law(prototype, choice);
}

TimePlan make_plan_beside(const Scene& prototype, const TimePlan& plan, const Scene& scene, const Model& model) {
    const double interval = static_cast<double>(plan.steps_per_sample) * plan.time_step;
    const double step = compute_time_step(scene, model).value();
    const auto differ = [](double a, double b) { return std::abs(a - b) > scaling::kFactorRounding * b; };
    const auto step_of = [](const Scene& of) { return of.time.step.value_or(scaling::Time()).value(); };
    const bool asks = differ(step_of(scene), step_of(prototype)) || differ(scene.time.safety, prototype.time.safety);
    if (!asks && plan.time_step < kSafeStep * step) return plan;
    TimePlan own = plan;
    own.steps_per_sample = static_cast<std::uint64_t>(std::max(1.0, std::ceil(interval / step * (1.0 - scaling::kFactorRounding))));
    own.time_step = interval / static_cast<double>(own.steps_per_sample);
    return own;
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
