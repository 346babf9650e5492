#include "records/formats/write_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "records/atomic_file.hpp"
#include "records/formats/detail/parsers.hpp"
#include "records/headers/own_titles.hpp"

namespace musim::records {
namespace {

// header texts are one line; commas part cells and names
std::string one_line(std::string_view text, bool keep_commas) {
    std::string line(text);
    std::replace_if(
        line.begin(), line.end(), [&](char letter) { return (letter >= 0 && letter < ' ') || (letter == ',' && !keep_commas); }, ' ');
    return line;
}

struct PeerUnit {
    std::string_view title;
    std::string_view unit;
};

PeerUnit peer_unit(SampleQuantity quantity) {
    constexpr std::array<PeerUnit, 3> kPeerUnits{{{"ACCELERATION", "G"}, {"VELOCITY", "CM/S"}, {"DISPLACEMENT", "CM"}}};
    return kPeerUnits.at(static_cast<std::size_t>(quantity));
}

/// The same text of all components' quantities, once, or of each.
std::string list_of_quantities(const GroundMotion& motion, std::string_view (*text_of)(SampleQuantity)) {
    const SampleQuantity first = motion.components.front().series.quantity();
    const bool is_one = std::all_of(motion.components.begin(), motion.components.end(),
                                    [&](const Component& component) { return component.series.quantity() == first; });
    std::string list(text_of(first));
    for (std::size_t i = 1; !is_one && i < motion.components.size(); ++i)
        list += ',' + std::string(text_of(motion.components[i].series.quantity()));
    return list;
}

void require_common_clock(const std::filesystem::path& path, const GroundMotion& motion) {
    if (motion.components.empty()) throw WriteError(fmt::format("{}: record has no components; nothing to write", path.string()));
    const TimeSeries& first = motion.components.front().series;
    for (const Component& component : motion.components) {
        const TimeSeries& series = component.series;
        const bool is_beside = series.quantity() == first.quantity() || is_rotation(series.quantity()) != is_rotation(first.quantity());
        if (is_beside && series.start() == first.start() && series.dt() == first.dt()) continue;
        throw WriteError(
            fmt::format("{}: component '{}' differs from '{}' in quantity, start or time step (columns share one clock); "
                        "write them to separate files",
                        path.string(), component.name, motion.components.front().name));
    }
}

std::string csv_header(const GroundMotion& motion) {
    const TimeSeries& first = motion.components.front().series;
    std::string text =
        fmt::format("{}\n# event: {}\n# station: {}\n# quantity: {}\n# unit: {}\n# start_s: {}\n# dt_s: {}\n", detail::kMusimCsvTitle,
                    one_line(motion.event, true), one_line(motion.station, true), list_of_quantities(motion, &to_string),
                    list_of_quantities(motion, &si_unit_name), first.start().value(), first.dt().value());
    if (motion.time_zero) text += fmt::format("# time_zero_utc: {}\n", to_string(*motion.time_zero));
    if (motion.integration_corner) text += fmt::format("# integration_corner_hz: {}\n", motion.integration_corner->value());
    for (const std::string& step : motion.history) text += fmt::format("# history: {}\n", one_line(step, true));

    std::string azimuths;
    std::string names = "time_s";
    for (const Component& component : motion.components) {
        if (&component != &motion.components.front()) azimuths += ',';
        if (component.azimuth_deg) azimuths += fmt::format("{}", *component.azimuth_deg);
        if (component.up) azimuths += detail::kUp;
        names += ',' + one_line(component.name, false);
    }
    return text + fmt::format("# azimuths_deg: {}\n{}\n", azimuths, names);
}

}  // namespace

void refuse_rotation(const std::filesystem::path& path, const Component& component, std::string_view format) {
    if (!is_rotation(component)) return;
    throw WriteError(fmt::format("{}: {} hold no rotations (component {} is {}); write CSV", path.string(), format, component.name,
                                 to_string(component.series.quantity())));
}

void write_at2(const std::filesystem::path& path, const GroundMotion& motion, std::string_view component_name) {
    const Component& component = motion.find_component(component_name);
    const TimeSeries& series = component.series;
    refuse_rotation(path, component, "PEER files");
    const auto& [title, unit] = peer_unit(series.quantity());
    const double si = find_sample_unit(unit)->si;

    std::string text =
        fmt::format("PEER FORMAT TIME SERIES, WRITTEN BY MUSIM\n{}, {}, {}\n{} TIME SERIES IN UNITS OF {}", one_line(motion.event, true),
                    one_line(motion.station, false), one_line(component.name, false), title, unit);
    if (motion.integration_corner) text += fmt::format(", {}= {} HZ", detail::kCornerTitle, motion.integration_corner->value());
    if (series.start().value() != 0.0) text += fmt::format(", {}= {} SEC", detail::kStartTitle, series.start().value());
    text += '\n';
    text += fmt::format("NPTS= {:6}, DT= {:#} SEC\n", series.size(), series.dt().value());
    constexpr std::size_t kPerLine = 5;
    for (std::size_t i = 0; i < series.size(); ++i) {
        const bool ends_line = i % kPerLine == kPerLine - 1 || i + 1 == series.size();
        fmt::format_to(std::back_inserter(text), "{:25.16E}{}", series.samples()[i] / si, ends_line ? "\n" : "");
    }
    write_file_atomically(path, text);
}

void write_csv(const std::filesystem::path& path, const GroundMotion& motion) {
    require_common_clock(path, motion);
    std::string text = csv_header(motion);
    std::size_t rows = 0;
    for (const Component& component : motion.components) rows = std::max(rows, component.series.size());
    for (std::size_t row = 0; row < rows; ++row) {
        auto out = fmt::format_to(std::back_inserter(text), "{:.17g}", motion.components.front().series.time(row).value());
        for (const Component& component : motion.components) {
            if (row < component.series.size()) {
                fmt::format_to(out, ",{:.17g}", component.series.samples()[row]);
            } else {
                text += ',';
            }
        }
        text += '\n';
    }
    write_file_atomically(path, text);
}

}  // namespace musim::records
