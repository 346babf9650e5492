#pragma once

#include <optional>
#include <vector>

#include "records/design/candidate.hpp"
#include "scaling/uncertainty/propagate.hpp"

/// Effects of uncertain values of a design on its answer, to first order.
namespace musim::records {

/// A design with one of its uncertain values moved (scaling::read_moved).
struct MovedSetting {
    Setting below, above;
};

/// A range of length scales: its ends, where a limit sets them; none at the end of the search.
struct UncertainRange {
    std::optional<scaling::FirstOrder> smallest, largest;
};

/// The numbers of a ModelState, in its order. Its length is what one builds by: certain.
struct UncertainState {
    std::vector<scaling::FirstOrder> groups;  ///< δ
    std::vector<scaling::FirstOrder> used;    ///< shares of the limits
    std::vector<scaling::FirstOrder> scales;  ///< of scaling::kModelScales
    scaling::FirstOrder mass;                 ///< [kg]
    std::optional<scaling::FirstOrder> cost;
};

/// The uncertain side of a Candidate, whose members have the same names and order.
struct UncertainCandidate {
    std::vector<std::vector<UncertainRange>> limits;
    std::vector<UncertainRange> ranges;
    std::vector<UncertainState> ends;
    std::optional<UncertainState> chosen, ranked;
};

/// Propagates the uncertainties of a design's values.
///
/// An end of a limit's range is where the limit is used just up, u(λ_l; x) = 1, so that ∂ln λ_l/∂ln x_i = −(∂ln u/∂ln x_i)/(∂ln u/∂ln λ_l);
/// an end of a feasible range is that of the limit that binds it by the values, as Candidate has it. Both slopes are central differences of
/// the share itself: no search, and an end beyond the search has its slope, too. Everything reported of a model is at the given length.
/// `moved` has one entry for each input. Throws SimilitudeError `MATERIAL by law LAW: INPUT is uncertain, and ... ; what to do` where a law
/// admits the values alone, such as `exact`, whose friction factor must be 1.
std::vector<UncertainCandidate> propagate(const Setting& setting, const std::vector<Candidate>& candidates,
                                          const std::vector<scaling::UncertainInput>& inputs, const std::vector<MovedSetting>& moved);

}  // namespace musim::records
