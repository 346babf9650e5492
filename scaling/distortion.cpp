#include "scaling/distortion.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <utility>

#include "scaling/detail/border.hpp"
#include "scaling/group_meaning.hpp"

namespace musim::scaling {

namespace {

constexpr std::string_view kRegimeGroup = "mu/tan(alpha)";

void check_positive(std::string_view name, std::optional<double> value) {
    if (!value || (std::isfinite(*value) && *value > 0.0)) return;
    throw SimilitudeError(fmt::format("distortions: {} is {} (must be positive and finite); correct it or leave it out", name, *value));
}

void check(const ModelFacts& facts) {
    check_positive("the prototype's friction coefficient", facts.friction_prototype);
    for (const double slenderness : facts.slenderness) check_positive("a slenderness tan(alpha)", slenderness);
    check_positive("the normal stiffness factor", facts.normal_stiffness);
    check_positive("the shear stiffness factor", facts.shear_stiffness);
    check_positive("the restitution factor", facts.restitution);
    check_positive("the height deviation factor", facts.height_deviation);
}

/// One clause for each direction in which μ/tan α lies on the other side of 1 in the model; empty when there is none.
std::string describe_regime_changes(const detail::Border& regime, const ModelScales& scales, const ModelFacts& facts) {
    std::string text;
    if (!facts.friction_prototype) return text;
    for (const double slenderness : facts.slenderness) {
        const double prototype = *facts.friction_prototype / slenderness;
        const double model = prototype * (scales.friction / scales.slenderness());
        if ((prototype > 1.0) == (model > 1.0)) continue;
        text += fmt::format("{}at tan(alpha) = {:.4g} mu/tan(alpha) goes from {:.4g} ({}) to {:.4g} ({})", text.empty() ? "" : "; ",
                            slenderness, prototype, name_side(regime, prototype), model, name_side(regime, model));
    }
    return text;
}

}  // namespace

std::string_view to_string(Severity severity) {
    switch (severity) {
        case Severity::note:
            return "note";
        case Severity::warning:
            return "warning";
        case Severity::error:
            break;
    }
    return "error";
}

std::optional<Severity> find_severity(double factor) {
    const double deviation = std::abs(factor - 1.0);
    if (deviation <= kFactorRounding) return std::nullopt;
    return deviation < kNoteLimit ? Severity::note : Severity::warning;
}

std::vector<NamedFactor> group_factors(const ModelScales& scales, const ModelFacts& facts) {
    check(facts);
    const double friction = scales.friction;
    const double gravity = scales.gravity;
    const double mass = scales.mass;

    // groups of the motion: scales alone
    const double shaking = scales.acceleration / gravity;
    std::vector<NamedFactor> factors = {
        {"mu^N", scales.velocity / std::sqrt(friction * gravity * scales.width)},
        {"t*sqrt(mu*g/l)", scales.time * std::sqrt(friction * gravity / scales.width)},
        {"a/(mu*g)", scales.acceleration / (friction * gravity)},
        {"a/g", shaking},
        {"a/(g*tan(alpha))", shaking / scales.slenderness()},
        {"a_vertical/g", scales.acceleration_vertical / gravity},
        {"omega/p", scales.frequency / std::sqrt(gravity / scales.height)},
        {"Fr^N", scales.velocity / std::sqrt(gravity * scales.width)},
        {kRegimeGroup, friction / scales.slenderness()},
        {"mu", friction},
    };

    // groups of the contacts and of the blocks' making: what the model really has
    if (facts.normal_stiffness) {
        factors.push_back({"kappa_n", *facts.normal_stiffness / scales.static_stiffness});
        factors.push_back({"C^N", scales.velocity / (scales.height * std::sqrt(*facts.normal_stiffness / mass))});
    }
    if (facts.shear_stiffness) {
        factors.push_back({"S_e^N", std::sqrt(*facts.shear_stiffness * scales.height / (friction * mass * gravity))});
    }
    if (facts.normal_stiffness && facts.shear_stiffness) factors.push_back({"k_s/k_n", *facts.shear_stiffness / *facts.normal_stiffness});
    if (facts.restitution) factors.push_back({"c_res", *facts.restitution});
    if (facts.height_deviation) factors.push_back({"sigma_H/H", *facts.height_deviation / scales.height});
    if (facts.normal_stiffness && facts.height_deviation) {
        factors.push_back({"delta_w/sigma_H", scales.weight / (*facts.normal_stiffness * *facts.height_deviation)});
    }
    return factors;
}

std::vector<Distortion> find_distortions(const ModelScales& scales, const ModelFacts& facts) {
    std::vector<Distortion> distortions;
    for (const NamedFactor& group : group_factors(scales, facts)) {
        const std::optional<Severity> severity = find_severity(group.value);
        if (!severity) continue;
        Distortion distortion{.group = std::string(group.name),
                              .factor = group.value,
                              .severity = *severity,
                              .effect = std::string(find_group_meaning(group.name).effect(group.value))};
        if (group.name == kRegimeGroup) {
            const detail::Border& regime = *detail::find_border(kRegimeGroup);
            const std::string changes = describe_regime_changes(regime, scales, facts);
            if (!changes.empty()) {
                distortion.severity = Severity::error;
                distortion.effect = fmt::format("{}; {}", changes, regime.remedy);
            }
        }
        distortions.push_back(std::move(distortion));
    }
    return distortions;
}

}  // namespace musim::scaling
