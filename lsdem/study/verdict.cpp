#include "lsdem/study/verdict.hpp"

#include <algorithm>
#include <array>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <utility>

#include "lsdem/results/base_frame.hpp"
#include "lsdem/run/equilibrium.hpp"
#include "lsdem/study/compare_runs.hpp"
#include "lsdem/study/sample_moments.hpp"

namespace musim::lsdem {
namespace {

/// A structure is shaken once a spine block is faster than this part of its peak [-].
constexpr double kLively = 0.1;

/// Quantities are held against each other in their logarithm: residuals scatter by factors. What is below this part of the largest of a
/// family counts as that. Their scatter is no less than this, nor than the mean one of the family over all levels: on a single level few
/// twins may be alike by chance [-].
constexpr double kLeastScatter = kPartingLevel;

double relative_speed(const RunResult& run, std::size_t sample, std::size_t block) {
    const std::size_t at = sample * run.spine.size() + block;
    return find_velocity_on_base(run.history.base[sample], run.history.spine_position[at], run.history.spine_velocity[at]).norm();
}

double find_peak(const RunResult& run) {
    double peak = 0.0;
    for (std::size_t k = 0; k < run.history.samples(); ++k) {
        for (std::size_t s = 0; s < run.spine.line(); ++s) peak = std::max(peak, relative_speed(run, k, s));
    }
    return peak;
}

/// The first sample from which on differences show; that of the end when nothing moves.
std::size_t find_lively(const RunResult& run, double peak) {
    for (std::size_t k = 0; k < run.history.samples(); ++k) {
        for (std::size_t s = 0; s < run.spine.line(); ++s) {
            if (relative_speed(run, k, s) > kLively * peak) return k;
        }
    }
    return run.history.samples() - 1;
}

double largest_coordinate(const RunResult& run) {
    double largest = 0.0;
    for (const Vector3& position : run.initial.position) largest = std::max(largest, position.cwiseAbs().maxCoeff());
    return largest;
}

/// That one more member of the population of `twins` is as far from their mean, on either side; their scatter is no less than given.
double find_probability(double model, const std::vector<double>& twins, double least_scatter) {
    if (twins.size() < 2) return 1.0;
    const SampleMoments moments = moments_of(twins);
    const auto count = static_cast<double>(twins.size());
    const double sd = std::max(moments.sd()[0], least_scatter);
    const double t = std::abs(model - moments.mean()[0]) / (sd * std::sqrt(1.0 + 1.0 / count));
    if (!std::isfinite(t)) return 0.0;
    return 2.0 * boost::math::cdf(boost::math::complement(boost::math::students_t_distribution<double>(count - 1.0), t));
}

/// By how many standard deviations a difference is higher than it should be.
Agreement judge_lead(double lead) {
    if (lead > kPartsTooEarly) return Agreement::differ;
    return lead > kPartsInTime ? Agreement::undecided : Agreement::agree;
}

Agreement judge_probability(double probability) {
    if (probability < kDiffers) return Agreement::differ;
    return probability < kAgrees ? Agreement::undecided : Agreement::agree;
}

}  // namespace

Agreement worst(std::initializer_list<Agreement> all) {
    for (const Agreement agreement : {Agreement::differ, Agreement::undecided, Agreement::not_judged}) {
        if (std::find(all.begin(), all.end(), agreement) != all.end()) return agreement;
    }
    return Agreement::agree;
}

std::string to_string(Agreement agreement) {
    constexpr std::array kNames{"agree", "differ", "undecided", "not_judged"};
    return kNames.at(static_cast<std::size_t>(agreement));
}

const QuantityCheck* find_top(const std::vector<QuantityCheck>& checks, const std::string& key) {
    const QuantityCheck* top = nullptr;
    for (const QuantityCheck& check : checks) {
        if (check.key == key && (top == nullptr || check.level >= top->level)) top = &check;
    }
    return top;
}

RunTrace trace_run(const RunResult& prototype, const RunResult& run, const scaling::Similitude& similitude) {
    RunTrace trace;
    const std::size_t spine = prototype.spine.size(), samples = std::min(prototype.history.samples(), run.history.samples());
    const double velocity = similitude.velocity(), peak = find_peak(prototype);
    double largest = 0.0;
    for (std::size_t k = 0; k < samples; ++k) {
        for (std::size_t i = k * spine; i < k * spine + prototype.spine.line(); ++i) {
            const double difference = (run.history.spine_velocity[i] / velocity - prototype.history.spine_velocity[i]).norm();
            if (difference > 0.0) largest = std::max(largest, difference / peak);
        }
        trace.running.push_back(largest);
    }
    trace.quantities = find_quantities(run, similitude);
    trace.diverged = run.status == RunStatus::diverged;
    return trace;
}

Yardstick::Yardstick(const RunResult& prototype, std::vector<RunTrace> twins)
    : twins_(std::move(twins)), prototype_(find_quantities(prototype, scaling::Similitude())) {
    samples_ = prototype.history.samples();
    interval_ = samples_ > 1 ? prototype.history.time[1] - prototype.history.time[0] : 0.0;
    if (samples_ > 1) steps_per_sample_ = static_cast<double>(prototype.steps) / static_cast<double>(samples_ - 1);
    const double peak = find_peak(prototype);
    moves_ = peak > 0.0;
    lively_ = find_lively(prototype, peak);
    floor_ = std::numeric_limits<double>::epsilon();
    if (moves_) floor_ = std::max(floor_, floor_ * largest_coordinate(prototype) / (prototype.time_step * peak));
    horizon_ = samples_ - 1;
    for (const RunTrace& twin : twins_) {
        const auto parts = std::find_if(twin.running.begin(), twin.running.end(), [](double r) { return r > kPartingLevel; });
        if (parts == twin.running.end()) continue;
        parted_ = true;
        horizon_ = std::min(horizon_, static_cast<std::size_t>(parts - twin.running.begin()));
    }
}

double Yardstick::logarithm(const RunTrace& run, std::size_t sample) const {
    const std::size_t last = std::min(sample, run.running.size() - 1);
    return std::log10(std::max(run.running[last], floor_));
}

Yardstick::Scatter Yardstick::scatter(std::size_t sample) const {
    std::vector<double> logarithms;
    for (const RunTrace& twin : twins_) logarithms.push_back(logarithm(twin, sample));
    const SampleMoments moments = moments_of(logarithms);
    const double measured = twins_.size() >= kMeasuredTwins ? moments.sd()[0] : 0.0;
    return {moments.mean()[0], std::max(measured, kPooledScatter) * std::sqrt(1.0 + 1.0 / static_cast<double>(twins_.size()))};
}

Agreement Yardstick::ImageLead::agreement() const { return judge_lead(lead); }

double Yardstick::find_flight_allowance() const {
    const auto has_parted = [&](std::size_t sample) {
        return std::any_of(twins_.begin(), twins_.end(), [&](const RunTrace& twin) {
            return !twin.image && twin.running[std::min(sample, twin.running.size() - 1)] > 0.0;
        });
    };
    std::size_t last = 0;
    while (last < horizon_ && !has_parted(last + 1)) ++last;
    const double steps = static_cast<double>(last) * steps_per_sample_;
    return steps > 1.0 ? 0.5 * std::log10(steps) : 0.0;
}

std::optional<Yardstick::ImageLead> Yardstick::lead_of_images() const {
    const auto images = static_cast<double>(std::count_if(twins_.begin(), twins_.end(), [](const RunTrace& twin) { return twin.image; }));
    const double copies = static_cast<double>(twins_.size()) - images;
    if (images < 1.0 || copies < 1.0) return std::nullopt;
    const double sd = kPooledScatter * std::sqrt(1.0 / images + 1.0 / copies), flight = find_flight_allowance();
    ImageLead most;
    for (std::size_t k = 0; k <= horizon_; ++k) {
        double of_images = 0.0, of_copies = 0.0;
        for (const RunTrace& twin : twins_) (twin.image ? of_images : of_copies) += logarithm(twin, k);
        const double lead = (of_images / images - of_copies / copies - flight) / sd;
        if (lead > most.lead) most = {lead, time_of(k)};
    }
    return most;
}

std::optional<Yardstick::Seen> Yardstick::smallest_seen() const {
    if (twins_.empty() || !moves_ || lively_ > horizon_) return std::nullopt;
    Seen least{std::numeric_limits<double>::infinity(), 0.0};
    for (std::size_t k = lively_; k <= horizon_; ++k) {
        const Scatter of_twins = scatter(k);
        const double difference = std::pow(10.0, of_twins.mean + kPartsTooEarly * of_twins.sd);
        if (difference < least.difference) least = {difference, time_of(k)};
    }
    return least;
}

double Yardstick::find_scale(std::size_t family) const {
    const std::vector<double>& values = prototype_[family].value;
    return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

double Yardstick::measure(std::size_t family, double value) const {
    if (prototype_[family].key == "fallen_blocks") return std::log(1.0 + value);
    const double least = kLeastScatter * find_scale(family);
    return least > 0.0 ? std::log(std::max(value, least)) : value;
}

std::vector<double> Yardstick::measures_of_twins(std::size_t family, std::size_t level) const {
    std::vector<double> measures{measure(family, prototype_[family].value[level])};
    for (const RunTrace& twin : twins_) measures.push_back(measure(family, twin.quantities[family].value[level]));
    return measures;
}

double Yardstick::least_scatter(std::size_t family) const {
    if (twins_.empty()) return 1.0;
    if (prototype_[family].key == "fallen_blocks") return std::log(2.0);
    const std::size_t levels = prototype_[family].value.size();
    double squares = 0.0;
    for (std::size_t i = 0; i < levels; ++i) {
        const double sd = moments_of(measures_of_twins(family, i)).sd()[0];
        squares += sd * sd / static_cast<double>(levels);
    }
    return std::max(std::sqrt(squares), kLeastScatter);
}

std::vector<QuantityCheck> Yardstick::check_quantities(const RunTrace& run) const {
    std::vector<QuantityCheck> checks;
    for (std::size_t f = 0; f < prototype_.size(); ++f) {
        const QuantityFamily& family = prototype_[f];
        const double scale = find_scale(f), least = least_scatter(f);
        for (std::size_t i = 0; i < family.value.size(); ++i) {
            const auto apart = [&](double value) { return scale > 0.0 ? (value - family.value[i]) / scale : 0.0; };
            QuantityCheck check{family.key, family.title, family.unit, family.level[i], family.value[i], run.quantities[f].value[i]};
            if (i < family.name.size()) check.name = family.name[i];
            check.difference = std::abs(apart(check.model));
            for (const RunTrace& twin : twins_) check.twins.include(apart(twin.quantities[f].value[i]));
            if (parted_) check.probability = find_probability(measure(f, check.model), measures_of_twins(f, i), least);
            checks.push_back(check);
        }
    }
    return checks;
}

std::optional<double> Yardstick::parting_time(const RunTrace& run) const {
    const auto parts = std::find_if(run.running.begin(), run.running.end(), [](double r) { return r > kPartingLevel; });
    if (parts == run.running.end()) return std::nullopt;
    return time_of(static_cast<std::size_t>(parts - run.running.begin()));
}

Judgement Yardstick::judge(const RunTrace& model) const {
    Judgement judgement;
    judgement.parting_time = parting_time(model);
    judgement.quantities = check_quantities(model);
    judgement.within_rounding = !model.diverged && model.running.back() < (model.settled_anew ? kInEquilibrium : kRoundingLevel);
    if (judgement.within_rounding) {
        judgement.agreement = Agreement::agree;
        return judgement;
    }
    if (twins_.empty()) return judgement;
    for (std::size_t k = 0; k <= horizon_; ++k) {
        const Scatter of_twins = scatter(k);
        const double lead = (logarithm(model, k) - of_twins.mean) / of_twins.sd;
        if (lead > judgement.lead) judgement.lead = lead, judgement.lead_time = time_of(k);
    }
    for (const QuantityCheck& check : judgement.quantities) {
        const double corrected = std::min(1.0, check.probability * static_cast<double>(judgement.quantities.size()));
        judgement.least_probability = std::min(judgement.least_probability, corrected);
    }
    judgement.agreement =
        model.diverged ? Agreement::differ : worst({judge_lead(judgement.lead), judge_probability(judgement.least_probability)});
    return judgement;
}

}  // namespace musim::lsdem
