#include "lsdem/study/similitude_cases.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <numbers>
#include <stdexcept>

#include "lsdem/scene/scale_scene.hpp"
#include "lsdem/study/closed_responses.hpp"

namespace musim::lsdem::study {
namespace {

using scaling::Law;
using scaling::Similitude;

constexpr double kLength = 1.0 / 25.0;

/// Of the column, where stick and slip make rounding grow: with it and factors that are powers of two there is none.
constexpr double kBitLength = 1.0 / 16.0;

constexpr double kWoodFriction = 0.63 / 0.59, kAluminiumFriction = 0.18 / 0.59, kWoodDensity = 800.0 / 2320.0;

/// Groups of the model over those of the prototype.
struct GroupRatios {
    double push = 1.0;       ///< a/g
    double friction = 1.0;   ///< μ
    double duration = 1.0;   ///< T over what the law asks for
    double amplitude = 1.0;  ///< a over what the law asks for
    double fall = 1.0;       ///< T√(g/l)
    double spring = 1.0;     ///< T²k/m
};

GroupRatios compare_groups(const Similitude& s, const Break& broken) {
    const auto factor = [&](BrokenGroup group) { return broken.group == group ? broken.factor : 1.0; };
    const double gravity = s.gravity() * factor(BrokenGroup::gravity), time = s.time() * factor(BrokenGroup::duration);
    return {.push = s.acceleration() * factor(BrokenGroup::amplitude) / gravity,
            .friction = s.friction() * factor(BrokenGroup::friction),
            .duration = factor(BrokenGroup::duration),
            .amplitude = factor(BrokenGroup::amplitude),
            .fall = time * std::sqrt(gravity / s.length()),
            .spring = time * time * s.stiffness() * factor(BrokenGroup::stiffness) / s.mass()};
}

/// What the friction spring adds to the slip, over it: it is stretched by μg/ω² when slip begins, then at a speed of up to 2j/ω², j = πA/T,
/// and within 1/ω of the rigid block's instant (j/2ω²), with as much again for the step; a speed acts until slip ends.
double compute_spring_error(double strength, double rigidity) {
    const PushedSlider rigid = compute_pushed_slider(strength);
    const double start = std::asin(1.0 / strength) / std::numbers::pi;
    return (1.0 / strength + 3.0 * std::numbers::pi * (rigid.end - start)) / (rigidity * rigidity) / rigid.slip;
}

Prediction predict_slide(const GroupRatios& groups) {
    const double strength = kSlideStrength * groups.push / groups.friction;
    const double ratio = groups.amplitude * groups.duration * groups.duration * compute_pushed_slider(strength).slip /
                         compute_pushed_slider(kSlideStrength).slip;
    const double error = compute_spring_error(kSlideStrength, slide_rigidity()) +
                         compute_spring_error(strength, slide_rigidity() * std::sqrt(groups.spring));
    return {ratio, ratio * error};
}

/// A rocking block and how well the closed form knows it.
struct Rocker {
    double strength, rate;
    double sinking;  ///< m g/(k_n b)

    double tilt() const { return compute_pushed_tilt(strength, rate); }

    /// Relative error of the groups: the linear equation leaves out α²/2, and the block turns about a point inside its edge. It stands on
    /// a strip c = √(2 m g b/(k_n θ)), and the work of its weight is less by 4c/(3b) up to the tilt θ.
    double group_error() const {
        const double alpha = std::atan(kRockSlenderness);
        return 0.5 * alpha * alpha + 4.0 / 3.0 * std::sqrt(2.0 * sinking / (tilt() * alpha));
    }

    /// Greatest relative change of the tilt for such errors.
    double error() const {
        const double by = group_error();
        double most = 0.0;
        for (const double s : {1.0 - by, 1.0 + by}) {
            for (const double w : {1.0 - by, 1.0 + by}) {
                most = std::max(most, std::abs(compute_pushed_tilt(s * strength, w * rate) / tilt() - 1.0));
            }
        }
        return most;
    }

    /// Tilt over α while the base holds it down, twice the static one: a strip of 3(1 − s)/2 of the width bears it.
    double lean() const {
        const double strip = std::min(1.0, 1.5 * (1.0 - strength));
        return 4.0 * sinking / (strip * strip) / std::atan(kRockSlenderness);
    }
};

Prediction predict_rock(const GroupRatios& groups) {
    const Rocker prototype{kRockStrength, kRockRate, rock_sinking()};
    const double sinking = rock_sinking() * groups.fall * groups.fall / groups.spring;
    const Rocker model{kRockStrength * groups.push, kRockRate / groups.fall, sinking};
    if (model.strength < 1.0) return {0.0, model.lean() / prototype.tilt()};
    const double ratio = model.tilt() / prototype.tilt();
    return {ratio, ratio * (prototype.error() + model.error())};
}

/// u = (V/ω)·f(ωt) for a step V of the base. Left out: lag of the dashpots by half a step and phase of the leapfrog scheme at 2ω, in both
/// runs, and the peak between two samples.
Prediction predict_chain(const GroupRatios& groups, Measure measure) {
    const double slower = 1.0 / std::sqrt(groups.spring);
    const double ratio =
        measure == Measure::peak ? groups.amplitude * groups.duration * groups.duration * slower : groups.duration * slower;
    const double wave = std::numbers::pi / (kChainSamples * std::min(1.0, slower));
    const double error = 2.0 * (kChainDamping * kChainSafety + kChainSafety * kChainSafety / 6.0) + wave * wave / 8.0;
    return {ratio, ratio * error};
}

/// The law's own scale factors.
Similitude make_similitude(const std::string& law) {
    if (law == "mu") return Similitude({.length = kLength, .friction = kWoodFriction, .density = kWoodDensity}, Law::mu);
    if (law == "froude") return Similitude({.length = kLength, .density = kWoodDensity}, Law::froude);
    if (law == "exact") return Similitude({.length = kLength, .gravity = 3.0, .density = kWoodDensity}, Law::exact);
    // at 1/25 a block would slide 25 times as hard, for longer than a short run
    if (law == "cauchy") return Similitude({.length = 1.0 / 5.0}, Law::cauchy);
    return Similitude({.length = kLength, .gravity = 1.0 / kLength}, Law::exact);
}

/// Stiffness of the prototype's own solid, λ_k = λ_l, over what the law asks for.
Break own_solid(const Similitude& similitude) { return {BrokenGroup::stiffness, similitude.length() / similitude.stiffness()}; }

/// The cases of one law, one after another.
class CaseList {
  public:
    explicit CaseList(std::string law) : law_(std::move(law)), similitude_(make_similitude(law_)) {}

    const Similitude& similitude() const { return similitude_; }

    /// Models whose curves are the prototype's.
    void add_equal(std::initializer_list<BenchScene> scenes) {
        for (const BenchScene scene : scenes) add_equal(scene, similitude_);
    }
    void add_equal(BenchScene scene, const Similitude& similitude) {
        cases_.push_back({.law = law_, .scene = scene, .similitude = similitude, .collapses = true});
    }
    void add(BenchScene scene, const Break& broken, Measure measure = Measure::peak) { add(scene, similitude_, broken, measure); }
    void add(BenchScene scene, const Similitude& similitude, const Break& broken = {}, Measure measure = Measure::peak) {
        cases_.push_back({.law = law_,
                          .scene = scene,
                          .similitude = similitude,
                          .broken = broken,
                          .measure = measure,
                          .prediction = predict(scene, similitude, broken, measure)});
    }

    std::vector<SimilitudeCase> take() { return std::move(cases_); }

  private:
    std::string law_;
    Similitude similitude_;
    std::vector<SimilitudeCase> cases_;
};

std::vector<SimilitudeCase> make_cases(const std::string& law) {
    using enum BenchScene;
    CaseList list(law);
    const Similitude& own = list.similitude();
    const auto aluminium = [&](Law of) {
        return Similitude({.length = kLength, .friction = kAluminiumFriction, .density = 2700.0 / 2320.0}, of);
    };
    if (law == "mu") {
        list.add_equal({slide});
        list.add(slide, {BrokenGroup::friction, 0.5});
        list.add(slide, {BrokenGroup::duration, 1.5});
        list.add(slide, own_solid(own));
        list.add(rock, own);
        list.add(rock, aluminium(Law::mu));
    } else if (law == "froude") {
        list.add_equal({slide, rock});
        list.add_equal(column, Similitude({.length = kBitLength, .density = 0.5}, Law::froude));
        list.add(slide, {BrokenGroup::friction, 2.0});
        list.add(slide, own_solid(own));
        list.add(slide, aluminium(Law::froude));
        list.add(rock, {BrokenGroup::amplitude, 1.2});
        list.add(rock, own_solid(own));
    } else if (law == "exact") {
        list.add_equal({slide, rock, chain});
        list.add_equal(column, Similitude({.length = kBitLength, .gravity = 4.0, .density = 0.5}, Law::exact));
        list.add(slide, {BrokenGroup::amplitude, 1.25});
        list.add(rock, {BrokenGroup::duration, 1.25});
        list.add(chain, {BrokenGroup::stiffness, 4.0});
    } else if (law == "cauchy") {
        // a/g is not kept: no equal groups, though nothing slips
        list.add(chain, own);
        list.add(chain, {BrokenGroup::stiffness, 4.0});
        list.add(chain, {BrokenGroup::stiffness, 4.0}, Measure::peak_time);
        list.add(chain, {BrokenGroup::stiffness, 0.25}, Measure::peak_time);
        list.add(slide, own);
    } else {
        list.add_equal({slide, rock, chain});
        list.add_equal(column, Similitude({.length = kBitLength, .gravity = 1.0 / kBitLength}, Law::exact));
        list.add(slide, {BrokenGroup::gravity, 0.5});
        list.add(rock, {BrokenGroup::gravity, 0.8});
    }
    return list.take();
}

void multiply(BrokenGroup group, double factor, scene::Scene& scene) {
    switch (group) {
        case BrokenGroup::none:
            break;
        case BrokenGroup::friction:
            scene.material.friction *= factor;
            break;
        case BrokenGroup::gravity:
            for (scaling::Acceleration& component : scene.gravity) component *= factor;
            break;
        case BrokenGroup::amplitude:
            scene.base_motion.factors.velocity *= factor;
            break;
        case BrokenGroup::duration:
            scene.base_motion.factors.time *= factor;
            scene.base_motion.factors.velocity *= factor;
            break;
        case BrokenGroup::stiffness:
            scene.material.normal_stiffness *= factor;
            scene.material.shear_stiffness *= factor;
            break;
    }
}

}  // namespace

std::string_view to_string(BrokenGroup group) {
    constexpr std::array<std::string_view, 6> kNames{"none", "friction", "gravity", "amplitude", "duration", "stiffness"};
    return kNames[static_cast<std::size_t>(group)];
}

std::string_view to_string(Measure measure) { return measure == Measure::peak ? "peak" : "peak time"; }

std::vector<std::string> similitude_law_names() { return {"mu", "froude", "exact", "cauchy", "centrifuge"}; }

std::vector<SimilitudeCase> make_similitude_cases(const std::string& law) {
    const std::vector<std::string> names = similitude_law_names();
    if (!law.empty() && std::find(names.begin(), names.end(), law) == names.end()) {
        throw scaling::SimilitudeError(fmt::format("law: \"{}\" has no cases (known: {})", law, fmt::join(names, ", ")));
    }
    std::vector<SimilitudeCase> all;
    for (const std::string& name : names) {
        if (!law.empty() && law != name) continue;
        for (SimilitudeCase& made : make_cases(name)) all.push_back(std::move(made));
    }
    return all;
}

Prediction predict(BenchScene scene, const Similitude& similitude, const Break& broken, Measure measure) {
    const GroupRatios groups = compare_groups(similitude, broken);
    switch (scene) {
        case BenchScene::slide:
            return predict_slide(groups);
        case BenchScene::rock:
            return predict_rock(groups);
        case BenchScene::chain:
            return predict_chain(groups, measure);
        case BenchScene::column:
            break;
    }
    throw std::invalid_argument("prediction: the column has no closed form; compare it with its shadow");
}

scene::Scene make_model_scene(const SimilitudeCase& wanted) {
    scene::Scene model = scene::scale_scene(make_bench_scene(wanted.scene), wanted.similitude);
    multiply(wanted.broken.group, wanted.broken.factor, model);
    return model;
}

}  // namespace musim::lsdem::study
