#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scaling/laws/scale_law.hpp"
#include "scaling/uncertain.hpp"
#include "scaling/uncertainty/monte_carlo.hpp"
#include "scaling/uncertainty/propagate.hpp"

namespace musim::scaling {

/// λ of a quantity with its uncertainty, or the quantity's values in model and prototype as a fraction.
struct UncertainFactor {
    std::string name;
    UncertainRatio factor;
};

/// Their values, as solve_law() takes them.
std::vector<GivenFactor> values_of(const std::vector<UncertainFactor>& factors);

/// A result with its uncertainty, to first order and by samples if they were drawn.
struct UncertainResult {
    std::string name;
    FirstOrder first_order;
    std::optional<SampleSummary> samples;
};

/// All results of an evaluation, to be taken one after the other as they stand in its row.
class ResultsInOrder {
  public:
    /// To first order, and by samples if these are wanted. Throws as propagate_first_order() and run_monte_carlo().
    ResultsInOrder(const std::vector<UncertainInput>& inputs, const Evaluation& evaluate, const std::optional<MonteCarloSettings>& samples);

    const std::optional<Draws>& draws() const { return draws_; }
    /// The next one, under this name.
    UncertainResult take(const std::string& name);

  private:
    std::vector<FirstOrder> results_;
    std::vector<SampleSummary> samples_;
    std::optional<Draws> draws_;
    std::size_t next_ = 0;
};

/// A group or measure at both scales.
struct UncertainPair {
    std::string name;
    RationalDimension dimension;
    UncertainResult prototype, model;
};

}  // namespace musim::scaling
