#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

namespace musim::scaling::tests {

/// A reference value and how far a correct result may be from it.
struct Expected {
    double value = 0.0;
    double tolerance = 0.0;

    /// Exact reference: a relative 1e-14 allows for the some forty roundings of a product of powers and its own.
    Expected(double exact) : value(exact), tolerance(1e-14 * std::abs(exact)) {}

    /// Printed reference: half a unit in its last printed digit (and 1e-6 of it, for ties).
    Expected(const char* printed) : value(std::strtod(printed, nullptr)) {
        const std::string text = printed;
        const std::size_t mark = text.find('e');
        const std::size_t point = text.find('.');
        const int exponent = mark == std::string::npos ? 0 : std::atoi(text.c_str() + mark + 1);
        const int decimals = point == std::string::npos ? 0 : static_cast<int>(std::min(mark, text.size()) - point) - 1;
        tolerance = 0.5000005 * std::pow(10.0, exponent - decimals);
    }

    bool agrees_with(double result) const { return std::abs(result - value) <= tolerance; }
};

}  // namespace musim::scaling::tests

/// Checks a result against an Expected and prints both when they differ.
#define CHECK_EXPECTED(result, expected)                                       \
    do {                                                                       \
        const double checked_result = (result);                                \
        const musim::scaling::tests::Expected checked_reference = (expected);  \
        CAPTURE(checked_result);                                               \
        CAPTURE(checked_reference.value);                                      \
        CHECK_MESSAGE(checked_reference.agrees_with(checked_result), #result); \
    } while (false)
