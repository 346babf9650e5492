#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "records/shake_table/drive_motion.hpp"
#include "records/shake_table/shake_table.hpp"
#include "scaling/laws/length_range.hpp"
#include "scaling/laws/model_scales.hpp"

/// Whether a shake table can make a motion.
namespace musim::records {

/// Frequency up to which a motion at some sampling rate is left as it is by resample(), over that rate: 0.9 of 0.95 of a half.
inline constexpr double kFollowedShare = 0.9 * 0.95 * 0.5;

/// Demand of a rotation.
struct TurnDemand {
    scaling::Ratio angle{};                               ///< largest, to either side of where it starts [rad]
    scaling::Ratio half_range{};                          ///< as that of displacements
    scaling::Frequency angular_velocity{};                ///< largest
    scaling::AngularAcceleration angular_acceleration{};  ///< largest
};

/// Demand of a motion on a table.
struct TableDemand {
    scaling::Length displacement;          ///< largest, to either side of where it starts
    scaling::Length half_range;            ///< half of what lies between the farthest points: what is needed from the best start
    scaling::Velocity velocity;            ///< largest
    scaling::Acceleration acceleration;    ///< largest
    scaling::Frequency lowest_frequency;   ///< above it lies ShakeTable::energy_share of ∫a² dt
    scaling::Frequency highest_frequency;  ///< below it lies as much
    TurnDemand turn = {};                  ///< of a rotation, whose displacement, velocity and acceleration are zero
};

/// Throws ProcessingError for a motion that is zero everywhere.
TableDemand find_demand(const DriveMotion& motion, double energy_share);

/// Demands of each component of a model's record, changed as `settings` say: its peaks at the step of the controller, its frequencies
/// before that step takes any away. Throws ProcessingError as the steps do.
std::vector<TableDemand> find_demands(const GroundMotion& model, const DriveSettings& settings, double energy_share);

/// The demand of the model's motion in one direction, from the prototype's; and back.
TableDemand to_model(const TableDemand& prototype, const scaling::ModelScales& scales,
                     scaling::Shaking direction = scaling::Shaking::horizontal);
TableDemand to_prototype(const TableDemand& model, const scaling::ModelScales& scales,
                         scaling::Shaking direction = scaling::Shaking::horizontal);

/// Payload on the table.
struct Payload {
    scaling::Mass mass;
    scaling::Length height;     ///< of its centre of mass above the platen
    bool is_prototype = false;  ///< mass and height are the prototype's, and scale as masses and heights do

    /// Payload of the model.
    Payload on_model(const scaling::ModelScales& scales) const;

    /// Payload of the prototype of which the model has this one by these scales: models of other lengths have another.
    Payload of_prototype(const scaling::ModelScales& scales) const;
};

enum class TableLimit {
    displacement,
    velocity,
    acceleration,
    force,
    overturning_moment,
    payload,
    lowest_frequency,
    highest_frequency,
    oil_column,
    controller_band,
    angle,
    angular_velocity,
    angular_acceleration,
};

/// "displacement", "velocity", ..., "oil column".
std::string_view to_string(TableLimit limit);
/// "m", "m/s", ..., "Hz".
std::string_view si_unit_name(TableLimit limit);

/// Use of a limit.
struct LimitUse {
    TableLimit which;
    double demand, limit;  ///< [SI unit of the limit]

    /// demand/limit; for the lowest frequency limit/demand. Above 1 the table cannot do it.
    double used() const { return which == TableLimit::lowest_frequency ? limit / demand : demand / limit; }
};

/// All limits of an axis, with a model (not a prototype) as payload:
///   force (M + m) a and overturning moment m h a of a payload m that moves with the table of mass M;
///   acceleration between the payloads given: straight lines of 1/a over m (a force that is constant moves mass at a ∝ 1/m), beyond the
///   last as between the last two;
///   oil column: the share of its frequency on the bare table, times √(M/(M + m)) [ConteTrombetti00];
///   controller band: the frequencies that resample() keeps at its rate, kFollowedShare of it.
/// An axis that is a rotation has angle, angular velocity and angular acceleration α, the frequencies and the payload; its overturning
/// moment about the axis, which lies in the platen, is m h (h α + g sin θ) of a payload in a point at the height h: in a turn to and fro
/// the peaks come together. Moments of different axes are not added.
std::vector<LimitUse> check_axis(const TableDemand& demand, const TableAxis& axis, const Payload& payload);

/// Load of one component of a record, in its prototype form, on one axis.
struct AxisLoad {
    TableAxis axis;
    TableDemand prototype;
};

/// Length scales between kSmallestScale and 1 at which one limit of an axis holds, by rising λ_l.
struct LimitScales {
    std::string axis;
    TableLimit which;
    std::vector<scaling::LengthRange> ranges;
};

/// Length scales at which all limits hold.
struct ScaleRange {
    double smallest, largest;                            ///< λ_l
    std::optional<TableLimit> binds_below, binds_above;  ///< the governing limit beyond; nothing: the end of the search
    std::string axis_below, axis_above;
};

/// Where the search for length scales ends: λ_l from kSmallestScale to 1.
inline constexpr double kSmallestScale = 1.0 / 16384.0;

/// Uses of each limit of an axis by a model of length scale λ_l.
using UsesOfAxis = std::function<std::vector<LimitUse>(const AxisLoad&, double length)>;

/// The factors of a model of length scale λ_l, by any law.
using ScalesOfLength = std::function<scaling::ModelScales(double length)>;

/// Scales of each limit of each axis by itself, as scaling::find_length_ranges() does. An axis called z or vertical shakes vertically.
/// Throws what `scales_of` throws.
std::vector<LimitScales> find_limit_scales(const std::vector<AxisLoad>& loads, const Payload& payload, const ScalesOfLength& scales_of);

/// The same for models that `find_uses` judges, as those whose heights and widths scale apart; throws what it throws.
std::vector<LimitScales> find_limit_scales(const std::vector<AxisLoad>& loads, const UsesOfAxis& find_uses);

/// All ranges of λ_l between kSmallestScale and 1 at which the table can do it, by rising λ_l.
std::vector<ScaleRange> find_scales(const std::vector<LimitScales>& limits);

}  // namespace musim::records
