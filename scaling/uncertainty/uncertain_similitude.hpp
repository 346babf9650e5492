#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scaling/laws/model_scales.hpp"
#include "scaling/structures/distortion.hpp"
#include "scaling/uncertainty/monte_carlo.hpp"
#include "scaling/uncertainty/uncertain_result.hpp"

namespace musim::scaling {

/// Measures of the prototype's motion that are carried to the model, each with its uncertainty.
struct UncertainMotion {
    Shaking direction = Shaking::horizontal;
    std::optional<UncertainQuantity<Acceleration>> pga;
    std::optional<UncertainQuantity<Velocity>> pgv;
    std::optional<UncertainQuantity<Length>> pgd;
    std::optional<UncertainQuantity<Velocity>> arias;  ///< Arias intensity with the g of each scale
    std::optional<UncertainQuantity<Time>> duration;
    std::optional<UncertainQuantity<Time>> time_step;
};

/// A similitude whose inputs are uncertain.
struct UncertainScales {
    UncertainRatio length, friction, gravity, density;  ///< λ, or values of model and prototype as a fraction
    std::vector<UncertainFactor> others;                ///< of quantities that have no option of their own

    std::optional<Uncertain> friction_prototype;      ///< μ of the prototype; else the denominator of `friction`, if it has one
    std::vector<Uncertain> slenderness;               ///< tan α of each direction
    std::optional<UncertainQuantity<Length>> height;  ///< l of the prototype
    UncertainMotion motion;

    /// λ by value.
    ScaleFactors factors() const;

    /// Whether anything of it is uncertain.
    bool is_uncertain() const;
};

/// Makes the model scales of chosen factors by the law in use; the second are the values of UncertainScales::others. From any thread.
using MakeModelScales = std::function<ModelScales(const ScaleFactors&, const std::vector<GivenFactor>&)>;

/// Results of a similitude with uncertain inputs.
struct UncertainReport {
    std::vector<UncertainInput> inputs;    ///< the uncertain ones; the order of all exponents
    std::vector<UncertainResult> factors;  ///< of ModelScales::factors()
    std::vector<UncertainResult> groups;   ///< δ of group_factors(), were the motion scaled by the true factors
    std::vector<UncertainResult> shaken;   ///< δ of the groups of sliding, with the motion scaled by the values
    std::vector<UncertainPair> structure;  ///< groups with absolute values, as far as friction, slenderness, height and peaks are known
    std::vector<UncertainPair> measures;   ///< of the motion; the model's were it scaled by the true factors
    std::optional<Draws> draws;            ///< none without samples

    bool is_certain() const { return inputs.empty(); }
};

/// Propagates the uncertainties of a similitude to its factors, groups and measures.
///
/// A fraction's two values are independent inputs and enter everywhere by themselves: μ of the model enters λ_μ and its own μ/tan α, and
/// cancels where it should. `groups` and `measures` say what the law asks for, uncertain because the inputs are. `shaken` and the model's
/// μ^N and a/(μ g) in `structure` say what a test has that is shaken with the factors' values, as one does: there u(μ^N)² = u(v)² +
/// (u(l)² + u(μ)² + u(g)²)/4, relative, and u(a/(μ g))² = u(a)² + u(μ)² + u(g)². A vertical motion has one group, a/g.
///
/// Throws SimilitudeError when the factors cannot be a similitude, when the law holds a factor that is uncertain, when
/// friction_prototype contradicts the denominator of `friction`, and as run_monte_carlo() does.
UncertainReport propagate(const UncertainScales& scales, const MakeModelScales& make_scales, const ModelProperties& properties,
                          const std::optional<MonteCarloSettings>& monte_carlo);

}  // namespace musim::scaling
