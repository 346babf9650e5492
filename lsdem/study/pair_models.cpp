#include "lsdem/study/pair_models.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "lsdem/scene/build_model.hpp"
#include "lsdem/scene/measured_material.hpp"
#include "lsdem/scene/reference_block.hpp"
#include "lsdem/scene/scale_scene.hpp"
#include "lsdem/scene/scene_error.hpp"
#include "lsdem/study/scene_model.hpp"
#include "lsdem/study/solve_model_law.hpp"
#include "scaling/factor_rounding.hpp"
#include "scaling/laws/group_meaning.hpp"
#include "scaling/laws/law_similitude.hpp"

namespace musim::lsdem {
namespace {

using scaling::Similitude;

/// Steps of the prototype that are longer than the model's own by less than this are safe: `safety` leaves more [-].
constexpr double kSafeStep = 1.1;

bool is_one(double factor) { return std::abs(factor - 1.0) <= scaling::kFactorRounding; }

ScaledScene scale_by_law(const Scene& prototype, const ModelChoice& choice) {
    scaling::SolvedLaw solved = solve_model_law(choice.law.value_or(ChosenLaw{"exact"}), choice.length, {});
    const Similitude similitude = scaling::make_similitude(solved);
    return {.scene = scale_scene(prototype, similitude), .similitude = similitude, .scales = similitude, .solved = std::move(solved)};
}

ScaledScene scale_with_own(const Scene& prototype, const ModelChoice& choice) {
    const MeasuredMaterial own = choice.material.empty() ? find_material_at(choice.length) : find_measured_material(choice.material);
    Triple<scaling::Length> block = reference_block(prototype);
    for (scaling::Length& edge : block) edge *= choice.length;
    const BlockMaterial fitted = fit_to_block(own, block);
    const MadeOf made{.friction = own.material.friction / prototype.material.friction,
                      .density = own.material.density / prototype.material.density,
                      .normal_stiffness = fitted.normal_stiffness / prototype.material.normal_stiffness,
                      .shear_stiffness = fitted.shear_stiffness / prototype.material.shear_stiffness};
    scaling::SolvedLaw solved = solve_model_law(choice.law.value_or(ChosenLaw{"mu"}), choice.length, made);
    const Similitude asked = scaling::make_similitude(solved);

    // a law that settles the density itself adds mass to the solid
    const double mass = asked.density() / made.density;
    if (mass < 1.0 && !is_one(mass)) {
        throw SceneError(
            fmt::format("law {} asks for {:.4g} times the density of {} (mass can be added to a material, not taken away); take "
                        "a lighter material, or another law",
                        asked.law_name(), mass, own.name));
    }
    scaling::ScaleFactors has = asked.chosen();
    has.friction = made.friction;
    const Similitude similitude(has, asked.acceleration(), asked.law_name(), asked.acceleration_vertical());
    ScaledScene scaled{.scene = scale_with_own_material(prototype, similitude, own),
                       .similitude = similitude,
                       .scales = similitude,
                       .material = own.name,
                       .materials = Materials::own,
                       .solved = std::move(solved)};
    if (!is_one(mass)) {
        scaled.scene.material.density *= mass;
        scaled.material += fmt::format(" with {:.4g} times its mass", mass);
    }
    return scaled;
}

}  // namespace

ScaledScene make_scaled(const Scene& prototype, const ModelChoice& choice, std::optional<Materials> materials) {
    if (choice.scene) return take_as_model(prototype, *choice.scene, materials, choice.law);
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
    const double finer = static_cast<double>(own.steps_per_sample) / static_cast<double>(plan.steps_per_sample);
    for (ReadingPlan& readings : own.readings) {
        // at most one a step
        const double corner_over_rate = readings.corner_steps * readings.steps;
        readings.steps = std::max(1.0, readings.steps * finer);
        readings.corner_steps = corner_over_rate / readings.steps;
    }
    return own;
}

std::vector<std::string> find_asked(const ScaledScene& model, const std::vector<scaling::Distortion>& distortions) {
    std::vector<std::string> asked;
    if (!model.solved) return asked;
    const scaling::KeptNumbers kept = scaling::find_kept_numbers(*model.solved);
    for (const scaling::Distortion& distortion : distortions) {
        if (scaling::find_group_meaning(distortion.group).is_required_by(kept)) asked.push_back(distortion.group);
    }
    return asked;
}

std::vector<LoneScene> find_lone_scenes(const Scene& prototype, const ScaledScene& own) {
    const Similitude& law = own.similitude;
    const scaling::ScaleFactors scales = law.chosen();
    const Similitude exact =
        scaling::make_similitude("exact", {.length = scales.length, .gravity = scales.gravity, .density = scales.density});
    const Scene by_law = scale_scene(prototype, law), twin = scale_scene(prototype, exact);
    const BlockMaterial& has = own.scene.material;
    std::vector<LoneScene> scenes;
    const auto add = [&](const char* property, double factor, const Scene& scene, const Similitude& similitude, const auto& distort) {
        if (is_one(factor)) return;
        scenes.push_back({property, factor, scene, similitude});
        scenes.back().scene.time.step.reset();
        distort(scenes.back().scene.material);
    };
    const auto keep = [](BlockMaterial&) {};
    const double shaking = law.acceleration() / law.gravity();
    const bool by_friction = is_one(shaking / law.friction());
    const BlockMaterial& asked = by_friction ? by_law.material : twin.material;
    if (by_friction || is_one(shaking)) {
        add("friction", law.friction(), by_law, law, keep);
    } else {
        scaling::ScaleFactors same_friction = scales;
        same_friction.friction = 1.0;
        const Similitude shaken(same_friction, law.acceleration(), law.law_name(), law.acceleration_vertical());
        const Similitude rubbed(scales, scales.gravity, law.law_name());
        add("shaking", shaking, scale_scene(prototype, shaken), shaken, keep);
        add("friction", law.friction(), scale_scene(prototype, rubbed), rubbed, keep);
    }
    const double normal = has.normal_stiffness / asked.normal_stiffness, shear = has.shear_stiffness / asked.shear_stiffness,
                 restitution = has.restitution / asked.restitution;
    add("normal stiffness", normal, twin, exact, [&](BlockMaterial& material) { material.normal_stiffness *= normal; });
    add("shear stiffness", shear, twin, exact, [&](BlockMaterial& material) { material.shear_stiffness *= shear; });
    add("restitution", restitution, twin, exact, [&](BlockMaterial& material) { material.restitution = has.restitution; });
    return scenes;
}

}  // namespace musim::lsdem
