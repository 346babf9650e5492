#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "lsdem/scene/sensors.hpp"

namespace musim::lsdem {

/// Column of a sensor's readings.
struct SensorChannel {
    const char* quantity;  ///< that it is of: "acceleration", "gap", "slip", "force", ...
    const char* label;     ///< for people: "x", "normal", "shear 1"
    const char* column;    ///< of tables, behind the sensor's name: "_ax_m_s2"
    const char* unit;      ///< SI
};

/// Channels of a kind of sensor, in the order of its readings: three components; of a joint the gap, two components of slip, the normal
/// force and two components of the shear force.
const std::vector<SensorChannel>& find_channels(SensorKind kind);

/// Readings of one sensor.
struct SensorHistory {
    std::string name;
    SensorKind kind = SensorKind::acceleration;
    SensorAxes axes = SensorAxes::world;
    std::vector<std::string> bodies;  ///< that it sits on, as people call them; of a joint two
    bool relative = false;            ///< to the base
    bool gravity = false;             ///< an acceleration is less that of gravity
    double interval = 0.0;            ///< between readings, the first of which is at t = 0 [s]
    double corner = 0.0;              ///< of its filter [Hz]; 0: none
    int order = 0;                    ///< likewise
    double delay = 0.0;               ///< of slow signals by it; readings are not shifted for it [s]
    std::vector<double> values;       ///< SI: channel c at reading k in [k·channels + c]; empty of a joint whose blocks did not touch

    std::size_t channels() const { return find_channels(kind).size(); }
    std::size_t readings() const { return values.size() / channels(); }
    double time(std::size_t reading) const { return static_cast<double>(reading) * interval; }  ///< [s]
    /// One channel by itself.
    std::vector<double> column(std::size_t channel) const;
    bool operator==(const SensorHistory&) const = default;
};

/// Largest absolute value of a channel.
struct SensorPeak {
    double value = 0.0;  ///< with its sign
    double time = 0.0;   ///< of the first reading that has it [s]
};
SensorPeak find_peak(const SensorHistory& sensor, std::size_t channel);

/// A table of sensors for a file.
struct SensorTable {
    std::string name;  ///< of the file: "sensors.csv"; where rates differ, "sensors_500Hz.csv"
    std::string csv;   ///< time and a column for each channel, SI units; each number reads back as the same double
};

/// Readings as tables, one for each rate, in the order of the sensors; of shorter histories cells are empty. None without readings.
std::vector<SensorTable> make_sensor_tables(const std::vector<SensorHistory>& sensors);

/// Description of a sensor as JSON text, all but its readings; and back. Reading throws std::runtime_error for any other text.
std::string describe_sensor(const SensorHistory& sensor);
SensorHistory parse_sensor_description(std::string_view text);

}  // namespace musim::lsdem
