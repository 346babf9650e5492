#include "tests/benches/similitude_prediction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tests/benches/closed_responses.hpp"

namespace musim::lsdem {
namespace {

using scaling::Similitude;

/// Groups of the model over those of the prototype.
struct GroupRatios {
    double push = 1.0;       ///< a/g
    double friction = 1.0;   ///< μ
    double duration = 1.0;   ///< T over what the law asks for
    double amplitude = 1.0;  ///< a over what the law asks for
    double fall = 1.0;       ///< T√(g/l), l of widths
    double spring = 1.0;     ///< T²k/m
    double height = 1.0;     ///< height over width
    double angle = 1.0;      ///< of any angle, as the law has it
};

GroupRatios compare_groups(const TwinScales& scales, const Break& broken) {
    const Similitude& s = scales.similitude;
    const double gravity = s.gravity() * broken.of(BrokenGroup::gravity), time = s.time() * broken.of(BrokenGroup::duration);
    const double higher = broken.of(BrokenGroup::height);
    return {
        .push = s.acceleration() * broken.of(BrokenGroup::amplitude) / gravity,
        .friction = s.friction() * broken.of(BrokenGroup::friction),
        .duration = broken.of(BrokenGroup::duration),
        .amplitude = broken.of(BrokenGroup::amplitude),
        .fall = time * std::sqrt(gravity / s.length()),
        .spring = time * time * s.stiffness() * broken.of(BrokenGroup::stiffness) / s.mass() / (broken.of(BrokenGroup::density) * higher),
        .height = scales.heights * higher,
        .angle = 1.0 / scales.heights};
}

/// Share that the friction spring adds to the slip: it is stretched by μg/ω² when slip begins, then at a speed of up to 2j/ω², j = πA/T,
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
    double sinking;      ///< m g/(k_n b)
    double slenderness;  ///< tan α

    /// Greatest tilt over α.
    double turn() const { return compute_soft_tilt(strength, rate, sinking / alpha()); }
    double alpha() const { return std::atan(slenderness); }
    double tilt() const { return turn() * alpha(); }

    /// Relative error of the groups: the linear equation leaves out α²/2, and the contact the rims of a strip c = √(2 m g b/(k_n θ)), which
    /// are as wide as it is deep: the part θ of what the strip takes of the work of the weight, 4c/(3b).
    double group_error() const { return 0.5 * alpha() * alpha() + 4.0 / 3.0 * std::sqrt(2.0 * sinking / tilt()) * alpha(); }

    /// Greatest relative change of the tilt for such errors.
    double error() const {
        const double by = group_error();
        double most = 0.0;
        for (const double s : {1.0 - by, 1.0 + by}) {
            for (const double w : {1.0 - by, 1.0 + by}) {
                most = std::max(most, std::abs(compute_soft_tilt(s * strength, w * rate, sinking / alpha()) / turn() - 1.0));
            }
        }
        return most;
    }

    /// Tilt while the base holds it down, twice the static one: a strip of 3(1 − s)/2 of the width bears it.
    double lean() const {
        const double strip = std::min(1.0, 1.5 * (1.0 - strength));
        return 4.0 * sinking / (strip * strip);
    }
};

Rocker make_model_rocker(const GroupRatios& groups) {
    // half the diagonal over that of the prototype, both in units of the width
    const double size = std::hypot(kRockSlenderness, groups.height) / std::hypot(kRockSlenderness, 1.0);
    return {.strength = kRockStrength * groups.push * groups.height,
            .rate = kRockRate * std::sqrt(size) / groups.fall,
            .sinking = rock_sinking() * groups.fall * groups.fall / groups.spring,
            .slenderness = kRockSlenderness / groups.height};
}

Prediction predict_rock(const GroupRatios& groups) {
    const Rocker prototype{kRockStrength, kRockRate, rock_sinking(), kRockSlenderness};
    const Rocker model = make_model_rocker(groups);
    const double asked = prototype.tilt() * groups.angle;
    if (model.strength < 1.0) return {0.0, model.lean() / asked};
    const double ratio = model.tilt() / asked;
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

}  // namespace

std::string_view to_string(Measure measure) { return measure == Measure::peak ? "peak" : "peak time"; }

Prediction predict(BenchScene scene, const TwinScales& scales, const Break& broken, Measure measure) {
    const GroupRatios groups = compare_groups(scales, broken);
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
    throw std::invalid_argument("prediction: the column has no closed form; compare it with its copy");
}

}  // namespace musim::lsdem
