#include "lsdem/base_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace musim::lsdem {
namespace {

/// Where a time falls among the samples of a component.
struct Place {
    std::size_t index = 0;  ///< of the last sample at or before the time
    double elapsed = 0.0;   ///< since that sample [s]
    bool last = false;      ///< no sample follows
};

Place find_place(const BaseComponent& c, double time) {
    const double since = time - c.start;
    const std::size_t last = c.velocity.size() - 1;
    if (last == 0) return {0, since, true};
    const double steps = std::floor(since / c.dt);
    const std::size_t index = steps >= static_cast<double>(last) ? last : static_cast<std::size_t>(steps);
    return {index, since - static_cast<double>(index) * c.dt, index == last};
}

/// Acceleration that holds after sample `index` [m/s²].
double slope(const BaseComponent& c, const Place& place) {
    return place.last ? 0.0 : (c.velocity[place.index + 1] - c.velocity[place.index]) / c.dt;
}

bool at_rest(const BaseComponent& c, double time) { return c.velocity.empty() || time < c.start; }

/// of(axis, where the time falls among its samples) for every axis that has begun to move; zero for the others.
template <class Axes, class Of>
Vector3 find_by_axis(const Axes& axes, double time, const Of& of) {
    Vector3 result = Vector3::Zero();
    for (std::size_t a = 0; a < 3; ++a) {
        const BaseComponent& samples = axes[a].samples;
        if (!at_rest(samples, time)) result[static_cast<Eigen::Index>(a)] = of(axes[a], find_place(samples, time));
    }
    return result;
}

template <class Axes>
Vector3 find_integral(const Axes& axes, double time) {
    return find_by_axis(axes, time, [](const auto& axis, const Place& at) {
        return axis.displacement[at.index] + (axis.samples.velocity[at.index] + 0.5 * slope(axis.samples, at) * at.elapsed) * at.elapsed;
    });
}

template <class Axes>
Vector3 find_value(const Axes& axes, double time) {
    return find_by_axis(axes, time, [](const auto& axis, const Place& at) {
        return axis.samples.velocity[at.index] + slope(axis.samples, at) * at.elapsed;
    });
}

template <class Axes>
Vector3 find_slope(const Axes& axes, double time) {
    return find_by_axis(axes, time, [](const auto& axis, const Place& at) { return slope(axis.samples, at); });
}

}  // namespace

BaseMotion::BaseMotion(const BaseComponents& motion)
    : shift_(make_axes(motion.shift)), turn_(make_axes(motion.turn)), pivot_(motion.pivot), turns_(motion.turns()) {
    if (!pivot_.allFinite()) throw std::invalid_argument("base motion: the point about which it turns is not finite");
}

BaseMotion::Axes BaseMotion::make_axes(const std::array<BaseComponent, 3>& components) {
    Axes axes;
    for (std::size_t a = 0; a < 3; ++a) {
        const BaseComponent& c = components[a];
        if (c.velocity.size() > 1 && !(c.dt > 0.0)) throw std::invalid_argument("base motion: the sample interval must be positive");
        const bool finite = std::all_of(c.velocity.begin(), c.velocity.end(), [](double v) { return std::isfinite(v); });
        if (!finite || !std::isfinite(c.start)) throw std::invalid_argument("base motion: a sample is not a finite number");
        axes[a].samples = c;
        axes[a].displacement.assign(c.velocity.size(), 0.0);
        for (std::size_t k = 1; k < c.velocity.size(); ++k)
            axes[a].displacement[k] = axes[a].displacement[k - 1] + 0.5 * c.dt * (c.velocity[k - 1] + c.velocity[k]);
    }
    return axes;
}

Vector3 BaseMotion::displacement(double time) const { return find_integral(shift_, time); }
Vector3 BaseMotion::velocity(double time) const { return find_value(shift_, time); }
Vector3 BaseMotion::acceleration(double time) const { return find_slope(shift_, time); }
Vector3 BaseMotion::angle(double time) const { return find_integral(turn_, time); }
Quaternion BaseMotion::turn(double time) const { return turn_by(angle(time)); }
TurnRates BaseMotion::turn_rates(double time) const {
    return find_turn_rates(angle(time), find_value(turn_, time), find_slope(turn_, time));
}

Vector3 BaseMotion::peak_acceleration(double end) const {
    Vector3 peak = Vector3::Zero();
    for (int a = 0; a < 3; ++a) {
        const BaseComponent& c = shift_[static_cast<std::size_t>(a)].samples;
        for (std::size_t k = 1; k < c.velocity.size(); ++k) {
            const double begins = c.start + static_cast<double>(k - 1) * c.dt;
            if (begins >= end || begins + c.dt <= 0.0) continue;
            peak[a] = std::max(peak[a], std::abs(c.velocity[k] - c.velocity[k - 1]) / c.dt);
        }
    }
    return peak;
}

double BaseMotion::still_until(double time) const {
    double until = std::numeric_limits<double>::infinity();
    for (std::size_t a = 0; a < 6; ++a) {
        const BaseComponent& c = a < 3 ? shift_[a].samples : turn_[a - 3].samples;
        // the axis moves from the last zero sample before the first other one
        const std::size_t here = at_rest(c, time) ? 0 : find_place(c, time).index;
        const auto moving = std::find_if(c.velocity.begin() + static_cast<std::ptrdiff_t>(std::min(here, c.velocity.size())),
                                         c.velocity.end(), [](double v) { return v != 0.0; });
        if (moving == c.velocity.end()) continue;
        const auto first = static_cast<double>(std::max<std::ptrdiff_t>(0, moving - c.velocity.begin() - 1));
        until = std::min(until, c.start + first * (c.velocity.size() > 1 ? c.dt : 0.0));
    }
    return std::max(until, time);
}

}  // namespace musim::lsdem
