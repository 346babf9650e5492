#pragma once

#include <string>
#include <vector>

#include "records/design/design.hpp"
#include "scaling/laws/model_scales.hpp"

/// Share that a model uses of each limit of a design.
namespace musim::records {

/// A limit and how far one model uses it.
struct Use {
    std::string limit;      ///< "displacement of axis x", "hall height", "smallest edge", ...
    std::string unit;       ///< SI unit of the two numbers: "m", "m/s", ..., "-"
    double demand, bound;   ///< what the model asks, what there is [unit]
    bool is_floor = false;  ///< the model must not go below the bound

    /// demand/bound, or bound/demand of a floor; above 1 the limit is broken.
    double used() const { return is_floor ? bound / demand : demand / bound; }
};

/// A design and what its motion asks of the table.
struct Setting {
    Design design;
    std::vector<AxisLoad> loads;  ///< of the prototype
};

/// The limits besides the table's, in a fixed order; those for which something is not given are left out:
///   hall height        λ_H l ≤ h
///   smallest edge      min(λ_b b, λ_b w, λ_H H) ≥ s
///   height deviation   σ_H/(λ_H H) ≤ limit
///   overlap            δ_w/σ_H = ρ g l H/(E_eff σ_H) of the model ≤ limit, since k_n = E_eff A/H and N m = ρ A l
///   camera             n/(λ_t √(l/(μ g))) ≤ pictures a second
/// where λ_H and λ_b, heights and widths, are λ_l but for vertical distortion. Each is a power of the length scale.
std::vector<Use> find_own_uses(const Design& design, const Material& material, const scaling::ModelScales& scales);

/// A table's limits of one axis with the model of a prototype on it, by records::check_axis().
std::vector<LimitUse> find_axis_uses(const Prototype& prototype, const AxisLoad& load, const scaling::ModelScales& scales);

/// The table's limits of all axes, then find_own_uses().
std::vector<Use> find_uses(const Setting& setting, const Material& material, const scaling::ModelScales& scales);

/// A number in one of the units of Use as an engineer would write it: "12 mm", "0.51 g", "3.2 kN m", "2.5 deg/s", four digits.
std::string describe_amount(double value, const std::string& unit);

/// "displacement of axis x".
std::string name_table_limit(TableLimit limit, const std::string& axis);

}  // namespace musim::records
