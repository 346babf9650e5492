#include "records/design/uncertain_candidate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "records/design/candidate.hpp"

namespace musim::records {
namespace {

using scaling::FirstOrder;
using scaling::MovedResults;
using scaling::UncertainInput;

/// The models of one candidate in one setting, which outlives this.
struct Case {
    const Setting& setting;
    Models models;

    ModelState state(double length) const { return find_state(setting, models, length); }

    /// Share of a limit that a model of one length uses.
    double used(const std::string& limit, double length) const {
        const std::vector<Use> uses = find_uses(setting, models.material(), models.at(length));
        const auto named = std::find_if(uses.begin(), uses.end(), [&](const Use& use) { return use.limit == limit; });
        return named->used();
    }
};

Case find_case(const Setting& setting, const detail::Place& place) {
    return {setting, Models(setting.design, setting.design.materials[place.material], setting.design.laws[place.law])};
}

/// All numbers of a state in one row, and the way back.
std::vector<double> list_numbers(const ModelState& state) {
    std::vector<double> numbers;
    for (const GroupFactor& group : state.groups) numbers.push_back(group.value);
    for (const Use& use : state.uses) numbers.push_back(use.used());
    for (const scaling::ModelScale& scale : scaling::kModelScales) numbers.push_back(state.scales.*scale.factor);
    numbers.push_back(state.mass.value());
    if (state.cost) numbers.push_back(*state.cost);
    return numbers;
}

UncertainState take_numbers(const ModelState& state, const std::vector<FirstOrder>& numbers) {
    UncertainState uncertain;
    auto next = numbers.begin();
    const auto take = [&next](std::vector<FirstOrder>& list, std::size_t count) {
        list.assign(next, next + static_cast<std::ptrdiff_t>(count));
        next += static_cast<std::ptrdiff_t>(count);
    };
    take(uncertain.groups, state.groups.size());
    take(uncertain.used, state.uses.size());
    take(uncertain.scales, std::size(scaling::kModelScales));
    uncertain.mass = *next++;
    if (state.cost) uncertain.cost = *next;
    return uncertain;
}

/// One candidate with every input moved.
class MovedCases {
  public:
    MovedCases(const Setting& setting, const Candidate& candidate, const std::vector<UncertainInput>& inputs,
               const std::vector<MovedSetting>& moved)
        : inputs_(inputs), own_(find_case(setting, detail::Place(setting.design, candidate))) {
        const detail::Place place(setting.design, candidate);
        for (std::size_t i = 0; i < moved.size(); ++i) {
            try {
                below_.push_back(find_case(moved[i].below, place));
                above_.push_back(find_case(moved[i].above, place));
            } catch (const scaling::SimilitudeError& error) {
                throw scaling::SimilitudeError(fmt::format(
                    "{} by law {}: {} is uncertain, and the law admits its value alone ({}); give the value alone, or leave out "
                    "the law or the material",
                    candidate.material.name, candidate.law.name(), inputs[i].name, error.what()));
            }
        }
    }

    UncertainState state(const ModelState& state) const {
        std::vector<MovedResults> results;
        for (std::size_t i = 0; i < inputs_.size(); ++i) {
            results.push_back({list_numbers(below_[i].state(state.length)), list_numbers(above_[i].state(state.length))});
        }
        return take_numbers(state, scaling::find_first_order(list_numbers(state), inputs_, results));
    }

    /// The end of a range of a limit, from how its share depends on the inputs and on the length.
    std::optional<FirstOrder> end(const std::string& limit, double length) const {
        if (limit.empty() || length == kSearch.smallest || length == kSearch.largest) return std::nullopt;
        std::vector<MovedResults> results;
        for (std::size_t i = 0; i < inputs_.size(); ++i) {
            results.push_back({{below_[i].used(limit, length)}, {above_[i].used(limit, length)}});
        }
        const std::vector<UncertainInput> by_length{{"length", {length, 0.0}}};
        const std::vector<MovedResults> lengths{{{own_.used(limit, length / scaling::kMove)}, {own_.used(limit, length * scaling::kMove)}}};
        const std::vector<double> share{own_.used(limit, length)};
        const double slope = scaling::find_first_order(share, by_length, lengths).front().exponents.front();
        std::vector<double> exponents = scaling::find_first_order(share, inputs_, results).front().exponents;
        for (double& exponent : exponents) exponent = exponent == 0.0 ? 0.0 : -exponent / slope;
        return scaling::make_first_order(length, std::move(exponents), inputs_);
    }

  private:
    const std::vector<UncertainInput>& inputs_;
    Case own_;
    std::vector<Case> below_, above_;
};

UncertainCandidate propagate_candidate(const Candidate& candidate, const MovedCases& cases) {
    UncertainCandidate uncertain;
    for (const LimitRanges& limit : candidate.limits) {
        std::vector<UncertainRange>& ranges = uncertain.limits.emplace_back();
        for (const scaling::LengthRange& range : limit.ranges) {
            ranges.push_back({cases.end(limit.limit, range.smallest), cases.end(limit.limit, range.largest)});
        }
    }
    for (const FeasibleRange& range : candidate.ranges) {
        uncertain.ranges.push_back(
            {cases.end(range.binds_below, range.scales.smallest), cases.end(range.binds_above, range.scales.largest)});
    }
    for (const ModelState& end : candidate.ends) uncertain.ends.push_back(cases.state(end));
    if (candidate.chosen) uncertain.chosen = cases.state(*candidate.chosen);
    if (candidate.ranked) uncertain.ranked = cases.state(*candidate.ranked);
    return uncertain;
}

}  // namespace

std::vector<UncertainCandidate> propagate(const Setting& setting, const std::vector<Candidate>& candidates,
                                          const std::vector<UncertainInput>& inputs, const std::vector<MovedSetting>& moved) {
    std::vector<UncertainCandidate> uncertain;
    for (const Candidate& candidate : candidates) {
        // a material that the law does not admit by value has nothing to propagate
        if (candidate.limits.empty() && candidate.ranges.empty()) {
            uncertain.emplace_back();
        } else {
            uncertain.push_back(propagate_candidate(candidate, MovedCases(setting, candidate, inputs, moved)));
        }
    }
    return uncertain;
}

}  // namespace musim::records
