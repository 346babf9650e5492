#pragma once

#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "scaling/rational_dimension.hpp"
#include "scaling/uncertain.hpp"

namespace musim::scaling {

/// One of the independent inputs whose uncertainty is propagated.
struct UncertainInput {
    std::string name;
    Uncertain quantity;  ///< SI
    RationalDimension dimension = {};
};

/// The results that follow from values of the inputs, in the order of the inputs. An input that enters in several places enters by one
/// value, so results are correlated as they should be.
using Evaluation = std::function<std::vector<double>(std::span<const double> values)>;

/// A result and its uncertainty to first order, which needs no distribution.
struct FirstOrder {
    double value = 1.0;
    double relative = 0.0;               ///< u/value: √Σ (n_i u_i/x_i)²
    std::vector<double> exponents = {};  ///< n_i = ∂ln(result)/∂ln(x_i), one for each input

    double uncertainty() const { return relative * std::abs(value); }
};

/// First order of value = c Π x_i^(n_i), whose exponents are known, one for each input.
FirstOrder make_first_order(double value, std::vector<double> exponents, const std::vector<UncertainInput>& inputs);

/// By how much, as a factor or its inverse, inputs are moved [-]. Smaller: rounding, 1e-16 over its logarithm, shows; larger: what is no
/// product of powers has an error of its logarithm squared, 1e-6. Changes nothing where results are products.
inline constexpr double kMove = 1.0 + 0x1p-10;

/// All results with one input divided and multiplied by kMove.
struct MovedResults {
    std::vector<double> below, above;
};

/// First order of any smooth results, from what they are at the inputs' values and with each input moved: n_i = ∂ln|y|/∂ln(x_i) by central
/// differences, exact for products of powers, where what rounding adds is taken off (multiples of 1/12). Results that no input changes may
/// be zero. `moved` has one entry for each input.
std::vector<FirstOrder> find_first_order(const std::vector<double>& results, const std::vector<UncertainInput>& inputs,
                                         const std::vector<MovedResults>& moved);

/// The same where results can be evaluated at any values: relative variances of independent inputs add, each times the square of its
/// exponent [JCGM100] 5.1.6. Throws SimilitudeError, which names the input, when a law refuses it moved.
std::vector<FirstOrder> propagate_first_order(const std::vector<UncertainInput>& inputs, const Evaluation& evaluate);

/// Probability of the coverage interval, as much of it on either side.
inline constexpr double kCoverage = 0.95;

/// From the lower to the upper end, both included.
struct CoverageInterval {
    double lower = 0.0, upper = 0.0;

    bool contains(double value) const { return lower <= value && value <= upper; }
};

/// The interval of a result to first order: value e^(∓ z u/value) with z the normal quantile of (1 + kCoverage)/2, 1.96 [JCGM100] G.1.3.
/// Symmetric in logarithms, in which a product of powers is linear: the interval of 1/y has the ends of that of y upside down, and never
/// reaches zero. For small u/value it is value ∓ z u.
CoverageInterval find_interval(const FirstOrder& result);

}  // namespace musim::scaling
