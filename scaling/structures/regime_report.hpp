#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scaling/laws/group_meaning.hpp"
#include "scaling/structures/distortion.hpp"
#include "scaling/structures/structure_properties.hpp"

namespace musim::scaling {

/// One dimensionless group of prototype and model.
struct GroupComparison {
    std::string_view name;
    GroupClass kind = GroupClass::geometry;
    std::optional<Direction> direction = {};  ///< of rocking, where it matters
    double prototype = 0.0, model = 0.0;      ///< [-]
    bool is_required = false;                 ///< by the law to be equal
    std::optional<Severity> severity = {};    ///< nothing: kept
    std::string effect = {};                  ///< what changes in the response, one line; empty when kept
    std::vector<std::string> sources = {};    ///< keys of docs/theory/references.md, "derived" where derived

    /// δ = model/prototype; 1 when both are zero, infinite when the prototype alone is.
    double factor() const;
};

/// Responses of prototype and model, where a border between two kinds of response lies.
struct RegimeStatement {
    std::string_view topic;                   ///< "sliding or rocking first", "uplift", "sliding", "first motion", "contacts", "table"
    std::optional<Direction> direction = {};  ///< of rocking, where it matters
    std::optional<Severity> severity = {};    ///< nothing: prototype and model are on one side
    std::string statement = {};               ///< one line
    std::vector<std::string> sources = {};
    bool is_open = false;  ///< a border lies within the uncertainty of the properties (uncertain_regimes.hpp)
};

/// A group that prototype, model or both do not give.
struct UntoldGroup {
    std::string_view name;
    std::string_view missing;  ///< "prototype", "model" or "both"
};

/// Everything that differs between a prototype and its real model, and what that means.
struct RegimeReport {
    std::vector<GroupComparison> groups;   ///< all that both have, distorted or not
    std::vector<RegimeStatement> regimes;  ///< all borders that are known, crossed or not
    std::vector<UntoldGroup> untold;
};

/// Compares groups and regimes by the law of a similitude, its λ_l the chosen one. Severities are those of find_severity(), but
///
///   error    where μ/tan α, a/(g tan α), a/(μ g) or the first motion is on another side of its border in the model, or where the table
///            does not follow the frequency that governs;
///   note     for κ_n and δ_w/σ_H while δ_w/σ_H is below kRigidContact in both, and for C^N while it is itself.
///
/// Report of properties, in which the law requires what the numbers that it keeps ask for. Throws SimilitudeError as check(PairProperties).
RegimeReport make_regime_report(const PairProperties& properties, const Similitude& similitude, const KeptNumbers& kept);

/// Contacts count as rigid while the static overlap at the base is below this share of the height deviation, and while normal contact waves
/// are faster than the motion by its inverse [-]. Why this value: an overlap of a tenth moves the number of carrying contacts by about as
/// much as one block more or less in ten; the papers' wood, concrete and prototype have 8.5e-4, 1.7e-3 and 0.043. Changes labels only.
inline constexpr double kRigidContact = 0.1;

}  // namespace musim::scaling
