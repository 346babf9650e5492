#include "records/shake_table/table_correction.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace musim::records {
namespace {

/// Corners are tried at this many places in an octave.
constexpr double kCornersPerOctave = 8.0;

/// A corner and an amplitude together are proposed where they change the spectra by less than this share of what either does alone.
constexpr double kWorthBoth = 0.9;

/// Below one by more than rounding, so that a corrected motion holds its limits when it is measured again.
constexpr double kAmplitudeMargin = 1.0 - 1e-9;

bool is_upper_frequency(const LimitUse& use) {
    return use.which == TableLimit::highest_frequency || use.which == TableLimit::oil_column || use.which == TableLimit::controller_band;
}

bool is_about_frequency(const LimitUse& use) { return use.which == TableLimit::lowest_frequency || is_upper_frequency(use); }

/// The largest use of the limits that a smaller amplitude eases, and of the others.
struct Uses {
    double by_amplitude = 0.0, by_others = 0.0;
};

Uses split(const std::vector<ComponentUse>& components) {
    Uses largest;
    for (const ComponentUse& component : components) {
        for (const LimitUse& use : component.uses) {
            const bool is_fixed = is_about_frequency(use) || use.which == TableLimit::payload;
            double& entry = is_fixed ? largest.by_others : largest.by_amplitude;
            entry = std::max(entry, use.used());
        }
    }
    return largest;
}

/// The upper frequency that all axes can follow; nothing when there is no such limit.
std::optional<scaling::Frequency> find_highest(const std::vector<ComponentUse>& uses) {
    std::optional<scaling::Frequency> highest;
    for (const ComponentUse& component : uses) {
        for (const LimitUse& use : component.uses) {
            if (!is_upper_frequency(use)) continue;
            const scaling::Frequency limit = use.limit / scaling::si::seconds;
            if (use.used() > 1.0 && (!highest || limit < *highest)) highest = limit;
        }
    }
    return highest;
}

/// Lowers the low-pass corner until the energy lies below what the axes can follow.
void add_low_pass(const TableTask& task, DriveSettings& settings) {
    const auto highest = find_highest(check_task(task, settings));
    if (!highest) return;
    for (double octaves = 0.0; octaves < 2.0; octaves += 1.0 / kCornersPerOctave) {
        settings.low_pass = *highest * std::exp2(-octaves);
        if (!find_highest(check_task(task, settings))) return;
    }
}

/// Mean and largest |ln ratio| of the spectra.
void measure_change(Correction& correction) {
    double sum = 0.0;
    std::size_t count = 0;
    for (const SpectrumChange& change : correction.spectra) {
        const auto before = change.before.pseudo_acceleration(), after = change.after.pseudo_acceleration();
        for (std::size_t i = 0; i < before.size(); ++i, ++count) {
            const double ratio = std::abs(std::log(after[i] / before[i]));
            sum += ratio;
            correction.largest_change = std::max(correction.largest_change, ratio);
        }
    }
    correction.mean_change = sum / static_cast<double>(count);
}

/// Response spectrum of a motion; an oscillator that turns answers angular accelerations by the same equation.
ResponseSpectrum compute_spectrum(const DriveMotion& motion, const std::vector<scaling::Time>& periods) {
    const std::span<const double> samples = motion.acceleration.samples();
    return compute_response_spectrum(motion.acceleration.with_samples(SampleQuantity::acceleration, {samples.begin(), samples.end()}),
                                     periods);
}

/// Looks for corrections at the record's own step.
class Search {
  public:
    Search(const TableTask& task, const std::vector<scaling::Time>& periods) : task_(task), periods_(periods) {
        task_.settings = task.settings.at_own_step();
        add_low_pass(task_, task_.settings);
        for (const DriveMotion& motion : make_drive_motions(task.model, task.settings.at_own_step())) {
            before_.push_back(compute_spectrum(motion, periods));
        }
    }

    const TableTask& task() const { return task_; }

    /// The amplitude that these filters leave, at most 1; nothing when no amplitude fits.
    std::optional<Correction> fit_amplitude(DriveSettings settings) const {
        const Uses uses = split(check_task(task_, settings));
        if (uses.by_others > 1.0) return std::nullopt;
        if (uses.by_amplitude > 1.0) settings.amplitude = kAmplitudeMargin / uses.by_amplitude;
        return describe(settings, check_task(task_, settings));
    }

    /// The correction with the controller's step; peaks between the record's samples may take a little more of the amplitude.
    Correction put_on_controller(Correction correction, const TableTask& task) const {
        if (!task.settings.dt) return correction;
        correction.settings.dt = task.settings.dt;
        const Uses uses = split(check_task(task, correction.settings));
        if (uses.by_amplitude > 1.0) correction.settings.amplitude *= kAmplitudeMargin / uses.by_amplitude;
        return describe(correction.settings, check_task(task, correction.settings));
    }

  private:
    Correction describe(const DriveSettings& settings, std::vector<ComponentUse> uses) const {
        Correction correction{settings, std::move(uses), {}};
        const std::vector<DriveMotion> motions = make_drive_motions(task_.model, settings.at_own_step());
        for (std::size_t c = 0; c < motions.size(); ++c) {
            correction.spectra.push_back(
                {task_.model.components[c].name, before_[c], compute_spectrum(motions[c], periods_), task_.axes[c].is_rotation});
        }
        measure_change(correction);
        return correction;
    }

    TableTask task_;
    const std::vector<scaling::Time>& periods_;
    std::vector<ResponseSpectrum> before_;
};

/// Corners to try: from the record's own, or 1/duration, up to the middle between its lowest and highest frequency (in octaves).
std::vector<scaling::Frequency> make_corners(const TableTask& task) {
    const std::vector<ComponentUse> uses = check_task(task);
    double first = 0.0, last = 0.0;
    for (std::size_t c = 0; c < uses.size(); ++c) {
        const auto own = task.settings.high_pass ? task.settings.high_pass : task.model.integration_corner;
        first = std::max(first, (own ? *own : 1.0 / task.model.components[c].series.duration()).value());
        last = std::max(last, std::sqrt(uses[c].demand.lowest_frequency.value() * uses[c].demand.highest_frequency.value()));
    }
    std::vector<scaling::Frequency> corners;
    for (double corner = first; corner <= last; corner *= std::exp2(1.0 / kCornersPerOctave)) {
        corners.push_back(corner / scaling::si::seconds);
    }
    return corners;
}

}  // namespace

std::vector<ComponentUse> check_task(const TableTask& task) { return check_task(task, task.settings); }

std::vector<ComponentUse> check_task(const TableTask& task, const DriveSettings& settings) {
    const std::vector<TableDemand> demands = find_demands(task.model, settings, task.energy_share);
    std::vector<ComponentUse> uses;
    for (std::size_t c = 0; c < demands.size(); ++c) {
        uses.push_back({task.model.components[c].name, task.axes[c].name, demands[c], check_axis(demands[c], task.axes[c], task.payload),
                        task.axes[c].is_rotation});
    }
    return uses;
}

double find_largest_use(const std::vector<ComponentUse>& uses) {
    const Uses largest = split(uses);
    return std::max(largest.by_amplitude, largest.by_others);
}

std::vector<Correction> find_corrections(const TableTask& task, const std::vector<scaling::Time>& periods) {
    const Search search(task, periods);
    std::vector<Correction> corrections;
    const auto by_amplitude = search.fit_amplitude(search.task().settings);
    if (by_amplitude) corrections.push_back(*by_amplitude);
    const bool needs_corner = !by_amplitude || by_amplitude->settings.amplitude < 1.0;
    std::optional<Correction> by_filter, by_both;
    for (const scaling::Frequency& corner : needs_corner ? make_corners(search.task()) : std::vector<scaling::Frequency>()) {
        DriveSettings settings = search.task().settings;
        settings.high_pass = corner;
        const auto candidate = search.fit_amplitude(settings);
        if (!candidate) continue;
        if (candidate->settings.amplitude == 1.0) {
            by_filter = candidate;
            break;  // higher corners only take more
        }
        if (!by_both || candidate->mean_change < by_both->mean_change) by_both = candidate;
    }
    if (by_filter) corrections.push_back(*by_filter);
    const auto changes_less = [&](const Correction& other) { return by_both->mean_change < kWorthBoth * other.mean_change; };
    if (by_both && std::all_of(corrections.begin(), corrections.end(), changes_less)) corrections.push_back(*by_both);
    for (Correction& correction : corrections) correction = search.put_on_controller(correction, task);
    std::stable_sort(corrections.begin(), corrections.end(),
                     [](const Correction& a, const Correction& b) { return a.mean_change < b.mean_change; });
    return corrections;
}

std::vector<scaling::Time> make_task_periods(const std::vector<ComponentUse>& uses) {
    constexpr std::size_t kTaskPeriods = 50;
    scaling::Frequency lowest = uses.front().demand.lowest_frequency, highest = uses.front().demand.highest_frequency;
    for (const ComponentUse& use : uses) {
        lowest = std::min(lowest, use.demand.lowest_frequency);
        highest = std::max(highest, use.demand.highest_frequency);
    }
    return make_periods(1.0 / highest, 1.0 / lowest, kTaskPeriods);
}

}  // namespace musim::records
