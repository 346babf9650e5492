#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scaling/uncertainty/propagate.hpp"

namespace musim::scaling::detail {

using Values = std::vector<double>;
using Place = std::optional<std::size_t>;

/// Values by place, the uncertain ones among them by their order as inputs.
class InputValues {
  public:
    std::size_t add(const std::string& name, const Uncertain& quantity, const RationalDimension& dimension = {}) {
        if (quantity.is_uncertain()) {
            inputs_.push_back({name, quantity, dimension});
            places_.push_back(values_.size());
        }
        values_.push_back(quantity.value);
        return values_.size() - 1;
    }

    const std::vector<UncertainInput>& inputs() const { return inputs_; }

    /// All values, with `drawn` in the places of the uncertain ones.
    Values fill(std::span<const double> drawn) const {
        Values values = values_;
        for (std::size_t i = 0; i < places_.size(); ++i) values[places_[i]] = drawn[i];
        return values;
    }

  private:
    Values values_;
    std::vector<UncertainInput> inputs_;
    std::vector<std::size_t> places_;
};

/// Where the one or two values of a ratio stand.
struct RatioPlace {
    std::size_t numerator = 0;
    Place denominator;

    double value(const Values& values) const { return denominator ? values[numerator] / values[*denominator] : values[numerator]; }
};

/// A fraction's values are inputs of their own, NAME_model and NAME_prototype.
inline RatioPlace add_ratio(InputValues& values, const std::string& name, const UncertainRatio& ratio) {
    if (!ratio.denominator) return {values.add(name, ratio.numerator), {}};
    const std::size_t numerator = values.add(name + "_model", ratio.numerator);
    return {numerator, values.add(name + "_prototype", *ratio.denominator)};
}

}  // namespace musim::scaling::detail
