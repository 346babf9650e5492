#pragma once

#include <optional>
#include <string>

#include "scaling/uncertainty/monte_carlo.hpp"
#include "scaling/uncertainty/propagate.hpp"

namespace musim::scaling {

/// A result with its uncertainty, to first order and by samples if they were drawn.
struct UncertainResult {
    std::string name;
    FirstOrder first_order;
    std::optional<SampleSummary> samples;
};

/// A group or measure at both scales.
struct UncertainPair {
    std::string name;
    RationalDimension dimension;
    UncertainResult prototype, model;
};

}  // namespace musim::scaling
