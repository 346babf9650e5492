#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "scaling/laws/scale_law.hpp"

namespace musim::scaling {

/// Which of the numbers that decide what a law requires are the same in every model by it, whatever its factors.
struct KeptNumbers {
    bool mu = false;      ///< v/√(μ g l)
    bool froude = false;  ///< v/√(g l)
    bool cauchy = false;  ///< v/√(E/ρ)
};

/// Those of a law, which speaks of l, of t or a, and of mu, g, rho, E as far as it has them: a number is kept where its δ is a
/// product of no chosen factor at all. A law that has not the quantities of a number does not keep it.
KeptNumbers find_kept_numbers(const SolvedLaw& solved);

/// Subject of a dimensionless group of a block structure.
enum class GroupClass { geometry, friction, contact, rocking, loading };

/// "geometry", "friction", "contact", "rocking" or "loading".
std::string_view to_string(GroupClass kind);

/// The laws that ask for a group to be equal; `exact` asks for all of them.
struct RequiringLaws {
    bool mu = false;      ///< sliding of rigid blocks under assumptions A1 to A5
    bool froude = false;  ///< rigid blocks that slide, rock and fall under their weight
    bool cauchy = false;  ///< elastic blocks in contact, weight neglected
};

/// A group of similitude: where it belongs, who requires it, and what it does to the response.
struct GroupMeaning {
    std::string_view name;  ///< "mu/tan(alpha)"
    GroupClass kind = GroupClass::geometry;
    RequiringLaws laws = {};
    std::string_view if_larger;                    ///< what changes in the model when its group is larger than the prototype's
    std::string_view if_smaller;                   ///< when it is smaller
    std::array<std::string_view, 2> sources = {};  ///< keys of docs/theory/references.md, or "derived" (docs/theory); the rest is empty

    /// By a law that keeps these numbers: whatever one of them asks for, all of it where a law keeps weight and elasticity at once, and
    /// what every law asks for.
    bool is_required_by(const KeptNumbers& kept) const;
    std::string_view effect(double factor) const { return factor > 1.0 ? if_larger : if_smaller; }
    std::vector<std::string> list_sources() const;
};

/// The meaning of the group called `name`. Throws std::out_of_range for a name that there is not, our own mistake.
const GroupMeaning& find_group_meaning(std::string_view name);

}  // namespace musim::scaling
