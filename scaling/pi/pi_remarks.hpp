#pragma once

#include <string>
#include <vector>

#include "scaling/pi/pi_groups.hpp"

namespace musim::scaling {

/// A quantity that is in no group, whatever the repeating ones are.
struct UnusedQuantity {
    std::size_t quantity = 0;  ///< position
    std::string why;           ///< "rho cannot take part: it alone carries mass"
};

/// The quantities that no group of the basis, hence none of any basis, holds. A quantity takes part unless some combination of base
/// dimensions occurs in it alone; the reason names the smallest such combination.
std::vector<UnusedQuantity> explain_unused(const std::vector<PiQuantity>& quantities, const PiBasis& basis);

/// Remarks on what else the dimensions show, one line each: quantities of one dimension (their ratio is a group), plain numbers and angles
/// (groups by themselves), quantities that all groups hold in one combination only.
std::vector<std::string> find_remarks(const std::vector<PiQuantity>& quantities, const PiBasis& basis);

}  // namespace musim::scaling
