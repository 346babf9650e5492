#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scaling/pi_quantity.hpp"

namespace musim::scaling {

/// A dimensionless product of quantities, which model and prototype may or may not share.
struct ScaleProduct {
    std::string text;                 ///< as it was written
    std::vector<Rational> exponents;  ///< one per quantity
    bool is_definition = false;       ///< true by the meaning of its quantities, as v t/l: nothing that a model could give up
};

/// A product by the grammar of parse_group(). Throws PiError when it cannot be read or is not dimensionless (says in what it is).
ScaleProduct parse_scale_product(std::string_view text, const std::vector<PiQuantity>& quantities, bool is_definition = false);

/// Throws SimilitudeError when a chosen factor is not positive and finite.
void check_chosen_factor(std::string_view name, double factor);

/// Which scale factors λ = model/prototype follow from some of them.
struct ScaleProblem {
    std::vector<PiQuantity> quantities;
    std::vector<std::optional<double>> chosen;  ///< λ of each quantity, where it is chosen
    std::vector<ScaleProduct> held;             ///< equal in model and prototype
    std::vector<ScaleProduct> watched;          ///< asked for only
};

/// A factor as a product of powers of chosen and free ones.
struct ScaleFactor {
    std::vector<Rational> exponents;  ///< one per quantity; zero but for chosen and free ones
    std::optional<double> value;      ///< none while a free factor is in it
    std::vector<std::size_t> needs;   ///< the free factors in it
};

enum class ScaleState {
    chosen,
    solved,  ///< follows from chosen factors
    free,    ///< may be chosen; stands for itself in other factors
    needs,   ///< follows once the free factors it needs are chosen
};

/// "chosen", "solved", "free" or "needs".
std::string_view to_string(ScaleState state);

/// The factor of a quantity.
struct QuantityScale {
    ScaleState state = ScaleState::free;
    ScaleFactor factor;
};

/// A held product that the chosen factors contradict. The products in `with` and the product itself are the fewest that do.
struct ScaleConflict {
    std::size_t held = 0;             ///< position of the product
    std::vector<std::size_t> with;    ///< held products before it that leave no way out
    std::vector<std::size_t> chosen;  ///< quantities whose chosen factors are at odds
};

/// Solution of the factors. A product's δ = Π λ^exponent is its value in the model over its value in the prototype.
struct ScaleSolution {
    std::vector<QuantityScale> quantities;
    std::vector<ScaleFactor> held;     ///< δ of each held product: 1, or what the contradiction leaves
    std::vector<ScaleFactor> watched;  ///< δ of each watched product
    std::size_t free_count = 0;        ///< how many more factors may be chosen
    std::vector<std::size_t> open;     ///< among these: free ones and those that need them
    std::vector<ScaleConflict> conflicts;
};

/// Solves Σ_j e_ij log λ_j = 0 for all held products i, exactly over the rationals: big integers, no rounding, no tolerance on exponents.
///
/// The first quantities of the problem that may be free are. Held products are met in their order: one that the products before it settle
/// is either kept by them, or contradicted when its δ, a product of chosen factors alone, is not 1. Values are products of whole powers
/// with one root at the end: factors that are powers of two stay exact where the exponents allow.
/// Throws PiError (check_quantities(), exponents beyond 64 bits) and SimilitudeError (a chosen factor that is not positive and finite, a
/// factor that leaves the range of doubles).
ScaleSolution solve_scales(const ScaleProblem& problem);

}  // namespace musim::scaling
