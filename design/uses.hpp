#pragma once

#include <string>
#include <vector>

#include "design/design.hpp"

/// How far a model uses each limit of a design.
namespace musim::design {

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
    std::vector<records::AxisLoad> loads;  ///< of the prototype
};

/// Chosen factors of a model of some material: λ_ρ and λ_μ are the material's over the prototype's.
scaling::ScaleFactors make_factors(const Design& design, const Material& material, double length);

/// The prototype as payload.
records::Payload make_payload(const Prototype& prototype);

/// The limits besides the table's, in a fixed order; those for which something is not given are left out:
///   hall height        λ_l l ≤ h
///   smallest edge      λ_l min(b, w, H) ≥ s
///   height deviation   σ_H/(λ_l H) ≤ limit
///   overlap            δ_w/σ_H = ρ g l H/(E_eff σ_H) of the model ≤ limit, since k_n = E_eff A/H and N m = ρ A l
///   camera             n/(λ_t √(l/(μ g))) ≤ pictures a second
/// Each is a power of λ_l.
std::vector<Use> find_own_uses(const Design& design, const Material& material, const scaling::Similitude& similitude);

/// The table's limits by records::check_axis(), then find_own_uses().
std::vector<Use> find_uses(const Setting& setting, const Material& material, const scaling::Similitude& similitude);

/// A number in an SI unit as an engineer would write it: "12 mm", "0.51 g", "3.2 kN m", four digits.
std::string describe_amount(double value, const std::string& unit);

/// "displacement of axis x".
std::string name_table_limit(records::TableLimit limit, const std::string& axis);

}  // namespace musim::design
