#include <fmt/format.h>

#include "records/design/design.hpp"
#include "records/error.hpp"
#include "records/shake_table/shake_table.hpp"

namespace musim::records {
namespace {

/// A peak that may be left out where the axis has no limit to hold it against.
template <class Quantity>
Quantity take_peak(const std::optional<Quantity>& peak, bool is_limited, const char* key, const GivenPeaks& given,
                   const std::string& source) {
    if (is_limited && !peak) {
        throw ReadError(
            fmt::format("{}: record: {} is missing (axis {} of the table limits it); add it to the peaks", source, key, given.axis));
    }
    return peak.value_or(Quantity{});
}

/// The axis of the table that peaks name; the error says where they stand.
const TableAxis& find_axis(const ShakeTable& table, const GivenPeaks& given, const std::string& source) {
    try {
        return table.find_axis(given.axis);
    } catch (const ReadError& error) {
        throw error.seen_from<ReadError>(source + ": record: peaks: axis");
    }
}

}  // namespace

std::vector<AxisLoad> make_loads(const GroundMotion& motion, const RecordFile& record, const ShakeTable& table) {
    const AssignedAxes assigned = assign_axes(motion, table, record.axes);
    const DriveSettings settings{.high_pass = record.high_pass};
    const std::vector<TableDemand> demands = find_demands(assigned.motion, settings, table.energy_share);
    std::vector<AxisLoad> loads;
    for (std::size_t i = 0; i < demands.size(); ++i) loads.push_back({assigned.axes[i], demands[i]});
    return loads;
}

std::vector<AxisLoad> make_loads(const std::vector<GivenPeaks>& peaks, const ShakeTable& table, const std::string& source) {
    std::vector<AxisLoad> loads;
    for (const GivenPeaks& given : peaks) {
        const TableAxis& axis = find_axis(table, given, source);
        const auto displacement = take_peak(given.displacement, axis.displacement.has_value(), "displacement", given, source);
        const auto velocity = take_peak(given.velocity, axis.velocity.has_value(), "velocity", given, source);
        const auto lowest = take_peak(given.lowest_frequency, axis.lowest_frequency.has_value(), "lowest_frequency", given, source);
        const bool is_upper_limited = axis.highest_frequency || axis.oil_column || axis.controller_rate;
        const auto highest = take_peak(given.highest_frequency, is_upper_limited, "highest_frequency", given, source);
        const bool needs_angle = axis.angle || (axis.is_rotation && axis.overturning_moment);
        const auto angle = take_peak(given.angle, needs_angle, "angle", given, source);
        const auto rate = take_peak(given.angular_velocity, axis.angular_velocity.has_value(), "angular_velocity", given, source);
        const auto turned = given.angular_acceleration.value_or(scaling::AngularAcceleration{});
        loads.push_back({axis, {displacement, displacement, velocity, given.acceleration, lowest, highest, {angle, angle, rate, turned}}});
    }
    return loads;
}

}  // namespace musim::records
