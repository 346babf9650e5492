#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "scaling/uncertain_law.hpp"

namespace musim::scaling::detail {

using Powers = std::vector<double>;  ///< of the inputs, one each

/// sum += times · powers, entry by entry.
void add(Powers& sum, const Powers& powers, double times);

/// n as a double.
double to_double(const Rational& number);

/// Which inputs are in the factors that were given to a law and in the prototype's values, and to which power.
class LawInputs {
  public:
    /// Throws SimilitudeError when a prototype's value contradicts the lower value of its factor.
    LawInputs(const SolvedLaw& solved, const std::vector<UncertainFactor>& given, const std::vector<UncertainPrototype>& prototype);

    const std::vector<UncertainInput>& all() const { return inputs_; }

    /// Powers of the inputs in Π λ_j^exponent_j of chosen factors; one exponent per quantity.
    Powers of_factors(const std::vector<Rational>& exponents) const;

    /// Powers of the inputs in a quantity of the prototype.
    Powers of_value(std::size_t quantity) const;

    /// Whether a factor was given with an uncertainty.
    bool is_uncertain(std::size_t quantity) const { return factors_[quantity].above || factors_[quantity].below; }

  private:
    using Place = std::optional<std::size_t>;
    struct RatioPlaces {
        Place above, below;
    };

    Place add_input(const std::string& name, const Uncertain& quantity, const RationalDimension& dimension);

    std::vector<UncertainInput> inputs_;
    std::vector<RatioPlaces> factors_;
    std::vector<Place> values_;
};

}  // namespace musim::scaling::detail
