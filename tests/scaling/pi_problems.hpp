#pragma once

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "scaling/pi/pi_groups.hpp"
#include "scaling/pi/pi_text.hpp"

namespace musim::scaling::tests {

/// Quantities from names and units.
inline std::vector<PiQuantity> make_problem(std::initializer_list<std::pair<const char*, const char*>> names_and_units) {
    std::vector<PiQuantity> quantities;
    for (const auto& [name, unit] : names_and_units) quantities.push_back(make_pi_quantity(name, unit));
    return quantities;
}

/// The groups as text: {"l*a/v^2", ...}.
inline std::vector<std::string> group_texts(const PiBasis& basis, const std::vector<PiQuantity>& quantities) {
    std::vector<std::string> texts;
    for (const PiGroup& group : basis.groups) texts.push_back(format_group(group, quantities));
    return texts;
}

/// Groups of a problem as text.
inline std::vector<std::string> groups_of(const std::vector<PiQuantity>& quantities, const std::vector<std::string>& repeating = {}) {
    return group_texts(find_pi_basis(quantities, repeating), quantities);
}

/// Message of the PiError that an action throws; empty when it throws none.
template <class Action>
std::string pi_error(const Action& action) {
    try {
        action();
    } catch (const PiError& error) {
        return error.what();
    }
    return "";
}

using Texts = std::vector<std::string>;

}  // namespace musim::scaling::tests
