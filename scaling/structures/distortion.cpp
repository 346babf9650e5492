#include "scaling/structures/distortion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "scaling/laws/group_meaning.hpp"
#include "scaling/structures/regime_borders.hpp"
#include "scaling/structures/rocking_block.hpp"

namespace musim::scaling {

namespace {

constexpr std::string_view kRegimeGroup = "mu/tan(alpha)";
constexpr std::string_view kRestitutionGroup = "e_r";

void check_positive(std::string_view name, std::optional<double> value) {
    if (!value || (std::isfinite(*value) && *value > 0.0)) return;
    throw SimilitudeError(fmt::format("distortions: {} is {} (must be positive and finite); correct it or leave it out", name, *value));
}

void check(const ModelProperties& properties) {
    check_positive("the prototype's friction coefficient", properties.friction_prototype);
    for (const double slenderness : properties.slenderness) check_positive("a slenderness tan(alpha)", slenderness);
    check_positive("the normal stiffness factor", properties.normal_stiffness);
    check_positive("the shear stiffness factor", properties.shear_stiffness);
    check_positive("the restitution factor", properties.restitution);
    check_positive("the height deviation factor", properties.height_deviation);
}

/// Blocks of one slenderness in prototype and model, with heights of 1.
struct RockingPair {
    RockingBlock prototype, model;

    RockingPair(double slenderness, const ModelScales& scales)
        : prototype{Length::from_value(slenderness), Length::from_value(1.0)},
          model{Length::from_value(slenderness * scales.slenderness()), Length::from_value(1.0)} {}

    /// λ of half diagonals over that of heights; 1 to the bit where all lengths scale alike.
    double half_diagonal() const { return model.half_diagonal() / prototype.half_diagonal(); }
};

/// The direction in which blocks rock first.
std::optional<RockingPair> find_slenderest(const ModelScales& scales, const ModelProperties& properties) {
    if (properties.slenderness.empty()) return std::nullopt;
    return RockingPair(*std::min_element(properties.slenderness.begin(), properties.slenderness.end()), scales);
}

/// "e_r goes from 0.8606 to 0.9861 at tan(alpha) = 0.32, ..." for every direction; empty where widths do not scale apart.
std::string describe_restitutions(const ModelScales& scales, const ModelProperties& properties) {
    std::string text;
    for (const double slenderness : properties.slenderness) {
        const RockingPair pair(slenderness, scales);
        text += fmt::format("{} from {:.4g} to {:.4g} at tan(alpha) = {:.4g}", text.empty() ? "; it goes" : ",",
                            pair.prototype.angular_restitution(), pair.model.angular_restitution(), slenderness);
    }
    return text;
}

/// One clause for each direction in which μ/tan α lies on the other side of 1 in the model; empty when there is none.
std::string describe_regime_changes(const detail::Border& regime, const ModelScales& scales, const ModelProperties& properties) {
    std::string text;
    if (!properties.friction_prototype) return text;
    for (const double slenderness : properties.slenderness) {
        const double prototype = *properties.friction_prototype / slenderness;
        const double model = prototype * (scales.friction / scales.slenderness());
        if ((prototype > 1.0) == (model > 1.0)) continue;
        text += fmt::format("{}at tan(alpha) = {:.4g} mu/tan(alpha) goes from {:.4g} ({}) to {:.4g} ({})", text.empty() ? "" : "; ",
                            slenderness, prototype, name_side(regime, prototype), model, name_side(regime, model));
    }
    return text;
}

}  // namespace

std::string_view to_string(Severity severity) {
    constexpr std::string_view kNames[] = {"note", "warning", "error"};
    return kNames[static_cast<std::size_t>(severity)];
}

std::optional<Severity> find_severity(double factor) {
    const double deviation = std::abs(factor - 1.0);
    if (deviation <= kFactorRounding) return std::nullopt;
    return deviation < kNoteLimit ? Severity::note : Severity::warning;
}

std::vector<NamedFactor> group_factors(const ModelScales& scales, const ModelProperties& properties) {
    check(properties);
    const double friction = scales.friction;
    const double gravity = scales.gravity;
    const double mass = scales.mass;

    // groups of the motion: scales alone
    const double shaking = scales.acceleration / gravity;
    const std::optional<RockingPair> slenderest = find_slenderest(scales, properties);
    const double half_diagonal = scales.height * (slenderest ? slenderest->half_diagonal() : 1.0);
    std::vector<NamedFactor> factors = {
        {"mu^N", scales.velocity / std::sqrt(friction * gravity * scales.width)},
        {"t*sqrt(mu*g/l)", scales.time * std::sqrt(friction * gravity / scales.width)},
        {"a/(mu*g)", scales.acceleration / (friction * gravity)},
        {"a/g", shaking},
        {"a/(g*tan(alpha))", shaking / scales.slenderness()},
        {"a_vertical/g", scales.acceleration_vertical / gravity},
        {"omega/p", scales.frequency / std::sqrt(gravity / half_diagonal)},
        {"Fr^N", scales.velocity / std::sqrt(gravity * scales.width)},
        {kRegimeGroup, friction / scales.slenderness()},
        {"mu", friction},
    };

    // groups of the contacts and of the blocks' making: what the model really has
    if (properties.normal_stiffness) {
        factors.push_back({"kappa_n", *properties.normal_stiffness / scales.static_stiffness});
        factors.push_back({"C^N", scales.velocity / (scales.height * std::sqrt(*properties.normal_stiffness / mass))});
    }
    if (properties.shear_stiffness) {
        factors.push_back({"S_e^N", std::sqrt(*properties.shear_stiffness * scales.height / (friction * mass * gravity))});
    }
    if (properties.normal_stiffness && properties.shear_stiffness)
        factors.push_back({"k_s/k_n", *properties.shear_stiffness / *properties.normal_stiffness});
    if (properties.restitution) factors.push_back({"c_res", *properties.restitution});
    if (properties.height_deviation) factors.push_back({"sigma_H/H", *properties.height_deviation / scales.height});
    if (properties.normal_stiffness && properties.height_deviation) {
        factors.push_back({"delta_w/sigma_H", scales.weight / (*properties.normal_stiffness * *properties.height_deviation)});
    }

    // where heights and widths may scale apart, so does what an impact leaves of a rotation
    if (slenderest && !scales.similitude) {
        const double prototype = slenderest->prototype.angular_restitution(), model = slenderest->model.angular_restitution();
        if (prototype > 0.0 && model > 0.0) factors.push_back({kRestitutionGroup, model / prototype});
    }
    return factors;
}

std::vector<Distortion> find_distortions(const ModelScales& scales, const ModelProperties& properties) {
    std::vector<Distortion> distortions;
    for (const NamedFactor& group : group_factors(scales, properties)) {
        const std::optional<Severity> severity = find_severity(group.value);
        if (!severity) continue;
        Distortion distortion{.group = std::string(group.name),
                              .factor = group.value,
                              .severity = *severity,
                              .effect = std::string(find_group_meaning(group.name).effect(group.value))};
        if (group.name == kRestitutionGroup) distortion.effect += describe_restitutions(scales, properties);
        if (group.name == kRegimeGroup) {
            const detail::Border& regime = *detail::find_border(kRegimeGroup);
            const std::string changes = describe_regime_changes(regime, scales, properties);
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
