#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scaling/factor_rounding.hpp"
#include "scaling/laws/model_scales.hpp"

namespace musim::scaling {

/// Severity of a distortion.
enum class Severity {
    note,     ///< off by less than kNoteLimit: below what friction tests resolve, systematic all the same
    warning,  ///< the model answers another question by this factor
    error,    ///< the model moves in another way (sliding for rocking); the effect says what would repair it, if anything
};

/// "note", "warning" or "error".
std::string_view to_string(Severity severity);

/// Severity of a group that is off by `factor`, by size alone; nothing when it is kept up to rounding.
std::optional<Severity> find_severity(double factor);

/// A requirement of similitude that the model does not meet.
struct Distortion {
    std::string group;    ///< the dimensionless group Π, e.g. "a/(mu g)"
    double factor = 1.0;  ///< δ = Π of the model / Π of the prototype
    Severity severity = Severity::warning;
    std::string effect;  ///< what it does to the response, one line
};

/// Knowledge of prototype and model beyond the similitude. Groups that need an absent value are left out.
struct ModelProperties {
    std::optional<double> friction_prototype;  ///< μ of the prototype [-]
    std::vector<double> slenderness;           ///< tan α = width/height of each rocking direction of a block [-]
    std::optional<double> normal_stiffness;    ///< actual λ of the face stiffness k_n (required: Similitude::stiffness_static())
    std::optional<double> shear_stiffness;     ///< actual λ of the face stiffness k_s (required: Similitude::stiffness())
    std::optional<double> restitution;         ///< actual λ of the coefficient of restitution (required: 1)
    std::optional<double> height_deviation;    ///< actual λ of the block height deviation σ_H (required: λ_l)
};

/// δ of every dimensionless group that is known, in a fixed order, distorted or not. Where widths and heights scale apart, l in groups of
/// sliding and velocity is a horizontal size, as slip is; in groups of contacts it is the height. p goes by half diagonals, where
/// slenderness is given by those of the direction that is slenderest, which rocks first, and by heights otherwise; e_r of that direction
/// is given where heights and widths may scale apart, unless a block is too stocky to go on rocking.
std::vector<NamedFactor> group_factors(const ModelScales& scales, const ModelProperties& properties = {});

/// The groups of group_factors() that differ from 1 by more than rounding, in the same order, with what that means. When friction and
/// slenderness are given and μ/tan α lies on different sides of 1 in prototype and model, that entry is an error.
/// Throws SimilitudeError when a given value is not positive and finite.
std::vector<Distortion> find_distortions(const ModelScales& scales, const ModelProperties& properties = {});

/// A group off by less than this is a note, not a warning [-]. Why this value: 5 % on each friction coefficient leave 7.1 % in λ_μ
/// (docs/theory/similitude.md), so below 10 % a test cannot distinguish the distortion from its own uncertainty. Changes labels only, never
/// factors.
inline constexpr double kNoteLimit = 0.10;

}  // namespace musim::scaling
