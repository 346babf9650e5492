#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "records/design/sampled_candidate.hpp"
#include "records/design/uncertain_candidate.hpp"
#include "scaling/text_table.hpp"

namespace musim::cli {

/// Effects of the uncertain values of a design on its candidates, in their order; no inputs, no candidates where all is certain.
struct DesignUncertainty {
    std::vector<scaling::UncertainInput> inputs;
    std::vector<records::UncertainCandidate> candidates;
    std::optional<records::SampledDesign> samples = {};

    bool is_certain() const { return inputs.empty(); }

    /// Effects on one candidate; null where all is certain.
    const records::UncertainCandidate* find(std::size_t candidate) const { return is_certain() ? nullptr : &candidates[candidate]; }
};

/// The ranking, what conflicts where nothing is feasible, and for each candidate the limits used and the groups distorted at the ends and
/// at the length in mind; with uncertain inputs, these and coverage intervals, too, and what samples say of
/// ends and limits if they were drawn.
std::string make_design_report(const records::Design& design, const std::vector<records::Candidate>& candidates,
                               const DesignUncertainty& uncertainty, scaling::ReportStyle style);

/// The same as JSON, in SI units; "uncertainty" of the whole, of candidates, ranges and states only where something is uncertain;
/// "monte_carlo" of candidates where samples were drawn.
nlohmann::json to_json(const records::Design& design, const std::vector<records::Candidate>& candidates,
                       const DesignUncertainty& uncertainty);

}  // namespace musim::cli
