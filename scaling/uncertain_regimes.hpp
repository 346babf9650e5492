#pragma once

#include <vector>

#include "scaling/regime_report.hpp"
#include "scaling/uncertain_result.hpp"

namespace musim::scaling {

/// Facts, the motion of the model with them, and the similitude that they ask for.
struct FactsAndLaw {
    PairFacts facts;
    Similitude similitude;
};

/// The same with one uncertain value of the facts moved (read_moved). A motion of the model that was not told is the prototype's, moved, by
/// the similitude of the values: a test is shaken with them.
struct MovedFacts {
    FactsAndLaw below, above;
};

/// A group of a report.
struct UncertainComparison {
    FirstOrder prototype, model;
    FirstOrder factor;  ///< δ
};

/// What uncertain facts do to a report.
struct UncertainRegimes {
    std::vector<UncertainInput> inputs;
    std::vector<UncertainResult> factors;     ///< of Similitude::factors(), by the true values: what to aim at
    std::vector<UncertainComparison> groups;  ///< in the order of the report's, of the test as it is shaken

    bool is_certain() const { return inputs.empty(); }
};

/// Propagates uncertain facts to a report of them, to first order. Where a border of a regime lies in a coverage interval (coverage.hpp)
/// the report's statement says so, `is_open`, and a regime that is the same by the values becomes a warning: μ/tan α, a/(g tan α) and a/(μ
/// g) at 1, δ_w/σ_H at kRigidContact, what a block needs to start as it does, frequencies at the ends of the table's band. `moved` has one
/// entry for each input. Throws SimilitudeError as make_regime_report().
UncertainRegimes propagate(RegimeReport& report, const FactsAndLaw& facts, const KeptNumbers& kept,
                           const std::vector<UncertainInput>& inputs, const std::vector<MovedFacts>& moved);

}  // namespace musim::scaling
