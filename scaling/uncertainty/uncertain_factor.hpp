#pragma once

#include <string>
#include <vector>

#include "scaling/laws/scale_law.hpp"
#include "scaling/uncertain.hpp"

namespace musim::scaling {

/// λ of a quantity with its uncertainty, or the quantity's values in model and prototype as a fraction.
struct UncertainFactor {
    std::string name;
    UncertainRatio factor;
};

/// Their values, as solve_law() takes them.
std::vector<GivenFactor> values_of(const std::vector<UncertainFactor>& factors);

}  // namespace musim::scaling
