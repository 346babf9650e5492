#include "records/shake_table/table_check.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "records/measures/measures.hpp"
#include "records/shake_table/shake_table.hpp"
#include "scaling/memoized.hpp"

namespace musim::records {
namespace {

/// Name and SI unit, in the order of TableLimit.
constexpr std::pair<std::string_view, std::string_view> kLimits[] = {
    {"displacement", "m"}, {"velocity", "m/s"},        {"acceleration", "m/s^2"},   {"force", "N"},       {"overturning moment", "N m"},
    {"payload", "kg"},     {"lowest frequency", "Hz"}, {"highest frequency", "Hz"}, {"oil column", "Hz"}, {"controller band", "Hz"}};

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
    const std::vector<DriveMotion> motions = make_drive_motions(model, settings.at_own_step());
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
