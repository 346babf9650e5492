#include "scaling/propagate.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace musim::scaling {

namespace {

/// Exponents are whole multiples of 1/kPartsOfExponent [-]: halves and quarters of roots, thirds of volumes.
constexpr double kPartsOfExponent = 12.0;

/// How far rounding may move an exponent [-]: logarithms of some twenty products and roots of doubles, 1e-16 each.
constexpr double kExponentRounding = 1e-12;

/// log2(larger/smaller) if that is an exponent up to rounding; else not a number.
double find_exponent(double larger, double smaller) {
    const double raw = std::log2(larger / smaller);
    const double exact = std::round(raw * kPartsOfExponent) / kPartsOfExponent;
    return std::abs(raw - exact) <= kExponentRounding ? exact : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::vector<FirstOrder> propagate_first_order(const std::vector<UncertainInput>& inputs, const Evaluation& evaluate) {
    std::vector<double> values;
    for (const UncertainInput& input : inputs) values.push_back(input.quantity.value);
    std::vector<FirstOrder> results;
    for (const double value : evaluate(values)) results.push_back({.value = value});

    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const double value = values[i];
        values[i] = 2.0 * value;
        const std::vector<double> doubled = evaluate(values);
        values[i] = 0.5 * value;
        const std::vector<double> halved = evaluate(values);
        values[i] = value;
        for (std::size_t r = 0; r < results.size(); ++r) {
            const double exponent = find_exponent(doubled[r], results[r].value);
            if (exponent != find_exponent(results[r].value, halved[r])) {
                throw std::logic_error(fmt::format("propagate: result {} is no product of powers of {}", r, inputs[i].name));
            }
            results[r].exponents.push_back(exponent);
            results[r].relative = std::hypot(results[r].relative, exponent * inputs[i].quantity.relative());
        }
    }
    return results;
}

}  // namespace musim::scaling
