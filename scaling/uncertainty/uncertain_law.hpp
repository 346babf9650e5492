#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scaling/uncertainty/monte_carlo.hpp"
#include "scaling/uncertainty/uncertain_result.hpp"

namespace musim::scaling {

/// Value of a quantity in the prototype [SI], with its uncertainty.
struct UncertainPrototype {
    std::string name;
    Uncertain value;
};

/// A difference of two products, which may be zero or negative.
struct UncertainDifference {
    double value = 0.0;
    double uncertainty = 0.0;  ///< standard, to first order
    std::optional<SampleSummary> samples;
};

/// Amount that has to be added to a quantity of the model: as a share of the prototype's, and in SI where that is known.
struct UncertainAddition {
    UncertainDifference factor;
    std::optional<UncertainDifference> model;
};

/// Results of a law with uncertain factors.
struct UncertainLawReport {
    std::vector<UncertainInput> inputs;                       ///< the uncertain ones; the order of all exponents
    std::vector<std::optional<UncertainResult>> factors;      ///< of each quantity; none while open
    std::vector<std::optional<UncertainResult>> held;         ///< δ of each held product by the true factors; none while open
    std::vector<std::optional<UncertainResult>> watched;      ///< δ of each watched product
    std::vector<UncertainResult> shaken;                      ///< δ of the products that hold a solved measure of motion, at its value
    std::vector<UncertainPair> values;                        ///< each quantity whose prototype is known and whose factor is settled
    std::vector<std::optional<UncertainAddition>> additions;  ///< of each addition; none while open
    std::optional<Draws> draws;                               ///< none without samples
};

/// Propagates the uncertainties of given factors and of the prototype's values to the factors, products and values of a solved law, which
/// was solved with values_of(given).
///
/// A solved factor is Π λ_k^(n_k) of chosen ones, so first order is exact in logarithms: (u(λ)/λ)² = Σ (n_i u_i/x_i)². A fraction's two
/// values are inputs of their own; its lower one is the prototype's, hence the same input as the quantity's value in the prototype.
/// `shaken` is what a test has whose motion is scaled by the values: there a solved quantity of motion (length and time alone, and time in
/// it: t, v, a, f) is certain, and the rest as uncertain as it is.
///
/// Throws SimilitudeError: a product that the law holds, and that chosen factors alone settle, rests on an uncertain one (nothing could
/// keep it); a prototype's value contradicts the lower value of its factor; and as run_monte_carlo() does.
UncertainLawReport propagate(const SolvedLaw& solved, const std::vector<UncertainFactor>& given,
                             const std::vector<UncertainPrototype>& prototype, const std::optional<MonteCarloSettings>& monte_carlo);

}  // namespace musim::scaling
