#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "scaling/structures/regime_report.hpp"
#include "scaling/uncertainty/uncertain_result.hpp"

namespace musim::scaling {

/// Properties, the motion of the model with them, and the similitude that they ask for.
struct PropertiesAndLaw {
    PairProperties properties;
    Similitude similitude;
};

/// The same with one uncertain value of the properties moved (read_moved). A motion of the model that was not given is the prototype's,
/// moved, by the similitude of the values: a test is shaken with them.
struct MovedProperties {
    PropertiesAndLaw below, above;
};

/// The properties of drawn values of the inputs, with the motion of the model as MovedProperties have it. Called from any thread.
using DrawProperties = std::function<PropertiesAndLaw(std::span<const double>)>;

/// Samples of a group of a report.
struct ComparisonSamples {
    SampleSummary prototype, model, factor;
};

/// A group of a report.
struct UncertainComparison {
    FirstOrder prototype, model;
    FirstOrder factor;  ///< δ
    std::optional<ComparisonSamples> samples = {};
};

/// Samples of properties as a whole.
struct RegimeSamples {
    /// Share of samples, for each regime of the report, in which prototype or model is on another side of a border than by the values.
    /// Borders that do not matter to a sample (sliding or rocking of what rests) count as a side of their own.
    std::vector<double> shares_elsewhere;
    Draws draws;
};

/// Effects of uncertain properties on a report.
struct UncertainRegimes {
    std::vector<UncertainInput> inputs;
    std::vector<UncertainResult> factors;     ///< of Similitude::factors(), by the true values: what to aim at
    std::vector<UncertainComparison> groups;  ///< in the order of the report's, of the test as it is shaken

    std::optional<RegimeSamples> samples = {};

    bool is_certain() const { return inputs.empty(); }
};

/// Propagates uncertain properties to a report of them, to first order. Where a border of a regime lies in a coverage interval
/// (find_interval) the report's statement says so, `is_open`, and a regime that is the same by the values becomes a warning: μ/tan α, a/(g
/// tan α) and a/(μ g) at 1, δ_w/σ_H at kRigidContact, what a block needs to start as it does, frequencies at the ends of the table's band.
/// `moved` has one entry for each input. Throws SimilitudeError as make_regime_report().
UncertainRegimes propagate(RegimeReport& report, const PropertiesAndLaw& properties, const KeptNumbers& kept,
                           const std::vector<UncertainInput>& inputs, const std::vector<MovedProperties>& moved);

/// Adds to uncertain properties what samples of their inputs say: of factors, of groups, and of the regimes of `report`. `report`,
/// `properties` and `kept` as propagate() has them. Throws as run_monte_carlo(), and what `draw` throws.
void add_samples(UncertainRegimes& uncertain, const RegimeReport& report, const PropertiesAndLaw& properties, const KeptNumbers& kept,
                 const DrawProperties& draw, const MonteCarloSettings& settings, const std::function<void(double)>& on_progress = {});

}  // namespace musim::scaling
