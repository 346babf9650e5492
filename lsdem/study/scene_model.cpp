#include "lsdem/study/scene_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "lsdem/scene/base_components.hpp"
#include "lsdem/scene/motions.hpp"
#include "lsdem/scene/reference_block.hpp"
#include "lsdem/scene/scale_scene.hpp"
#include "lsdem/study/model_distortions.hpp"
#include "lsdem/study/second_scene.hpp"
#include "lsdem/study/solve_model_law.hpp"
#include "scaling/laws/law_similitude.hpp"

namespace musim::lsdem {
namespace {

using scaling::Similitude;

/// λ_a this near to a law's is by that law: what it is off then is a distortion [-]. Laws of friction and of weight are one where friction
/// differs by less.
constexpr double kLawTolerance = 0.02;

/// Widths that scale as heights to this are similar: blocks are cut no better [-].
constexpr double kSameProportions = 0.01;

double strength(const Scene& scene) {
    double squares = 0.0;
    for (const scaling::Acceleration& component : scene.gravity) squares += component.value() * component.value();
    return std::sqrt(squares);
}

MadeOf compare_first_blocks(const Scene& prototype, const Scene& model) {
    const BlockMaterial &from = material_of_block(prototype, 0), &to = material_of_block(model, 0);
    return {.friction = to.friction / from.friction,
            .density = to.density / from.density,
            .normal_stiffness = to.normal_stiffness / from.normal_stiffness,
            .shear_stiffness = to.shear_stiffness / from.shear_stiffness,
            .gravity = strength(model) / strength(prototype)};
}

bool moves(const BaseComponents& motion) {
    const auto components = motion.all();
    return std::any_of(components.begin(), components.end(), [](const BaseComponent& component) { return !component.velocity.empty(); });
}

/// The law by which a model's scene scales its record, and what it gives besides what a model is made of; nothing where it names none, or
/// another than the prototype's scene does.
std::optional<ChosenLaw> find_own_law(const Scene& prototype, const Scene& model) {
    const auto scale_of = [](const Scene& scene) -> const RecordScale* {
        const auto* record = std::get_if<RecordMotion>(&scene.base_motion.source);
        return record != nullptr && record->scale ? &*record->scale : nullptr;
    };
    const RecordScale *own = scale_of(model), *of_prototype = scale_of(prototype);
    if (own == nullptr || (of_prototype != nullptr && of_prototype->law != own->law)) return std::nullopt;
    ChosenLaw law{.name = own->law};
    for (const auto& [name, factor] : own->set) {
        if (name != "l" && !is_own_factor(name)) law.set.push_back({name, factor});
    }
    return law;
}

/// Those that a motion is compared with: by weight, by friction, by elasticity.
std::vector<Similitude> list_known(const scaling::ScaleFactors& has, double elasticity) {
    const double elastic = elasticity / (has.density * has.length);
    return {Similitude(has, has.gravity, "froude"), Similitude(has, has.friction * has.gravity, "mu"),
            Similitude(has, elastic, "cauchy", elastic)};
}

/// By which law a model is shaken.
struct FoundLaw {
    Similitude similitude;
    ModelLaw law;
    std::optional<scaling::SolvedLaw> solved = {};
};

/// The law of a motion that was measured: the nearest known one, or none of them.
FoundLaw name_measured(const scaling::ScaleFactors& has, const MadeOf& made, const std::vector<Similitude>& known,
                       const BaseShaking& shaking) {
    const double acceleration =
        shaking.time ? has.length / (*shaking.time * *shaking.time) : *shaking.velocity * *shaking.velocity / has.length;
    const auto distance = [&](const Similitude& each) { return std::abs(acceleration / each.acceleration() - 1.0); };
    const auto find_nearest = [&](auto end) -> const Similitude& {
        return *std::min_element(known.begin(), end, [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
    };
    // by elasticity, which is the last, only what neither weight nor friction explains
    const Similitude& by_weight = find_nearest(known.end() - 1);
    const Similitude& nearest = distance(by_weight) <= kLawTolerance ? by_weight : find_nearest(known.end());
    const ModelLaw law{.source = LawSource::measured, .why = {}, .shaking = shaking};
    if (distance(nearest) > kLawTolerance) return {Similitude(has, acceleration, kNoLaw), law};
    const bool is_it = distance(nearest) <= kMeasuredFactor;
    return {Similitude(has, is_it ? nearest.acceleration() : acceleration, nearest.law_name(), nearest.acceleration_vertical()), law,
            solve_model_law({nearest.law_name()}, has.length, made)};
}

FoundLaw find_law(const Scene& prototype, const Scene& model, const scaling::ScaleFactors& has, const MadeOf& made,
                  const std::optional<ChosenLaw>& chosen) {
    const std::vector<Similitude> known = list_known(has, made.normal_stiffness / has.length);
    const std::optional<ChosenLaw> named = chosen ? chosen : find_own_law(prototype, model);
    std::vector<double> times;
    FoundLaw found;
    if (named) {
        found.solved = solve_model_law(*named, has.length, made);
        const Similitude asked = scaling::make_similitude(*found.solved);
        found.similitude = Similitude(has, asked.acceleration(), asked.law_name(), asked.acceleration_vertical());
        found.law.source = chosen ? LawSource::chosen : LawSource::scene;
        times.push_back(found.similitude.time());
    }
    for (const Similitude& each : known) times.push_back(each.time());
    const auto from = make_base_components(prototype.base_motion, prototype.place() + ": /base_motion");
    const auto to = make_base_components(model.base_motion, model.place() + ": /base_motion");
    const auto shaking = measure_base_shaking(from, to, prototype.time.duration.value(), times);
    if (named) {
        found.law.shaking = shaking;
        return found;
    }
    if (shaking && (shaking->time || shaking->velocity)) return name_measured(has, made, known, *shaking);
    const auto assume = [](const Similitude& similitude, const char* why) {
        return FoundLaw{similitude, {.source = LawSource::assumed, .why = why, .shaking = {}}};
    };
    if (!moves(from) && !moves(to)) return assume(known[0], "neither base moves and weight is what drives them");
    return assume(known[1], "its base does not move as the prototype's does");
}

/// Lengths and shaking as they are.
scaling::ModelScales find_scales(const Scene& prototype, const Scene& model, const FoundLaw& found) {
    scaling::ModelScales scales(found.similitude);
    const auto of_prototype = reference_block(prototype), of_model = reference_block(model);
    const double thin = of_model[0] / of_prototype[0], wide = of_model[1] / of_prototype[1];
    if (std::abs(thin / scales.height - 1.0) > kSameProportions) {
        scales.similitude.reset();
        scales.width = thin;
        for (double* mass : {&scales.mass, &scales.weight, &scales.static_stiffness}) *mass *= thin / scales.height * wide / scales.height;
    }
    if (!found.law.shaking) return scales;
    const BaseShaking& shaking = *found.law.shaking;
    const auto take = [](double& asked, std::optional<double> has) {
        if (has && std::abs(*has / asked - 1.0) > kMeasuredFactor) asked = *has;
    };
    take(scales.time, shaking.time);
    take(scales.velocity, shaking.velocity);
    take(scales.velocity_vertical, shaking.velocity_vertical);
    if (!shaking.time) return scales;
    take(scales.frequency, 1.0 / *shaking.time);
    if (shaking.velocity) take(scales.acceleration, *shaking.velocity / *shaking.time);
    if (shaking.velocity_vertical) take(scales.acceleration_vertical, *shaking.velocity_vertical / *shaking.time);
    return scales;
}

/// The same structure, as it is.
ScaledScene take_as_same(const Scene& prototype, const Scene& model) {
    const std::string way =
        fmt::format("{}: the structure of {}, block by block, judged like an exact model.", model.place(), prototype.place());
    ScaledScene same{.scene = model};
    same.second = SecondScene{model.place(), way, true, find_scene_differences(prototype, model)};
    same.scene.time.duration = prototype.time.duration;
    same.scene.output = prototype.output;
    same.scene.sensors = prototype.sensors;
    return same;
}

/// A model of its own, with its scale, or one that is to be judged as an exact one, as asked.
ScaledScene take_as_own(const Scene& prototype, const Scene& model, Materials materials, const std::string& why,
                        const std::optional<ChosenLaw>& law) {
    const MadeOf made = compare_first_blocks(prototype, model);
    const scaling::ScaleFactors has{.length = reference_block(model)[2] / reference_block(prototype)[2],
                                    .friction = made.friction,
                                    .gravity = *made.gravity,
                                    .density = made.density};
    FoundLaw found = find_law(prototype, model, has, made, law);
    const Similitude& similitude = found.similitude;
    ScaledScene scaled{.scene = model,
                       .similitude = similitude,
                       .scales = find_scales(prototype, model, found),
                       .material = "scene \"" + model.name + "\"",
                       .materials = materials,
                       .law = std::move(found.law),
                       .solved = std::move(found.solved)};
    const char* const judged =
        materials == Materials::own ? "a model of its own, held against chance" : "judged like an exact model, scaled back";
    scaled.second = SecondScene{model.place(), fmt::format("{}: {} ({}).", model.place(), judged, why)};
    scaled.scene.time.duration = prototype.time.duration * similitude.time();
    scaled.scene.time.step.reset();
    scaled.scene.output = prototype.output;
    if (scaled.scene.output.spine_rate.value() > 0.0) scaled.scene.output.spine_rate *= similitude.frequency();
    if (scaled.scene.output.frame_rate) *scaled.scene.output.frame_rate *= similitude.frequency();
    scaled.scene.sensors.clear();
    if (!prototype.sensors.empty()) scaled.scene.sensors = scale_scene(prototype, similitude).sensors;
    return scaled;
}

}  // namespace

ScaledScene take_as_model(const Scene& prototype, const Scene& model, std::optional<Materials> materials,
                          const std::optional<ChosenLaw>& law) {
    for (const Scene* scene : {&prototype, &model}) require_single_motion(*scene, "a pair of two scenes");
    const std::optional<std::string> other = find_other_structure(prototype, model);
    if (!other && materials != Materials::own && !law) return take_as_same(prototype, model);
    const std::string why = materials ? "as asked" : other ? *other : "by the law that is given";
    return take_as_own(prototype, model, materials.value_or(Materials::own), why, law);
}

}  // namespace musim::lsdem
