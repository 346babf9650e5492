#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>

#include "lsdem/report/report.hpp"
#include "lsdem/report/report_figure.hpp"

namespace musim::lsdem {
namespace {

/// Sensors that are drawn; all are in the table.
constexpr std::size_t kMostDrawn = 12;

/// Body of a sensor, its axes and what it reads.
std::string describe_place(const SensorHistory& sensor) {
    if (sensor.kind == SensorKind::joint) return fmt::format("{} against {}", sensor.bodies.front(), sensor.bodies.back());
    return fmt::format("{}, axes of the {}{}{}", sensor.bodies.front(), kSensorAxes.at(static_cast<std::size_t>(sensor.axes)),
                       sensor.relative ? ", relative to the base" : "", sensor.gravity ? ", less gravity" : "");
}

std::string describe_filter(const SensorHistory& sensor) {
    if (sensor.order == 0) return "none";
    return fmt::format("{:.4g} Hz, {} poles, {:.3g} s late", sensor.corner, sensor.order, sensor.delay);
}

/// The channels of one unit of a sensor over time.
ReportFigure make_sensor_figure(const SensorHistory& sensor, std::size_t first, std::size_t last, std::size_t number) {
    const std::vector<SensorChannel>& channels = find_channels(sensor.kind);
    const bool is_joint = sensor.kind == SensorKind::joint;
    std::string what = is_joint ? (first == 0 ? "gap and slip" : "force") : kSensorKinds.at(static_cast<std::size_t>(sensor.kind));
    std::replace(what.begin(), what.end(), '_', ' ');
    LinePlot plot{.title = fmt::format("{}: {}", sensor.name, what),
                  .subtitle = describe_place(sensor),
                  .x_label = "t [s]",
                  .y_label = fmt::format("{} [{}]", what, channels[first].unit)};
    std::vector<double> time;
    for (std::size_t k = 0; k < sensor.readings(); ++k) time.push_back(sensor.time(k));
    for (std::size_t c = first; c < last; ++c) plot.series.push_back({.label = channels[c].label, .x = time, .y = sensor.column(c)});
    std::string name = fmt::format("sensor_{}_{}{}", number + 1, sensor.name, is_joint && first > 0 ? "_force" : "");
    std::replace_if(
        name.begin(), name.end(), [](unsigned char letter) { return std::isalnum(letter) == 0; }, '_');
    ReportFigure figure = make_figure(name, plot);
    figure.seconds_per_x = 1.0;
    return figure;
}

}  // namespace

std::optional<ReportSection> make_sensor_section(const std::vector<ReportedRun>& runs) {
    ReportSection section{.id = "sensors", .title = "Sensors"};
    HtmlTable table{.caption = "Peaks of sensors, with their sign",
                    .heads = {"sensor", "run", "on", "channel", "peak", "unit", "at [s]", "rate [Hz]", "filter"}};
    for (const ReportedRun& run : runs) {
        for (const SensorHistory& sensor : run.run.sensors) {
            const std::vector<SensorChannel>& channels = find_channels(sensor.kind);
            for (std::size_t c = 0; c < channels.size() && !sensor.values.empty(); ++c) {
                const SensorPeak peak = find_peak(sensor, c);
                table.rows.push_back({{.text = sensor.name},
                                      {.text = run.label},
                                      {.text = describe_place(sensor)},
                                      {.text = channels[c].label},
                                      number_cell(peak.value),
                                      {.text = channels[c].unit},
                                      number_cell(peak.time),
                                      number_cell(1.0 / sensor.interval),
                                      {.text = describe_filter(sensor)}});
            }
        }
    }
    if (table.rows.empty()) return std::nullopt;
    section.html = to_html(table);
    const std::vector<SensorHistory>& sensors = runs.front().run.sensors;
    for (std::size_t s = 0; s < std::min(sensors.size(), kMostDrawn); ++s) {
        if (sensors[s].values.empty()) continue;
        const std::size_t channels = sensors[s].channels(), half = std::size_t{3};
        section.figures.push_back(make_sensor_figure(sensors[s], 0, half, s));
        if (channels > half) section.figures.push_back(make_sensor_figure(sensors[s], half, channels, s));
    }
    return section;
}

}  // namespace musim::lsdem
