#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "records/ground_motion.hpp"
#include "records/sample_unit.hpp"
#include "scaling/laws/model_scales.hpp"
#include "scaling/uncertainty/uncertain_reading.hpp"
#include "scaling/units.hpp"

/// A shake table as data: what it can do, and what its controller reads.
namespace musim::records {

/// The largest acceleration with a specimen of some mass on the table.
struct PayloadLimit {
    scaling::Mass payload;
    scaling::Acceleration limit;
};

/// The resonance of the oil column in the actuators: what lies above cannot be followed.
struct OilColumn {
    scaling::Frequency frequency;  ///< of the bare table
    double share = 1.0;            ///< of the frequency that can be used [-]
};

/// Limits of the table in one direction, or about one; what is not limited is not there.
struct TableAxis {
    std::string name;
    bool is_rotation = false;                          ///< by its name: roll (about x), pitch (about y), yaw (about z), rx, ry, rz, ...
    std::optional<scaling::Length> displacement = {};  ///< to either side of the middle: half the stroke
    std::optional<scaling::Velocity> velocity = {};
    std::vector<PayloadLimit> acceleration = {};  ///< by increasing payload
    std::optional<scaling::Force> force = {};     ///< of all actuators along the axis
    std::optional<scaling::Mass> moving_mass = {};
    std::optional<scaling::Moment> overturning_moment = {};
    std::optional<scaling::Mass> payload = {};
    std::optional<scaling::Frequency> lowest_frequency = {}, highest_frequency = {};
    std::optional<OilColumn> oil_column = {};
    std::optional<scaling::Frequency> controller_rate = {};  ///< the table's: samples a second
    std::optional<scaling::Ratio> angle = {};                ///< of a rotation, to either side of the middle [rad]
    std::optional<scaling::Frequency> angular_velocity = {};
    std::optional<scaling::AngularAcceleration> angular_acceleration = {};
};

/// Quantity of a column of a drive file; of an axis that is a rotation the angle, the angular velocity or the angular acceleration.
enum class DriveColumn { time, displacement, velocity, acceleration };

/// The file that the controller of a table reads: text, one row a sample.
struct ControllerFormat {
    scaling::Frequency rate;    ///< samples a second
    scaling::Time rest = {};    ///< before and after the motion
    SampleUnit displacement{};  ///< units of the columns; time is in seconds
    SampleUnit velocity{};
    SampleUnit acceleration{};
    SampleUnit angle{};  ///< and those of rotations
    SampleUnit angular_velocity{};
    SampleUnit angular_acceleration{};
    std::vector<DriveColumn> columns{DriveColumn::time, DriveColumn::displacement, DriveColumn::velocity, DriveColumn::acceleration};
    char separator = ',';
    bool header = true;  ///< a first row with names and units
    int digits = 9;
};

struct ShakeTable {
    std::string name, source;
    std::vector<TableAxis> axes;
    double energy_share = 0.99;  ///< of ∫a² dt that must lie within the frequencies the table can follow, at either end of them
    std::optional<ControllerFormat> controller = {};

    /// Throws ReadError, listing those there are, when no axis is called `name`.
    const TableAxis& find_axis(std::string_view name) const;
};

/// Reads {"schema": "musim-table/1", "name", "source", "energy_share": 0.99, "axes": [{"names": ["x", "y"], "displacement": "75 mm",
/// "velocity": "80 cm/s", "acceleration": "1.5 g" or [{"payload": "5 t", "limit": "1.5 g"}, ...], "force", "moving_mass",
/// "overturning_moment", "payload", "lowest_frequency", "highest_frequency", "oil_column": {"frequency", "share"}}, {"names": ["roll",
/// "pitch", "yaw"], "angle": "5 deg", "angular_velocity": "30 deg/s", "angular_acceleration": "200 deg/s^2", "overturning_moment",
/// "payload", "lowest_frequency", "highest_frequency"}, ...], "controller": {"rate", "rest", "displacement": "mm", "velocity": "mm/s",
/// "acceleration": "g", "angle": "deg", "angular_velocity", "angular_acceleration", "columns": ["time", ...],
/// "separator": "comma" | "tab" | "space", "header", "digits"}}. Quantities are text with a unit. A force and an oil column need the moving
/// mass; an axis that is a rotation (is_named_as_rotation) must be limited in all of angle, velocity and acceleration, or in none. Throws
/// ReadError `source: place: what (why); what to do` for anything else, unknown keys, limits that are not positive, names that come twice
/// and limits of translations of a rotation, or the other way round, included. `reading` takes limits and masses with standard
/// uncertainties (scaling/uncertain.hpp), which are refused without it.
ShakeTable parse_shake_table(std::string_view json, const std::string& source, scaling::UncertainReading* reading = nullptr);

/// The components of a record that a table is to make, and the axis that makes each.
struct AssignedAxes {
    GroundMotion motion;
    std::vector<TableAxis> axes;  ///< one for each component of `motion`
};

/// Picks components and axes as `wanted` says: (component, axis) pairs. Without any, all components: vertical ones (named Up, UD, Z, HNZ
/// and the like) go to the axis called "z" or "vertical", the others to the other axes in turn; rotations to the axis about the same
/// direction (rx and roll, ry and pitch, rz and yaw), or to the axes that are rotations in turn. Throws ReadError for a name that there is
/// not, an axis that is to make two components, a rotation for a translation or the other way round, and when the table has too few axes.
AssignedAxes assign_axes(const GroundMotion& motion, const ShakeTable& table,
                         const std::vector<std::pair<std::string, std::string>>& wanted);

/// Whether an axis is called "z" or "vertical".
bool is_vertical_axis(const TableAxis& axis);

/// Direction x, y or z that a rotation of this name turns about: rx and roll about x, ry and pitch about y, rz and yaw about z, and by a
/// last letter x, y or z; nothing for another name.
std::optional<char> find_turned_axis(std::string_view name);

/// Which way an axis shakes, by is_vertical_axis().
scaling::Shaking find_shaking(const TableAxis& axis);

}  // namespace musim::records
