#include "records/shake_table/table_check.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "records/measures/measures.hpp"
#include "records/shake_table/table_axes.hpp"
#include "scaling/laws/length_range.hpp"

namespace musim::records {
namespace {

double find_largest(std::span<const double> samples) {
    double largest = 0.0;
    for (const double sample : samples) largest = std::max(largest, std::abs(sample));
    return largest;
}

/// Frequencies with `share` of ∫a² dt above, and below.
std::pair<scaling::Frequency, scaling::Frequency> find_band(const TimeSeries& acceleration, double energy_share) {
    const FourierAmplitudes spectrum = compute_fourier_amplitudes(acceleration);
    std::vector<double> energy;
    for (const double amplitude : spectrum.amplitude) energy.push_back(amplitude * amplitude);
    std::partial_sum(energy.begin(), energy.end(), energy.begin());
    const auto index = [&](double share) {
        const auto at = std::lower_bound(energy.begin(), energy.end(), share * energy.back());
        return static_cast<double>(std::max<std::ptrdiff_t>(at - energy.begin(), 1));
    };
    return {index(1.0 - energy_share) * spectrum.step, index(energy_share) * spectrum.step};
}

/// Straight lines of 1/a over the payload.
scaling::Acceleration find_acceleration_limit(const std::vector<PayloadLimit>& limits, scaling::Mass payload) {
    if (limits.size() == 1) return limits.front().limit;
    std::size_t above = 1;
    while (above + 1 < limits.size() && limits[above].payload < payload) ++above;
    const PayloadLimit &a = limits[above - 1], &b = limits[above];
    const double along = std::max(((payload - a.payload) / (b.payload - a.payload)).value(), 0.0);
    const double inverse = (1.0 - along) / a.limit.value() + along / b.limit.value();
    return scaling::Acceleration::from_value(1.0 / inverse);
}

/// The limit that is used most, and by how much.
struct Worst {
    LimitUse use;
    std::string axis;
};

Worst find_worst(const std::vector<AxisLoad>& loads, const UsesOfAxis& find_uses, const LimitFilter& counts, double length) {
    std::optional<Worst> worst;
    for (const AxisLoad& load : loads) {
        for (const LimitUse& use : find_uses(load, length)) {
            if ((!counts || counts(load.axis, use.which)) && (!worst || use.used() > worst->use.used())) worst = Worst{use, load.axis.name};
        }
    }
    // a table without limits can do everything
    return worst.value_or(Worst{{TableLimit::displacement, 0.0, 1.0}, ""});
}

}  // namespace

TableDemand find_demand(const DriveMotion& motion, double energy_share) {
    const std::span<const double> displacement = motion.displacement.samples();
    const double acceleration = find_largest(motion.acceleration.samples());
    if (acceleration == 0.0) throw ProcessingError("the motion is zero everywhere; give a record with a motion");
    const auto [low, high] = std::minmax_element(displacement.begin(), displacement.end());
    const auto [lowest, highest] = find_band(motion.acceleration, energy_share);
    return {find_largest(displacement) * scaling::si::meters,
            0.5 * (*high - *low) * scaling::si::meters,
            find_largest(motion.velocity.samples()) * scaling::si::meters_per_second,
            acceleration * scaling::si::meters_per_second_squared,
            lowest,
            highest};
}

std::vector<TableDemand> find_demands(const GroundMotion& model, const DriveSettings& settings, double energy_share) {
    std::vector<TableDemand> demands;
    for (const DriveMotion& motion : make_drive_motions(model, settings)) demands.push_back(find_demand(motion, energy_share));
    if (!settings.dt) return demands;
    DriveSettings at_own_step = settings;
    at_own_step.dt.reset();
    const std::vector<DriveMotion> motions = make_drive_motions(model, at_own_step);
    for (std::size_t c = 0; c < motions.size(); ++c) {
        std::tie(demands[c].lowest_frequency, demands[c].highest_frequency) = find_band(motions[c].acceleration, energy_share);
    }
    return demands;
}

TableDemand to_model(const TableDemand& prototype, const scaling::ModelScales& scales, scaling::Shaking direction) {
    const scaling::ShakingScales motion = scales.shaking(direction);
    return {motion.displacement * prototype.displacement,  motion.displacement * prototype.half_range,
            motion.velocity * prototype.velocity,          motion.acceleration * prototype.acceleration,
            scales.frequency * prototype.lowest_frequency, scales.frequency * prototype.highest_frequency};
}

TableDemand to_prototype(const TableDemand& model, const scaling::ModelScales& scales, scaling::Shaking direction) {
    const scaling::ShakingScales motion = scales.shaking(direction);
    return {model.displacement / motion.displacement,  model.half_range / motion.displacement,
            model.velocity / motion.velocity,          model.acceleration / motion.acceleration,
            model.lowest_frequency / scales.frequency, model.highest_frequency / scales.frequency};
}

Payload Payload::on_model(const scaling::ModelScales& scales) const {
    if (!is_prototype) return *this;
    return {scales.mass * mass, scales.height * height, false};
}

std::string_view to_string(TableLimit limit) {
    constexpr std::string_view kNames[] = {"displacement", "velocity",         "acceleration",      "force",      "overturning moment",
                                           "payload",      "lowest frequency", "highest frequency", "oil column", "controller band"};
    return kNames[static_cast<std::size_t>(limit)];
}

std::vector<LimitUse> check_axis(const TableDemand& demand, const TableAxis& axis, const Payload& payload) {
    std::vector<LimitUse> uses;
    const auto add = [&](TableLimit which, double value, double limit) { uses.push_back({which, value, limit}); };
    if (axis.displacement) add(TableLimit::displacement, demand.displacement.value(), axis.displacement->value());
    if (axis.velocity) add(TableLimit::velocity, demand.velocity.value(), axis.velocity->value());
    if (!axis.acceleration.empty()) {
        const auto limit = find_acceleration_limit(axis.acceleration, payload.mass);
        add(TableLimit::acceleration, demand.acceleration.value(), limit.value());
    }
    if (axis.force) {
        const scaling::Force force = (*axis.moving_mass + payload.mass) * demand.acceleration;
        add(TableLimit::force, force.value(), axis.force->value());
    }
    if (axis.overturning_moment) {
        const double moment = payload.mass.value() * payload.height.value() * demand.acceleration.value();
        add(TableLimit::overturning_moment, moment, axis.overturning_moment->value());
    }
    if (axis.payload) add(TableLimit::payload, payload.mass.value(), axis.payload->value());
    if (axis.lowest_frequency) add(TableLimit::lowest_frequency, demand.lowest_frequency.value(), axis.lowest_frequency->value());
    if (axis.highest_frequency) add(TableLimit::highest_frequency, demand.highest_frequency.value(), axis.highest_frequency->value());
    if (axis.oil_column) {
        const double loaded = std::sqrt((*axis.moving_mass / (*axis.moving_mass + payload.mass)).value());
        const double limit = axis.oil_column->share * loaded * axis.oil_column->frequency.value();
        add(TableLimit::oil_column, demand.highest_frequency.value(), limit);
    }
    if (axis.controller_rate) {
        add(TableLimit::controller_band, demand.highest_frequency.value(), kFollowedShare * axis.controller_rate->value());
    }
    return uses;
}

std::vector<ScaleRange> find_scales(const std::vector<AxisLoad>& loads, const Payload& payload, const ScalesOfLength& scales_of,
                                    const LimitFilter& counts) {
    const auto find_uses = [&](const AxisLoad& load, double length) {
        const scaling::ModelScales scales = scales_of(length);
        return check_axis(to_model(load.prototype, scales, find_shaking(load.axis)), load.axis, payload.on_model(scales));
    };
    return find_scales(loads, UsesOfAxis(find_uses), counts);
}

std::vector<ScaleRange> find_scales(const std::vector<AxisLoad>& loads, const UsesOfAxis& find_uses, const LimitFilter& counts) {
    constexpr int kStepsPerOctave = 64;
    const auto worst = [&](double length) { return find_worst(loads, find_uses, counts, length); };
    const auto used = [&](double length) { return worst(length).use.used(); };
    // the last scale that fits on the way to one that does not, and what is in the way there
    const auto find_end = [&](double inside, double outside) {
        const scaling::LengthRange part = scaling::find_length_range(used, {std::min(inside, outside), std::max(inside, outside)}).front();
        const double end = inside < outside ? part.largest : part.smallest;
        return std::pair(end, worst(std::nextafter(end, outside)));
    };
    const int steps = static_cast<int>(std::lround(std::log2(1.0 / kSmallestScale))) * kStepsPerOctave;
    std::vector<ScaleRange> ranges;
    bool inside = false;
    double before = kSmallestScale;
    for (int i = 0; i <= steps; ++i) {
        const double length = kSmallestScale * std::exp2(static_cast<double>(i) / kStepsPerOctave);
        const bool now = used(length) <= 1.0;
        if (now && !inside) {
            ScaleRange range{length, length, {}, {}, {}, {}};
            if (i > 0) {
                const auto [end, beyond] = find_end(length, before);
                range.smallest = end;
                range.binds_below = beyond.use.which;
                range.axis_below = beyond.axis;
            }
            ranges.push_back(range);
        } else if (!now && inside) {
            const auto [end, beyond] = find_end(before, length);
            ranges.back().largest = end;
            ranges.back().binds_above = beyond.use.which;
            ranges.back().axis_above = beyond.axis;
        }
        if (now) ranges.back().largest = length;
        inside = now;
        before = length;
    }
    return ranges;
}

}  // namespace musim::records
