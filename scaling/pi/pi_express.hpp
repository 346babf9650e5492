#pragma once

#include <string_view>
#include <vector>

#include "scaling/pi/pi_groups.hpp"

namespace musim::scaling {

/// Exponents of a product written as text: "v^2/(g*l)", "v/sqrt(mu g l)", "E^(1/3)". Factors are names of quantities, 1, brackets and
/// sqrt(...), joined by `*`, blank and `/` (which takes the next factor only); powers are whole, decimal or fractions in brackets.
/// Throws PiError for anything else; an unknown name comes with the nearest.
std::vector<Rational> parse_group(std::string_view text, const std::vector<PiQuantity>& quantities);

/// Powers c of groups whose product is the wanted one: Π groups[i]^c[i] = Π quantities^wanted. Unique, as groups are independent.
/// Throws PiError when `wanted` is not dimensionless (says in what it is) or not a product of the groups.
std::vector<Rational> express(const std::vector<Rational>& wanted, const std::vector<PiGroup>& groups,
                              const std::vector<PiQuantity>& quantities);

}  // namespace musim::scaling
