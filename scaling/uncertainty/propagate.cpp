#include "scaling/uncertainty/propagate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "scaling/uncertainty/distribution.hpp"

namespace musim::scaling {

namespace {

/// Exponents are whole multiples of 1/kPartsOfExponent [-]: halves and quarters of roots, thirds of volumes.
constexpr double kPartsOfExponent = 12.0;

/// Distance by which rounding may move an exponent that is found with kMove [-]: some fifty roundings of 1e-16, over twice its logarithm.
constexpr double kMovedRounding = 1e-10;

/// The exponent between two neighbors of a result.
double find_moved_exponent(double below, double value, double above) {
    const double step = 2.0 * std::log(kMove);
    // logarithms are exact for products; a result that changes sign has none
    const bool has_logarithms = below / value > 0.0 && above / value > 0.0;
    const double raw = below == above ? 0.0 : has_logarithms ? std::log(above / below) / step : (above - below) / (step * value);
    const double exact = std::round(raw * kPartsOfExponent) / kPartsOfExponent + 0.0;  // no -0
    return std::abs(raw - exact) <= kMovedRounding ? exact : raw;
}

}  // namespace

FirstOrder make_first_order(double value, std::vector<double> exponents, const std::vector<UncertainInput>& inputs) {
    FirstOrder result{.value = value, .relative = 0.0, .exponents = std::move(exponents)};
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        result.relative = std::hypot(result.relative, result.exponents[i] * inputs[i].quantity.relative());
    }
    return result;
}

std::vector<FirstOrder> propagate_first_order(const std::vector<UncertainInput>& inputs, const Evaluation& evaluate) {
    std::vector<double> values;
    values.reserve(inputs.size());
    for (const UncertainInput& input : inputs) values.push_back(input.quantity.value);
    const std::vector<double> results = evaluate(values);
    std::vector<MovedResults> moved;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const auto evaluate_at = [&](double value) {
            std::vector<double> values_there = values;
            values_there[i] = value;
            try {
                return evaluate(values_there);
            } catch (const SimilitudeError& error) {
                throw SimilitudeError(
                    fmt::format("{} is uncertain, and the law admits its value alone ({}); give the value alone, or choose another law",
                                inputs[i].name, error.what()));
            }
        };
        moved.push_back({evaluate_at(values[i] / kMove), evaluate_at(values[i] * kMove)});
    }
    return find_first_order(results, inputs, moved);
}

std::vector<FirstOrder> find_first_order(const std::vector<double>& results, const std::vector<UncertainInput>& inputs,
                                         const std::vector<MovedResults>& moved) {
    std::vector<FirstOrder> propagated;
    for (std::size_t r = 0; r < results.size(); ++r) {
        std::vector<double> exponents;
        exponents.reserve(moved.size());
        for (const MovedResults& results_moved : moved) {
            exponents.push_back(find_moved_exponent(results_moved.below[r], results[r], results_moved.above[r]));
        }
        propagated.push_back(make_first_order(results[r], std::move(exponents), inputs));
    }
    return propagated;
}

CoverageInterval find_interval(const FirstOrder& result) {
    const double spread = std::exp(normal_quantile(0.5 * (1.0 + kCoverage)) * result.relative);
    const auto [lower, upper] = std::minmax({result.value / spread, result.value * spread});
    return {lower, upper};
}

}  // namespace musim::scaling
