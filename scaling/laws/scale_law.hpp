#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scaling/laws/scale_solver.hpp"

namespace musim::scaling {

/// A quantity that a law speaks of.
struct LawQuantity {
    PiQuantity quantity;  ///< its value, if one is known, is the prototype's: no part of the law
    std::string unit;     ///< as written
    std::string meaning;
};

/// A factor that a law expects to be chosen.
struct LawChoice {
    std::string name;
    std::optional<double> fallback;  ///< taken where nothing settles the factor; none: it has to be given or follow
};

/// Amount that has to be added to a quantity to reach another of the same kind, as mass to a model: (λ_total - λ_own) times the
/// prototype's.
struct LawAddition {
    std::string name;
    std::string meaning;
    std::string total;
    std::string own;
};

/// A law of similitude as data (schema musim-law/1): which products model and prototype share, hence which scale factors follow.
struct ScaleLaw {
    std::string name;
    std::string title;        ///< one line
    std::string description;  ///< what it keeps and what it is for
    std::vector<std::string> sources;
    std::vector<std::string> assumptions;
    std::vector<LawQuantity> quantities;
    std::vector<LawChoice> choices;        ///< fallbacks are taken in this order
    std::vector<std::string> definitions;  ///< products that are dimensionless numbers by the meaning of their quantities: v t/l
    std::vector<std::string> held;
    std::vector<std::string> watched;
    std::vector<LawAddition> additions;
};

/// Names, dimensions and values, in the order of the law.
std::vector<PiQuantity> quantities_of(const ScaleLaw& law);

/// Throws PiError: what check_quantities() and parse_scale_product() refuse, a choice or an addition of an unknown quantity, a quantity
/// chosen twice, a default that is not positive and finite, an addition whose quantities differ in dimension.
void check_law(const ScaleLaw& law);

/// λ of a quantity, given by name.
struct GivenFactor {
    std::string name;
    double factor = 1.0;
};

/// A law with numbers.
struct SolvedLaw {
    ScaleLaw law;
    ScaleProblem problem;  ///< its definitions first among the held products
    ScaleSolution solution;
    std::vector<bool> is_default;        ///< of each quantity: chosen as the law's default
    std::vector<std::size_t> overruled;  ///< quantities whose default is not taken, as other factors settle them otherwise

    /// The factor of a quantity; none when the law has no such quantity or its factor is open.
    std::optional<double> factor(std::string_view name) const;

    /// λ_total - λ_own of an addition; none while one of them is open.
    std::optional<double> added(const LawAddition& addition) const;

    /// The quantity of which added() is a share: the model's own where its prototype is known, else the total, if that is; none else.
    std::optional<std::size_t> find_base(const LawAddition& addition) const;
};

/// A factor that a law expects to be chosen, that was not given and does not follow. One line.
class MissingFactor : public SimilitudeError {
  public:
    using SimilitudeError::SimilitudeError;
};

/// Solves a law with the given factors. Any quantity of the law may be given, not only those it expects. Its defaults are then taken one
/// by one where nothing settles the factor yet: true replicas ask for a density where the modulus is given, for a modulus otherwise.
/// Throws SimilitudeError: PiError for an unknown name or one given twice; given factors that contradict what the law holds (names them
/// and the products, says what to release or to watch); MissingFactor.
SolvedLaw solve_law(const ScaleLaw& law, const std::vector<GivenFactor>& given);

}  // namespace musim::scaling
