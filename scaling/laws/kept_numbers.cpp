#include "scaling/laws/kept_numbers.hpp"

#include <algorithm>
#include <string>

namespace musim::scaling {
namespace {

bool has_quantity(const SolvedLaw& solved, std::string_view name) {
    const std::vector<PiQuantity>& quantities = solved.problem.quantities;
    return std::any_of(quantities.begin(), quantities.end(), [&](const PiQuantity& each) { return each.name == name; });
}

bool is_kept(const SolvedLaw& solved, const std::string& number, const std::vector<std::string>& quantities) {
    if (!std::all_of(quantities.begin(), quantities.end(), [&](const std::string& name) { return has_quantity(solved, name); })) {
        return false;
    }
    ScaleProblem problem = solved.problem;
    problem.watched = {parse_scale_product(number, problem.quantities)};
    const std::vector<Rational> exponents = solve_scales(problem).watched.front().exponents;
    return std::all_of(exponents.begin(), exponents.end(), [](const Rational& exponent) { return exponent == 0; });
}

}  // namespace

KeptNumbers find_kept_numbers(const SolvedLaw& solved) {
    // squares of the numbers, with the acceleration l/t² that such a law has in one form or the other
    const bool by_time = has_quantity(solved, "t");
    const std::string acceleration = by_time ? "l/t^2" : "a";
    std::vector<std::string> moving{by_time ? "t" : "a"};
    const auto with = [&](std::initializer_list<const char*> more) {
        std::vector<std::string> names = moving;
        names.insert(names.end(), more.begin(), more.end());
        return names;
    };
    return {.mu = is_kept(solved, acceleration + "/(mu*g)", with({"mu", "g", "l"})),
            .froude = is_kept(solved, acceleration + "/g", with({"g", "l"})),
            .cauchy = is_kept(solved, acceleration + "*rho*l/E", with({"rho", "E", "l"}))};
}

}  // namespace musim::scaling
