#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "records/design/sampled_candidate.hpp"
#include "records/design/uncertain_candidate.hpp"
#include "scaling/text_table.hpp"

namespace musim::cli {

/// What the uncertain values of a design do to its candidates, in their order; no inputs, no candidates where all is certain.
struct DesignUncertainty {
    std::vector<scaling::UncertainInput> inputs;
    std::vector<records::UncertainCandidate> candidates;
    std::optional<records::SampledDesign> samples = {};

    bool is_certain() const { return inputs.empty(); }

    /// Of one candidate; null where all is certain.
    const records::UncertainCandidate* find(std::size_t candidate) const { return is_certain() ? nullptr : &candidates[candidate]; }
};

/// The ends of all feasible ranges that a limit sets: what binds, u, the coverage interval, and the input that matters most.
scaling::TextTable make_ends_table(const std::vector<records::Candidate>& candidates, const DesignUncertainty& uncertainty);

/// By samples: in how many each candidate is feasible, and the ends of its length scales then.
scaling::TextTable make_sampled_ends_table(const std::vector<records::Candidate>& candidates, const records::SampledDesign& samples);

/// By samples: which limits are governing, or broken at the given length. Limits that never are have no row.
scaling::TextTable make_sampled_limits_table(const std::vector<records::Candidate>& candidates, const records::SampledDesign& samples);

/// {"feasible_share", "smallest" and "largest" of the samples that are (null when none is), "length" at which limits are reported broken,
/// "limits": [{"limit", "sets_smallest_share", "sets_largest_share", "broken_share"}]}.
nlohmann::json to_json(const records::Candidate& candidate, const records::SampledCandidate& sampled);

/// Coverage intervals of the ends of a limit's ranges: "1/149.8 to 1/143.1 ... -"; "-" where all are certain.
std::string describe_ends(const std::vector<records::UncertainRange>& ranges);

/// A column of coverage intervals behind the last one, a row each.
void add_intervals(scaling::TextTable& table, const std::vector<scaling::FirstOrder>& results);

/// {"smallest", "largest"}; null for an end that no limit sets.
nlohmann::json to_json(const records::UncertainRange& range, const std::vector<scaling::UncertainInput>& inputs);

/// {"groups" and "factors" by name, "used" in the order of the limits, "mass_kg", "cost"}.
nlohmann::json to_json(const records::ModelState& state, const records::UncertainState& uncertain,
                       const std::vector<scaling::UncertainInput>& inputs);

}  // namespace musim::cli
