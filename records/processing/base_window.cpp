#include "records/processing/base_window.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "records/processing/uncorrected.hpp"

namespace musim::records {
namespace {

/// Places at which windows may open, and close.
constexpr std::size_t kPlaces = 150;

/// Places along a window at which its correction is looked at.
constexpr int kLooks = 20;

/// Velocity and displacement of a whole component, and their peaks.
struct WholeMotion {
    TimeSeries velocity, displacement;
    double peak_velocity, peak_displacement;

    explicit WholeMotion(BaseMotion motion)
        : velocity(std::move(motion.velocity)),
          displacement(std::move(motion.displacement)),
          peak_velocity(find_largest(velocity.samples())),
          peak_displacement(find_largest(displacement.samples())) {}

    /// The sample nearest to a time.
    std::size_t find_sample(scaling::Time time) const {
        const double index = std::round(((time - velocity.start()) / velocity.dt()).value());
        return static_cast<std::size_t>(std::clamp(index, 0.0, static_cast<double>(velocity.size() - 1)));
    }
};

/// Cost of the correction of a window: c = −v₀(1 − τ) − v_T τ + 6q τ(1 − τ) from the velocity, with q such that ∫ c dt = −(d_T − d_0)
/// for a base that comes home, 0 else; and its integral from the displacement, which begins d_0 from the record's zero.
double find_cost(const WholeMotion& motion, const TimeWindow& window, bool home) {
    const std::size_t first = motion.find_sample(window.start), last = motion.find_sample(window.end);
    if (last <= first || !(motion.peak_velocity > 0.0)) return 0.0;
    const double length = static_cast<double>(last - first) * motion.velocity.dt().value();
    const double v0 = motion.velocity.samples()[first], v1 = motion.velocity.samples()[last];
    const double d0 = motion.displacement.samples()[first], drift = motion.displacement.samples()[last] - d0;
    const double q = home ? 0.5 * (v0 + v1) - drift / length : 0.0;
    double of_velocity = 0.0, of_displacement = 0.0;
    for (int k = 0; k <= kLooks; ++k) {
        const double t = static_cast<double>(k) / kLooks;
        const double taken = -v0 * (1.0 - t) - v1 * t + 6.0 * q * t * (1.0 - t);
        const double path = -v0 * t * (1.0 - 0.5 * t) - 0.5 * v1 * t * t + q * t * t * (3.0 - 2.0 * t);
        of_velocity = std::max(of_velocity, std::abs(taken));
        of_displacement = std::max(of_displacement, std::abs(length * path - d0));
    }
    return of_velocity / motion.peak_velocity + of_displacement / motion.peak_displacement;
}

/// The component whose strong motion counts: the first translation, or rotation where there is none.
const Component& find_leading(const GroundMotion& motion, const std::vector<std::string>& components) {
    const auto moves = [&](const std::string& name) { return !is_rotation(motion.find_component(name)); };
    const auto first = std::find_if(components.begin(), components.end(), moves);
    return motion.find_component(first == components.end() ? components.front() : *first);
}

/// Times from `from` to `to`, on samples of `series`.
std::vector<scaling::Time> list_places(const TimeSeries& series, scaling::Time from, scaling::Time to) {
    const double first = std::ceil(((from - series.start()) / series.dt()).value() - 1e-9);
    const double last = std::floor(((to - series.start()) / series.dt()).value() + 1e-9);
    const double step = std::max(1.0, std::ceil((last - first) / static_cast<double>(kPlaces)));
    std::vector<scaling::Time> places;
    for (double i = first; i <= last; i += step) places.push_back(series.start() + i * series.dt());
    return places;
}

}  // namespace

TimeWindow find_base_window(const GroundMotion& motion, const std::vector<std::string>& components, const BaseMotionSettings& settings) {
    const BaseMotionSettings whole{.take_out_mean = settings.take_out_mean, .high_pass = settings.high_pass, .at_rest = AtRest::as_given};
    std::vector<WholeMotion> motions;
    for (const std::string& name : components) motions.emplace_back(make_base_motion(motion, name, whole));

    const TimeSeries& series = find_leading(motion, components).series;
    TimeSeries leveled = level_uncorrected(series, motion.integration_corner);
    while (derivative_order(leveled.quantity()) < 2) leveled = differentiate(leveled);
    const TimeWindow strong = find_strong_motion(leveled, 0.0);
    const scaling::Time reach = kWindowReach * (strong.end - strong.start);
    scaling::Time earliest = strong.start - reach, latest = strong.end + reach;
    for (const WholeMotion& each : motions) {
        earliest = std::max(earliest, each.velocity.start());
        latest = std::min(latest, each.velocity.end());
    }

    std::optional<TimeWindow> best;
    double least = 0.0;
    for (const scaling::Time& start : list_places(series, earliest, strong.start)) {
        for (const scaling::Time& end : list_places(series, strong.end, latest)) {
            const TimeWindow window{start, end};
            double cost = 0.0;
            for (const WholeMotion& each : motions) cost = std::max(cost, find_cost(each, window, settings.at_rest == AtRest::home));
            cost = std::max(cost, kCheapWindow);
            const bool is_shorter = best && cost == least && end - start < best->end - best->start;
            if (best && cost >= least && !is_shorter) continue;
            best = window;
            least = cost;
        }
    }
    return best.value_or(TimeWindow{std::max(earliest, strong.start), std::min(latest, strong.end)});
}

}  // namespace musim::records
