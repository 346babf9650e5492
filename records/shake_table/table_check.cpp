#include "records/shake_table/table_check.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

#include "records/measures/measures.hpp"
#include "records/shake_table/shake_table.hpp"
#include "scaling/memoized.hpp"

namespace musim::records {
namespace {

/// Name and SI unit, in the order of TableLimit.
constexpr std::pair<std::string_view, std::string_view> kLimits[] = {{"displacement", "m"},
                                                                     {"velocity", "m/s"},
                                                                     {"acceleration", "m/s^2"},
                                                                     {"force", "N"},
                                                                     {"overturning moment", "N m"},
                                                                     {"payload", "kg"},
                                                                     {"lowest frequency", "Hz"},
                                                                     {"highest frequency", "Hz"},
                                                                     {"oil column", "Hz"},
                                                                     {"controller band", "Hz"},
                                                                     {"angle", "rad"},
                                                                     {"angular velocity", "rad/s"},
                                                                     {"angular acceleration", "rad/s^2"}};

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
    // a line that falls ends at zero: beyond it the payload is no limit
    const double inverse = std::max((1.0 - along) / a.limit.value() + along / b.limit.value(), 0.0);
    return scaling::Acceleration::from_value(1.0 / inverse);
}

/// Overturning moment [N m] of a payload that a translation accelerates, or that a rotation turns; one of the two is zero.
double find_moment(const TableDemand& demand, const Payload& payload) {
    const double m = payload.mass.value(), h = payload.height.value(), g = scaling::kStandardGravity.value();
    const double tilt = std::sin(std::min(demand.turn.angle.value(), 0.5 * std::numbers::pi));
    return m * h * (demand.acceleration.value() + h * demand.turn.angular_acceleration.value() + g * tilt);
}

}  // namespace

TableDemand find_demand(const DriveMotion& motion, double energy_share) {
    const std::span<const double> displacement = motion.displacement.samples();
    const double acceleration = find_largest(motion.acceleration.samples());
    if (acceleration == 0.0) throw ProcessingError("the motion is zero everywhere; give a record with a motion");
    const auto [low, high] = std::minmax_element(displacement.begin(), displacement.end());
    const auto [lowest, highest] = find_band(motion.acceleration, energy_share);
    const double farthest = find_largest(displacement), half_range = 0.5 * (*high - *low);
    const double velocity = find_largest(motion.velocity.samples());
    TableDemand demand{
        .displacement = {}, .half_range = {}, .velocity = {}, .acceleration = {}, .lowest_frequency = lowest, .highest_frequency = highest};
    if (is_rotation(motion.displacement.quantity())) {
        demand.turn = {scaling::Ratio::from_value(farthest), scaling::Ratio::from_value(half_range),
                       scaling::Frequency::from_value(velocity), scaling::AngularAcceleration::from_value(acceleration)};
        return demand;
    }
    demand.displacement = farthest * scaling::si::meters;
    demand.half_range = half_range * scaling::si::meters;
    demand.velocity = velocity * scaling::si::meters_per_second;
    demand.acceleration = acceleration * scaling::si::meters_per_second_squared;
    return demand;
}

std::vector<TableDemand> find_demands(const GroundMotion& model, const DriveSettings& settings, double energy_share) {
    std::vector<TableDemand> demands;
    for (const DriveMotion& motion : make_drive_motions(model, settings)) demands.push_back(find_demand(motion, energy_share));
    if (!settings.dt) return demands;
    const std::vector<DriveMotion> motions = make_drive_motions(model, settings.at_own_step());
    for (std::size_t c = 0; c < motions.size(); ++c) {
        std::tie(demands[c].lowest_frequency, demands[c].highest_frequency) = find_band(motions[c].acceleration, energy_share);
    }
    return demands;
}

TableDemand to_model(const TableDemand& prototype, const scaling::ModelScales& scales, scaling::Shaking direction) {
    const scaling::ShakingScales motion = scales.shaking(direction);
    return {motion.displacement * prototype.displacement,
            motion.displacement * prototype.half_range,
            motion.velocity * prototype.velocity,
            motion.acceleration * prototype.acceleration,
            scales.frequency * prototype.lowest_frequency,
            scales.frequency * prototype.highest_frequency,
            {prototype.turn.angle, prototype.turn.half_range, scales.angular_velocity() * prototype.turn.angular_velocity,
             scales.angular_acceleration() * prototype.turn.angular_acceleration}};
}

TableDemand to_prototype(const TableDemand& model, const scaling::ModelScales& scales, scaling::Shaking direction) {
    const scaling::ShakingScales motion = scales.shaking(direction);
    return {model.displacement / motion.displacement,
            model.half_range / motion.displacement,
            model.velocity / motion.velocity,
            model.acceleration / motion.acceleration,
            model.lowest_frequency / scales.frequency,
            model.highest_frequency / scales.frequency,
            {model.turn.angle, model.turn.half_range, model.turn.angular_velocity / scales.angular_velocity(),
             model.turn.angular_acceleration / scales.angular_acceleration()}};
}

Payload Payload::on_model(const scaling::ModelScales& scales) const {
    if (!is_prototype) return *this;
    return {scales.mass * mass, scales.height * height, false};
}

Payload Payload::of_prototype(const scaling::ModelScales& scales) const {
    if (is_prototype) return *this;
    return {mass / scales.mass, height / scales.height, true};
}

std::string_view to_string(TableLimit limit) { return kLimits[static_cast<std::size_t>(limit)].first; }

std::string_view si_unit_name(TableLimit limit) { return kLimits[static_cast<std::size_t>(limit)].second; }

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
    if (axis.angle) add(TableLimit::angle, demand.turn.angle.value(), axis.angle->value());
    if (axis.angular_velocity) add(TableLimit::angular_velocity, demand.turn.angular_velocity.value(), axis.angular_velocity->value());
    if (axis.angular_acceleration) {
        add(TableLimit::angular_acceleration, demand.turn.angular_acceleration.value(), axis.angular_acceleration->value());
    }
    if (axis.overturning_moment) {
        add(TableLimit::overturning_moment, find_moment(demand, payload), axis.overturning_moment->value());
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

std::vector<LimitScales> find_limit_scales(const std::vector<AxisLoad>& loads, const Payload& payload, const ScalesOfLength& scales_of) {
    const scaling::Memoized<scaling::ModelScales> scales(scales_of);
    return find_limit_scales(loads, [&](const AxisLoad& load, double length) {
        return check_axis(to_model(load.prototype, scales(length), find_shaking(load.axis)), load.axis, payload.on_model(scales(length)));
    });
}

std::vector<LimitScales> find_limit_scales(const std::vector<AxisLoad>& loads, const UsesOfAxis& find_uses) {
    std::vector<LimitScales> limits;
    for (const AxisLoad& load : loads) {
        // the searches of all limits ask for the same lengths
        const scaling::Memoized<std::vector<LimitUse>> uses([&](double length) { return find_uses(load, length); });
        for (std::size_t i = 0; i < uses(1.0).size(); ++i) {
            const auto used = [&](double length) { return uses(length)[i].used(); };
            limits.push_back({load.axis.name, uses(1.0)[i].which, scaling::find_length_ranges(used, {kSmallestScale, 1.0})});
        }
    }
    return limits;
}

std::vector<ScaleRange> find_scales(const std::vector<LimitScales>& limits) {
    std::vector<std::vector<scaling::LengthRange>> ranges;
    for (const LimitScales& limit : limits) ranges.push_back(limit.ranges);
    std::vector<ScaleRange> scales;
    for (const scaling::CommonRange& common : find_common(ranges, {kSmallestScale, 1.0})) {
        ScaleRange& range = scales.emplace_back(ScaleRange{common.scales.smallest, common.scales.largest, {}, {}, {}, {}});
        if (common.binds_below) {
            range.binds_below = limits[*common.binds_below].which;
            range.axis_below = limits[*common.binds_below].axis;
        }
        if (common.binds_above) {
            range.binds_above = limits[*common.binds_above].which;
            range.axis_above = limits[*common.binds_above].axis;
        }
    }
    return scales;
}

}  // namespace musim::records
