#pragma once

#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "scaling/pi_quantity.hpp"
#include "scaling/uncertainty/monte_carlo.hpp"
#include "scaling/uncertainty/propagate.hpp"

/// Uncertainties of the values of dimensionless groups, from those of a problem's quantities.
namespace musim::scaling {

/// The uncertain quantities of a problem, in its order.
std::vector<UncertainInput> list_uncertain(const std::vector<PiQuantity>& quantities);

/// A group's value with its uncertainty to first order. Its own exponents n_i are those of its product of powers, so that the closed form
/// (u/Π)² = Σ (n_i u_i/x_i)² is exact to that order [JCGM100] 5.1.6. FirstOrder::exponents are of list_uncertain(). None where
/// group_value() is.
std::optional<FirstOrder> find_uncertain_value(const PiGroup& group, const std::vector<PiQuantity>& quantities);

/// Groups by samples of a problem's quantities.
struct SampledGroups {
    std::map<PiGroup, SampleSummary> groups;  ///< those that have a value
    std::optional<Draws> draws;               ///< none without samples
};

/// Draws the uncertain quantities of a problem, each one value for all groups. Throws as run_monte_carlo().
SampledGroups draw_groups(const std::vector<PiGroup>& groups, const std::vector<PiQuantity>& quantities, const MonteCarloSettings& settings,
                          const std::function<void(double)>& on_progress = {});

}  // namespace musim::scaling
