#include "lsdem/results/sensor_history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace musim::lsdem {
namespace {

std::vector<SensorChannel> make_components(const char* quantity, const std::array<const char*, 3>& columns, const char* unit) {
    return {{quantity, "x", columns[0], unit}, {quantity, "y", columns[1], unit}, {quantity, "z", columns[2], unit}};
}

/// Position of a word in a list of them.
template <class Choice, std::size_t Count>
Choice find_choice(const std::array<const char*, Count>& names, const std::string& word) {
    const auto* found = std::find(names.begin(), names.end(), word);
    if (found == names.end()) throw std::runtime_error(fmt::format("\"{}\" is not known", word));
    return static_cast<Choice>(found - names.begin());
}

/// Sensors of one rate as CSV.
std::string make_csv(const std::vector<const SensorHistory*>& sensors) {
    std::string csv = "time_s";
    std::size_t readings = 0;
    for (const SensorHistory* sensor : sensors) {
        readings = std::max(readings, sensor->readings());
        for (const SensorChannel& channel : find_channels(sensor->kind)) csv += "," + sensor->name + channel.column;
    }
    csv += '\n';
    for (std::size_t k = 0; k < readings; ++k) {
        fmt::format_to(std::back_inserter(csv), "{}", sensors.front()->time(k));
        for (const SensorHistory* sensor : sensors) {
            for (std::size_t c = 0; c < sensor->channels(); ++c) {
                csv += ',';
                if (k < sensor->readings()) fmt::format_to(std::back_inserter(csv), "{}", sensor->values[k * sensor->channels() + c]);
            }
        }
        csv += '\n';
    }
    return csv;
}

}  // namespace

const std::vector<SensorChannel>& find_channels(SensorKind kind) {
    static const std::array<std::vector<SensorChannel>, kSensorKinds.size()> kChannels{
        make_components("acceleration", {"_ax_m_s2", "_ay_m_s2", "_az_m_s2"}, "m/s^2"),
        make_components("velocity", {"_vx_m_s", "_vy_m_s", "_vz_m_s"}, "m/s"),
        make_components("displacement", {"_dx_m", "_dy_m", "_dz_m"}, "m"),
        make_components("rotation", {"_rx_rad", "_ry_rad", "_rz_rad"}, "rad"),
        make_components("angular_velocity", {"_wx_rad_s", "_wy_rad_s", "_wz_rad_s"}, "rad/s"),
        std::vector<SensorChannel>{{"gap", "gap", "_gap_m", "m"},
                                   {"slip", "slip 1", "_slip1_m", "m"},
                                   {"slip", "slip 2", "_slip2_m", "m"},
                                   {"force", "normal force", "_normal_N", "N"},
                                   {"force", "shear force 1", "_shear1_N", "N"},
                                   {"force", "shear force 2", "_shear2_N", "N"}}};
    return kChannels.at(static_cast<std::size_t>(kind));
}

std::vector<double> SensorHistory::column(std::size_t channel) const {
    std::vector<double> one;
    one.reserve(readings());
    for (std::size_t k = 0; k < readings(); ++k) one.push_back(values[k * channels() + channel]);
    return one;
}

SensorPeak find_peak(const SensorHistory& sensor, std::size_t channel) {
    SensorPeak peak;
    for (std::size_t k = 0; k < sensor.readings(); ++k) {
        const double value = sensor.values[k * sensor.channels() + channel];
        if (std::abs(value) > std::abs(peak.value)) peak = {value, sensor.time(k)};
    }
    return peak;
}

std::vector<SensorTable> make_sensor_tables(const std::vector<SensorHistory>& sensors) {
    std::vector<std::vector<const SensorHistory*>> by_rate;
    for (const SensorHistory& sensor : sensors) {
        if (sensor.values.empty()) continue;
        const auto same =
            std::find_if(by_rate.begin(), by_rate.end(), [&](const auto& others) { return others.front()->interval == sensor.interval; });
        (same == by_rate.end() ? by_rate.emplace_back() : *same).push_back(&sensor);
    }
    std::vector<SensorTable> tables;
    for (const auto& of_rate : by_rate) {
        std::string name = "sensors.csv";
        if (by_rate.size() > 1) name = fmt::format("sensors_{:.6g}Hz.csv", 1.0 / of_rate.front()->interval);
        const auto is_taken = [&](const SensorTable& table) { return table.name == name; };
        // rates that differ by less than six digits
        for (int k = 2; std::any_of(tables.begin(), tables.end(), is_taken); ++k) {
            name = fmt::format("sensors_{:.6g}Hz_{}.csv", 1.0 / of_rate.front()->interval, k);
        }
        tables.push_back({name, make_csv(of_rate)});
    }
    return tables;
}

std::string describe_sensor(const SensorHistory& sensor) {
    nlohmann::ordered_json json{{"name", sensor.name},
                                {"kind", kSensorKinds.at(static_cast<std::size_t>(sensor.kind))},
                                {"axes", kSensorAxes.at(static_cast<std::size_t>(sensor.axes))},
                                {"bodies", sensor.bodies},
                                {"relative", sensor.relative},
                                {"gravity", sensor.gravity},
                                {"interval_s", sensor.interval},
                                {"filter_corner_hz", sensor.corner},
                                {"filter_order", sensor.order},
                                {"filter_delay_s", sensor.delay}};
    return json.dump();
}

SensorHistory parse_sensor_description(std::string_view text) {
    try {
        const nlohmann::json json = nlohmann::json::parse(text);
        SensorHistory sensor;
        sensor.name = json.at("name");
        sensor.kind = find_choice<SensorKind>(kSensorKinds, json.at("kind"));
        sensor.axes = find_choice<SensorAxes>(kSensorAxes, json.at("axes"));
        sensor.bodies = json.at("bodies").get<std::vector<std::string>>();
        sensor.relative = json.at("relative");
        sensor.gravity = json.at("gravity");
        sensor.interval = json.at("interval_s");
        sensor.corner = json.at("filter_corner_hz");
        sensor.order = json.at("filter_order");
        sensor.delay = json.at("filter_delay_s");
        if (!(std::isfinite(sensor.interval) && sensor.interval > 0.0)) throw std::runtime_error("its readings have no interval");
        return sensor;
    } catch (const nlohmann::json::exception& error) {
        throw std::runtime_error(error.what());
    }
}

}  // namespace musim::lsdem
