#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "scaling/detail/wide_product.hpp"
#include "scaling/laws/scale_law.hpp"

namespace musim::scaling {

/// λ of each quantity of a law that is chosen; none for the others.
using ChosenFactors = std::vector<std::optional<double>>;

/// A law solved once, whose formulas take other values of the factors that it was given: the same numbers as solve_law() finds with those
/// values, some hundred times as fast. For searches and samples.
class LawFormulas {
  public:
    explicit LawFormulas(SolvedLaw solved);

    const SolvedLaw& solved() const { return solved_; }

    /// The chosen factors with given ones at new values, defaults as they were. Throws SimilitudeError as solve_law() does, and PiError for
    /// a factor that was not given when the law was solved.
    ChosenFactors choose(const std::vector<GivenFactor>& given) const;

    /// The factor of a quantity, by position; none while it is open. Throws SimilitudeError when it leaves the range of doubles.
    std::optional<double> factor(std::size_t quantity, const ChosenFactors& chosen) const;

    /// δ of a held and of a watched product, by position; as factor().
    std::optional<double> held(std::size_t product, const ChosenFactors& chosen) const;
    std::optional<double> watched(std::size_t product, const ChosenFactors& chosen) const;

  private:
    SolvedLaw solved_;
    std::vector<detail::RootedProduct> factors_, held_, watched_;
    std::vector<std::size_t> settled_;  ///< held products that chosen factors alone settle, which may contradict them
};

}  // namespace musim::scaling
