#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "records/design/candidate.hpp"
#include "scaling/uncertainty/monte_carlo.hpp"

/// Effects of uncertain values of a design on its answer, by samples of them.
namespace musim::records {

/// In which share of the samples a limit does what.
struct SampledLimit {
    double sets_smallest = 0.0, sets_largest = 0.0;  ///< it is what governs a smaller, a larger model
    std::optional<double> broken = {};               ///< at the length given; none without one
};

/// One material by one law. Of several ranges of length scales the outermost ends count.
struct SampledCandidate {
    std::optional<double> length;              ///< λ_l at which limits are reported broken: the design's, else the one that is ranked
    double feasible = 0.0;                     ///< share of samples in which some length scale suits all limits
    scaling::SampleSummary smallest, largest;  ///< λ_l of the samples that are feasible
    std::vector<SampledLimit> limits;          ///< in the order of Candidate::limits
};

/// Samples of all candidates.
struct SampledDesign {
    std::vector<SampledCandidate> candidates;
    scaling::Draws draws;
};

/// The design with drawn values of its inputs, in their order. Called from any thread.
using DrawSetting = std::function<Setting(std::span<const double>)>;

/// Draws the uncertain values of a design and looks each time which length scales are feasible, and what governs others: no slope
/// is taken, so that another limit may bind and a candidate may become infeasible. A candidate whose law does not admit the material by
/// value is feasible in no sample. Throws as scaling::run_monte_carlo(), find_limit_ranges(), and what `draw` throws.
SampledDesign draw_candidates(const Setting& setting, const std::vector<Candidate>& candidates,
                              const std::vector<scaling::UncertainInput>& inputs, const DrawSetting& draw,
                              const scaling::MonteCarloSettings& settings, const std::function<void(double)>& on_progress = {});

}  // namespace musim::records
