#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "records/time_series.hpp"
#include "records/utc_time.hpp"

namespace musim::records {

/// Below this, uncorrected accelerograms hold drift and noise; the usual corner for strong motion [Hz] (docs/theory/records.md).
inline constexpr double kUncorrectedCornerHz = 0.05;

/// One channel of a record.
struct Component {
    std::string name = {};                   ///< as the file names it: "360", "Up", "H1"; columns without a title are "1", "2", ...
    std::optional<double> azimuth_deg = {};  ///< direction of positive motion, clockwise from north [deg]; unknown or vertical: nothing
    TimeSeries series;                       ///< with its own length, start and time step
    bool up = false;                         ///< the file says that it is vertical, whatever its name
};

/// Format of columns of numbers.
inline constexpr std::string_view kTextFormat = "text";

/// A recorded or made ground motion: its channels and where they come from.
struct GroundMotion {
    std::string source = {};  ///< file it was read from, for messages; empty when made
    std::string format = {};  ///< "PEER AT2", "CSMIP V1", ...
    std::string event = {};
    std::string station = {};
    std::vector<Component> components = {};
    std::optional<UtcTime> time_zero = {};  ///< what the clocks of all components count from, where the file has it; see TimeSeries::start

    /// Set for uncorrected records, whose slow drift is noise: high-pass at this corner before integrating. Nothing: integrate as it is.
    std::optional<scaling::Frequency> integration_corner = {};

    std::vector<std::string> history = {};  ///< what was done to the samples since the file, oldest first

    /// The component called `name`; case and leading zeros do not matter ("up", "090" for "90"). Those of plain text, which their titles
    /// name, are found by their number, too: "1" is the first.
    /// Throws ReadError when there is none or several; the message lists those present.
    const Component& find_component(std::string_view name) const;

    /// Names of all components, "90, 360, Up".
    std::string component_names() const;
};

/// Azimuth a component's name stands for: "360" → 360, "N" → 0, "E" → 90; nothing for "Up", "H1" and the like.
/// Names that are plain column numbers look the same, so only readers of formats that name directions ask.
std::optional<double> find_azimuth_deg(std::string_view component_name);

/// Whether a component's samples are an angle, its rate or acceleration.
bool is_rotation(const Component& component);

/// Whether a name is that of a rotation, as tables and records have them: roll, pitch, yaw, rx, rot_z, theta_x, and SEED's channels of
/// rotational seismometers (instrument J: HJE, BJ1).
bool is_named_as_rotation(std::string_view name);

/// Whether a component's file or name says that it is vertical, and it is no rotation: "Up", "UD", "Z", "V", "HNZ", "Vertical", "UD2", ...
bool is_vertical(const Component& component);

}  // namespace musim::records
