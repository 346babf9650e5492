#include "scaling/uncertainty/distribution.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "scaling/detail/portable_math.hpp"
#include "scaling/uncertainty/normal_quantile.hpp"

namespace musim::scaling {

namespace {

constexpr std::array<std::pair<Distribution, std::string_view>, 3> kNames{{
    {Distribution::normal, "normal"},
    {Distribution::lognormal, "lognormal"},
    {Distribution::uniform, "uniform"},
}};

}  // namespace

Distribution parse_distribution(std::string_view name) {
    std::string known;
    for (const auto& [distribution, distribution_name] : kNames) {
        if (distribution_name == name) return distribution;
        known += fmt::format("{}{}", known.empty() ? "" : ", ", distribution_name);
    }
    throw SimilitudeError(fmt::format("uncertainty: there is no distribution \"{}\"; choose one of {}", name, known));
}

std::string_view to_string(Distribution distribution) {
    for (const auto& [known, name] : kNames) {
        if (known == distribution) return name;
    }
    return "unknown";
}

double find_quantile(Distribution distribution, const Uncertain& quantity, double p) {
    switch (distribution) {
        case Distribution::normal:
            return quantity.value + quantity.uncertainty * normal_quantile(p);
        case Distribution::lognormal: {
            const double variance = detail::portable_log1p(quantity.relative() * quantity.relative());
            return quantity.value * detail::portable_exp(std::sqrt(variance) * normal_quantile(p) - 0.5 * variance);
        }
        case Distribution::uniform:
            break;
    }
    return quantity.value + std::numbers::sqrt3 * quantity.uncertainty * (2.0 * p - 1.0);
}

}  // namespace musim::scaling
