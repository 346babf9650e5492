#include "records/design/sampled_candidate.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "records/design/candidate.hpp"

namespace musim::records {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// The length at which limits are reported broken.
std::optional<double> find_told_length(const Candidate& candidate) {
    if (candidate.chosen) return candidate.chosen->length;
    return candidate.ranked ? std::optional(candidate.ranked->length) : std::nullopt;
}

double is_broken(const std::vector<scaling::LengthRange>& ranges, double length) {
    const auto holds = [&](const scaling::LengthRange& range) { return range.smallest <= length && length <= range.largest; };
    return std::none_of(ranges.begin(), ranges.end(), holds) ? 1.0 : 0.0;
}

/// Whether a limit governs beyond an end; of a sample that is not feasible nothing is.
double binds(const std::vector<FeasibleRange>& ranges, const std::string& end, const std::string& limit) {
    return !ranges.empty() && end == limit ? 1.0 : 0.0;
}

/// A candidate that is drawn: feasible or not, both ends, and three answers for each limit.
class Drawn {
  public:
    Drawn(const Setting& setting, const Candidate& candidate)
        : candidate_(candidate), place_(setting.design, candidate), length_(find_told_length(candidate)) {
        if (!candidate.limits.empty()) formulas_ = Models(setting.design, candidate.material, candidate.law).formulas();
    }

    void add_numbers(std::vector<double>& numbers, const Setting& drawn) const {
        if (!formulas_) {
            numbers.insert(numbers.end(), {candidate_.is_feasible() ? 1.0 : 0.0, kNone, kNone});
            return;
        }
        const Models models(drawn.design, drawn.design.materials[place_.material], drawn.design.laws[place_.law], *formulas_);
        const std::vector<LimitRanges> limits = find_limit_ranges(drawn, models);
        const std::vector<FeasibleRange> ranges = find_common(limits);
        const std::string below = ranges.empty() ? "" : ranges.front().binds_below, above = ranges.empty() ? "" : ranges.back().binds_above;
        numbers.push_back(ranges.empty() ? 0.0 : 1.0);
        numbers.push_back(ranges.empty() ? kNone : ranges.front().scales.smallest);
        numbers.push_back(ranges.empty() ? kNone : ranges.back().scales.largest);
        for (std::size_t i = 0; i < candidate_.limits.size(); ++i) {
            const std::string& limit = candidate_.limits[i].limit;
            numbers.push_back(binds(ranges, below, limit));
            numbers.push_back(binds(ranges, above, limit));
            numbers.push_back(length_ ? is_broken(limits[i].ranges, *length_) : kNone);
        }
    }

    SampledCandidate take(std::vector<scaling::SampleSummary>::const_iterator& next) const {
        SampledCandidate sampled{.length = length_, .feasible = find_share(*next++), .smallest = {}, .largest = {}, .limits = {}};
        sampled.smallest = *next++;
        sampled.largest = *next++;
        for (std::size_t i = 0; i < candidate_.limits.size(); ++i) {
            SampledLimit& limit = sampled.limits.emplace_back();
            limit.sets_smallest = find_share(*next++);
            limit.sets_largest = find_share(*next++);
            if (length_) limit.broken = find_share(*next);
            ++next;
        }
        return sampled;
    }

  private:
    const Candidate& candidate_;
    detail::Place place_;
    std::optional<double> length_;
    std::optional<scaling::LawFormulas> formulas_;  ///< none where the material and the law contradict each other
};

}  // namespace

SampledDesign draw_candidates(const Setting& setting, const std::vector<Candidate>& candidates,
                              const std::vector<scaling::UncertainInput>& inputs, const DrawSetting& draw,
                              const scaling::MonteCarloSettings& settings, const std::function<void(double)>& on_progress) {
    std::vector<Drawn> all;
    all.reserve(candidates.size());
    for (const Candidate& candidate : candidates) all.emplace_back(setting, candidate);
    const scaling::Evaluation evaluate = [&](std::span<const double> values) {
        const Setting drawn = draw(values);
        std::vector<double> numbers;
        for (const Drawn& each : all) each.add_numbers(numbers, drawn);
        return numbers;
    };
    const scaling::MonteCarloRun run = run_monte_carlo(inputs, evaluate, settings, on_progress);
    SampledDesign sampled{{}, run.draws};
    auto next = run.results.begin();
    for (const Drawn& each : all) sampled.candidates.push_back(each.take(next));
    return sampled;
}

}  // namespace musim::records
