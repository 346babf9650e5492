#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scaling/pi_quantity.hpp"

namespace musim::scaling {

/// Repeating quantities and the groups that come of them [Buckingham14]: n quantities of rank r make n - r.
///
/// Each other quantity is divided by the product of repeating ones that has its dimension, and the result raised to the least power that
/// leaves whole exponents. Hence gcd 1, and a positive exponent on the only quantity of a group that does not repeat.
struct PiBasis {
    std::vector<std::size_t> repeating;  ///< positions; as many as the rank
    std::vector<PiGroup> groups;         ///< one per quantity that does not repeat, in the order of the problem

    std::size_t rank() const { return repeating.size(); }
};

/// Groups of a problem over the named repeating quantities, or over the first independent ones in the order of the problem: a quantity
/// repeats when the repeating ones before it cannot make up its dimension. What belongs to every choice, because it cannot take part, need
/// not be named.
/// Throws PiError: check_quantities(), a name that is unknown or there twice, a repeating quantity that is dimensionless or made up of
/// others (says which), too few (says what is missing and who could join); exponents beyond 64 bits.
PiBasis find_pi_basis(const std::vector<PiQuantity>& quantities, const std::vector<std::string>& repeating = {});

/// Every choice of repeating quantities that leads to other groups.
struct PiBases {
    std::vector<PiBasis> bases;  ///< the first choice of each set of groups, lexicographically in the order of the problem
    bool complete = true;        ///< false: there are more, or more than kMostRepeatingSets were looked at
};

/// Choices of repeating quantities looked at [-]: 40 quantities of rank 7 have up to 18 million. There each takes 0.4 ms, all 8 s; problems
/// of up to 14 quantities and rank 7 (3432 choices) are not touched.
inline constexpr std::size_t kMostRepeatingSets = 20000;

/// Groups of every choice of repeating quantities, sets that are equal up to order and inverse once, at most `limit`. Throws as
/// find_pi_basis().
PiBases find_all_pi_bases(const std::vector<PiQuantity>& quantities, std::size_t limit);

}  // namespace musim::scaling
