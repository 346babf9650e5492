#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "records/design/models.hpp"
#include "records/design/uses.hpp"
#include "scaling/laws/length_range.hpp"
#include "scaling/structures/distortion.hpp"

/// Candidate: scales that are possible in one material by one law.
namespace musim::records {

/// The length scales that are looked at.
inline constexpr scaling::LengthRange kSearch{kSmallestScale, 1.0};

/// Names of the groups that a ranking weighs unless a design says otherwise: one of each kind, see docs/theory/design.md.
std::vector<std::string> default_groups();

/// Every group that scaling::group_factors() knows.
std::vector<std::string> known_groups();

/// δ of a group; the name is its own, as a law names products itself.
struct GroupFactor {
    std::string name;
    double value = 1.0;
};

/// A model of one length scale.
struct ModelState {
    double length = 1.0;  ///< λ_l
    scaling::ModelScales scales = {};
    std::vector<Use> uses = {};
    std::vector<GroupFactor> groups;  ///< every group that is known, then of the law's own products
    std::vector<scaling::Distortion> distortions;
    double measure = 0.0;             ///< Σ |ln δ| over the groups that the design weighs
    scaling::Mass mass{};             ///< with what a law adds
    scaling::Mass added_mass{};       ///< of that: not made of the material
    std::optional<double> cost = {};  ///< mass of the material times price

    bool changes_regime() const;  ///< slides where the prototype rocks, or the reverse
};

/// A model of one length. Throws SimilitudeError as Models::at() and its constructor do.
ModelState find_state(const Setting& setting, const Models& models, double length);
ModelState find_state(const Setting& setting, const Material& material, const DesignLaw& law, double length);

/// The length scales that one limit leaves.
struct LimitRanges {
    std::string limit;
    std::vector<scaling::LengthRange> ranges;
};

/// Ranges of each limit by itself: the table's by records::find_limit_scales(), others by scaling::find_length_range(); from
/// records::kSmallestScale to 1.
std::vector<LimitRanges> find_limit_ranges(const Setting& setting, const Models& models);

/// Length scales at which all limits hold.
struct FeasibleRange {
    scaling::LengthRange scales;
    std::string binds_below, binds_above;  ///< the governing limit beyond; empty: the end of the search
};

/// Ranges that all limits leave, by rising λ_l.
std::vector<FeasibleRange> find_common(const std::vector<LimitRanges>& limits);

/// Two limits that exclude each other.
struct Conflict {
    std::string upper, lower;              ///< allows up to; asks for at least
    double at_most = 0.0, at_least = 0.0;  ///< λ_l, at_most < at_least
};

/// The two that are farthest apart, by at_least/at_most; none when every two agree somewhere.
std::optional<Conflict> find_conflict(const std::vector<LimitRanges>& limits);

/// One material by one law.
struct Candidate {
    Material material;
    DesignLaw law;
    std::vector<LimitRanges> limits;
    std::vector<FeasibleRange> ranges;
    std::optional<Conflict> conflict = {};  ///< when nothing is feasible and a pair is to blame
    std::string problem = {};               ///< why nothing is feasible, and what would help; empty when something is
    std::vector<ModelState> ends = {};      ///< at both ends of each range
    std::optional<ModelState> chosen = {};  ///< at the design's length, feasible or not
    std::optional<ModelState> ranked = {};  ///< at the length that its rank is about

    bool is_feasible() const { return !ranges.empty(); }
    bool changes_regime() const { return ranked && ranked->changes_regime(); }
};

/// All of it. A law that does not admit the material (`exact` with another friction) makes it infeasible.
Candidate find_candidate(const Setting& setting, const Material& material, const DesignLaw& law);

/// Every material by every law, the best first: feasible ones by rising measure, then those that are feasible but change the regime, by the
/// same, then the infeasible; equal ones (to seven digits) as the design lists them.
std::vector<Candidate> find_candidates(const Setting& setting);

}  // namespace musim::records

namespace musim::records::detail {

/// Where a candidate's material and law stand in the design: the same places in the design read again, which may have other values there.
struct Place {
    std::size_t material = 0, law = 0;

    /// Throws std::out_of_range for a candidate of another design.
    Place(const Design& design, const Candidate& candidate) {
        while (design.materials.at(material).name != candidate.material.name) ++material;
        while (!(design.laws.at(law) == candidate.law)) ++law;
    }
};

}  // namespace musim::records::detail
