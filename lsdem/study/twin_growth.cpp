#include "lsdem/study/twin_growth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "lsdem/study/compare_runs.hpp"
#include "lsdem/study/sample_moments.hpp"
#include "scaling/random_bits.hpp"

namespace musim::lsdem {
namespace {

/// The spread of differences is reported at this part of the horizon: before the earliest twin parts, where all are still on their way.
constexpr double kBeforeHorizon = 0.9;

/// Rounding of a study that says nothing of it: a velocity itself has so many digits [-].
constexpr double kLeastRounding = std::numeric_limits<double>::epsilon();

/// A difference is in proportion to what made it when it is this many times that of rounding, whose part is then a tenth at most [-].
constexpr double kAboveRounding = 10.0;

/// R of what rounding alone makes, sample by sample: the largest of exact models.
std::vector<double> find_rounding(const TwinStudy& study, const std::vector<TwinGrowth>& twins) {
    std::vector<double> rounding(study.prototype.samples, study.prototype.rounding / study.prototype.peak);
    for (std::size_t i = 0; i < twins.size(); ++i) {
        if (study.twins[i].choice.shift > 0.0) continue;
        const std::vector<double>& running = twins[i].running;
        for (std::size_t k = 0; k < running.size(); ++k) rounding[k] = std::max(rounding[k], running[k]);
    }
    return rounding;
}

/// Copies moved in the same directions, by how far.
using ByShift = std::map<double, const TwinGrowth*>;

/// Distance of copies from being in proportion at one sample.
struct Disproportion {
    double factor = 0.0;  ///< largest over least R/shift; 0 of fewer than two copies [-]
    double level = 0.0;   ///< largest R [-]
};
/// `rounding`: R of what rounding makes.
Disproportion find_disproportion(const ByShift& copies, std::size_t sample, double rounding) {
    double low = std::numeric_limits<double>::infinity(), high = 0.0, level = 0.0;
    std::size_t count = 0;
    for (const auto& [shift, twin] : copies) {
        if (sample >= twin->running.size()) continue;
        const double r = twin->running[sample];
        if (!(r > kAboveRounding * rounding) || r > kProportionalLevel) continue;
        low = std::min(low, r / shift), high = std::max(high, r / shift), level = std::max(level, r);
        ++count;
    }
    return count < 2 ? Disproportion{} : Disproportion{high / low, level};
}

/// Lengths of models: 4^u with |u| below this, 1:16 to 16:1.
constexpr double kMostQuadruplings = 2.0;

/// Largest growth of R, sample by sample.
Growth find_largest_growth(const TwinPrototype& prototype, const TwinChoice& choice, const std::vector<double>& running) {
    Growth largest;
    const std::size_t window = prototype.window();
    // copies that begin elsewhere differ at once
    const std::size_t first = choice.shift > 0.0 ? window : 0;
    for (std::size_t k = first + 1; k < running.size(); ++k) {
        const double from = running[std::max(first, k - std::min(k, window))];
        if (from > kPartingLevel) break;
        const double factor = std::min(running[k], kPartingLevel) / std::max({from, prototype.rounding / prototype.peak, kLeastRounding});
        if (factor > largest.factor) largest = {factor, prototype.time(k), from};
    }
    return largest;
}

}  // namespace

std::size_t TwinPrototype::window() const {
    if (!(gravity > 0.0)) return 1;
    return static_cast<std::size_t>(std::max(1.0, std::round(kGrowthWindow * std::sqrt(height / gravity) / interval)));
}

TwinGrowth find_growth(const TwinPrototype& prototype, const TwinRun& twin) {
    TwinGrowth growth;
    double largest = 0.0;
    for (const double difference : twin.difference) {
        largest = std::max(largest, difference / prototype.peak);
        if (largest > kPartingLevel && !growth.parting_time) growth.parting_time = prototype.time(growth.running.size());
        growth.running.push_back(largest);
    }
    growth.growth = find_largest_growth(prototype, twin.choice, growth.running);
    return growth;
}

LogSpread find_spread(const TwinStudy& study, const std::vector<TwinGrowth>& twins, std::size_t sample) {
    SampleMoments moments(1);
    for (std::size_t i = 0; i < twins.size(); ++i) {
        const std::vector<double>& running = twins[i].running;
        if (study.twins[i].choice.shift > 0.0 || sample >= running.size() || !(running[sample] > 0.0)) continue;
        moments.add(Eigen::ArrayXd::Constant(1, std::log10(running[sample])));
    }
    return {study.prototype.time(sample), static_cast<std::size_t>(moments.count()), moments.mean()[0], moments.sd()[0]};
}

TwinSummary summarize(const TwinStudy& study) {
    if (study.twins.empty()) throw std::invalid_argument("twins: there are none to be summed up");
    const TwinPrototype& prototype = study.prototype;
    if (!(prototype.peak > 0.0)) throw std::invalid_argument("twins: the prototype never moves, so differences have no measure");
    TwinSummary summary;
    summary.horizon = prototype.time(prototype.samples - 1);
    for (const TwinRun& twin : study.twins) {
        const TwinGrowth& growth = summary.twins.emplace_back(find_growth(prototype, twin));
        if (growth.parting_time) summary.horizon = std::min(summary.horizon, *growth.parting_time);
        if (growth.growth.factor > summary.twins[summary.fastest].growth.factor) summary.fastest = summary.twins.size() - 1;
    }
    // a little more, lest rounding take one away
    const auto sample = static_cast<std::size_t>(kBeforeHorizon * summary.horizon / prototype.interval + 1e-9);
    summary.at_horizon = find_spread(study, summary.twins, sample);
    return summary;
}

std::vector<Proportionality> find_proportionality(const TwinStudy& study, const std::vector<TwinGrowth>& twins) {
    std::map<std::uint64_t, ByShift> copies;
    for (std::size_t i = 0; i < twins.size(); ++i) {
        const TwinChoice& choice = study.twins[i].choice;
        if (choice.shift > 0.0) copies[choice.directions][choice.shift] = &twins[i];
    }
    const std::vector<double> rounding = find_rounding(study, twins);
    std::vector<Proportionality> found;
    for (const auto& [directions, by_shift] : copies) {
        if (by_shift.size() < 2) continue;
        Proportionality& set = found.emplace_back();
        set.directions = directions;
        for (const auto& [shift, twin] : by_shift) set.shift.push_back(shift);
        std::vector<Disproportion> departures;
        for (std::size_t k = 0; k < study.prototype.samples; ++k) departures.push_back(find_disproportion(by_shift, k, rounding[k]));
        const std::size_t window = study.prototype.window();
        for (std::size_t k = 0; k < departures.size(); ++k) {
            double lasting = departures[k].factor;
            for (std::size_t next = k + 1; next < departures.size() && next <= k + window && departures[next].factor > 0.0; ++next) {
                lasting = std::min(lasting, departures[next].factor);
            }
            if (lasting <= set.departure.value_or(0.0)) continue;
            set.departure = lasting, set.time = study.prototype.time(k), set.level = departures[k].level;
        }
    }
    return found;
}

std::vector<TwinChoice> choose_models(std::size_t models, std::uint64_t seed) {
    std::vector<TwinChoice> choices;
    for (std::size_t i = 0; i < models; ++i) {
        const double u = kMostQuadruplings * (2.0 * scaling::to_probability(scaling::random_bits(seed, i)) - 1.0);
        choices.push_back({.length = std::pow(4.0, u)});
    }
    return choices;
}

std::vector<TwinChoice> choose_shifted(const std::vector<double>& shifts, std::size_t sets, std::uint64_t seed) {
    std::vector<TwinChoice> choices;
    for (std::size_t set = 0; set < sets; ++set) {
        for (const double shift : shifts) choices.push_back({.shift = shift, .directions = seed + set});
    }
    return choices;
}

}  // namespace musim::lsdem
