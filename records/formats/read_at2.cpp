#include <fmt/format.h>

#include <array>

#include "records/detail/text.hpp"
#include "records/formats/detail/parsers.hpp"
#include "records/formats/detail/table.hpp"
#include "records/headers/own_titles.hpp"

namespace musim::records::detail {
namespace {

struct At2Header {
    std::size_t counts_line = 0;  ///< index of the line with NPTS and DT
    std::size_t count = 0;        ///< NPTS
    scaling::Time dt;
    std::optional<SampleUnit> unit;
    std::optional<scaling::Frequency> integration_corner;
    scaling::Time start;
    std::string event;
    std::string station;
    std::string component;
};

constexpr std::string_view kSeparators = " \t,=:";

// token after `name`, e.g. "8000" in "NPTS= 8000, DT= .005"
std::string_view value_after(std::string_view line, std::string_view name) {
    std::string_view rest = line.substr(find_ignoring_case(line, name) + name.size());
    return take_token(rest, kSeparators);
}

// "NPTS= 8000, DT= .0050 SEC" or "8000 0.0050 NPTS, DT"
void read_counts(const TextFile& file, At2Header& header) {
    const std::string_view line = file.line(header.counts_line);
    if (!contains_ignoring_case(line, "DT")) {
        file.fail(header.counts_line, "time step is missing (no DT beside NPTS)", "write 'NPTS= n, DT= seconds SEC'");
    }
    std::string_view rest = line;
    std::string_view count = take_token(rest, kSeparators);
    std::string_view dt = take_token(rest, kSeparators);
    const bool names_first = find_ignoring_case(count, "NPTS") == 0;
    if (names_first) {
        count = value_after(line, "NPTS");
        dt = value_after(line, "DT");
    }

    header.count = checked_count(file, header.counts_line, count, "correct NPTS");
    const std::optional<double> seconds = parse_real(dt);
    if (!seconds) {
        file.fail(header.counts_line, fmt::format("time step {} is no number (seconds needed)", quoted(dt)), "correct DT");
    }
    header.dt = checked_dt(file, header.counts_line, *seconds);
}

// "ACCELERATION TIME SERIES IN UNITS OF G. FILTER ..." or "The units are (g)"; musim's own give an integration corner and a start
// time behind the unit
void read_unit(const TextFile& file, std::size_t index, At2Header& header) {
    if (const auto corner = find_integration_corner(file, index)) header.integration_corner = corner;
    if (const auto start = find_start_time(file, index)) header.start = *start;
    const std::string_view line = file.line(index);
    for (const std::string_view phrase : {std::string_view("UNITS OF"), std::string_view("UNITS ARE"), std::string_view("UNITS="),
                                          std::string_view("UNITS ="), std::string_view("UNITS:")}) {
        if (!contains_ignoring_case(line, phrase)) continue;
        const std::string_view name = value_after(line, phrase);
        header.unit = find_sample_unit(name);
        if (!header.unit || is_rotation(header.unit->quantity)) {
            file.fail(index, fmt::format("unit {} is unknown (known: {})", quoted(name), sample_unit_names()), "correct the unit line");
        }
    }
}

// "Loma Prieta, 10/18/1989, Corralitos, 90" → event, station and component; a remark "(USGS STATION 117)" at the end is dropped
void read_names(std::string_view line, At2Header& header) {
    if (line.ends_with(')')) line = trim(line.substr(0, line.rfind('(')));
    const std::size_t last = line.rfind(',');
    if (last == std::string_view::npos || last == 0) {
        header.event = trim(line);
        return;
    }
    header.component = trim(line.substr(last + 1));
    const std::size_t before_last = line.rfind(',', last - 1);
    const std::size_t station_start = before_last == std::string_view::npos ? 0 : before_last + 1;
    header.station = trim(line.substr(station_start, last - station_start));
    header.event = before_last == std::string_view::npos ? std::string_view{} : trim(line.substr(0, before_last));
}

At2Header read_header(const TextFile& file) {
    At2Header header;
    while (header.counts_line < file.size() && !contains_ignoring_case(file.line(header.counts_line), "NPTS")) {
        read_unit(file, header.counts_line, header);
        ++header.counts_line;
    }
    if (header.counts_line == file.size()) file.fail("header has no NPTS line (is it a PEER file?)", "check the file");
    read_counts(file, header);
    read_unit(file, header.counts_line, header);

    // PEER's second of four lines names the record; free-text headers name the event first
    constexpr std::size_t kPeerCountsLine = 3;
    if (header.counts_line > 0) read_names(file.line(header.counts_line == kPeerCountsLine ? 1 : 0), header);
    if (header.component.empty()) header.component.push_back('1');
    return header;
}

// values end at the file's end or at a trailer of asterisks
std::vector<double> read_samples(const TextFile& file, const At2Header& header, double si) {
    std::size_t end = header.counts_line + 1;
    while (end < file.size() && !file.line(end).starts_with('*')) ++end;
    return read_values(file, header.counts_line + 1, end, {header.count, "NPTS"}, si);
}

std::string_view format_name(SampleQuantity quantity) {
    constexpr std::array<std::string_view, 3> kNames{"PEER AT2", "PEER VT2", "PEER DT2"};
    return kNames.at(static_cast<std::size_t>(quantity));
}

}  // namespace

GroundMotion parse_at2(const TextFile& file, const ReadOptions& options) {
    const At2Header header = read_header(file);
    const SampleUnit unit = header.unit ? *header.unit : requested_unit(file, options);
    refuse_contradictions(file, options, unit, header.dt);

    GroundMotion motion{.source = file.path().string(), .format = std::string(format_name(unit.quantity))};
    motion.event = header.event;
    motion.station = header.station;
    motion.integration_corner = header.integration_corner;
    motion.components.push_back({.name = header.component,
                                 .azimuth_deg = find_azimuth_deg(header.component),
                                 .series = {unit.quantity, header.start, header.dt, read_samples(file, header, unit.si)}});
    motion.history.push_back(fmt::format("read {} from {}, unit {}", motion.format, file.path().filename().string(), unit.name));
    return motion;
}

}  // namespace musim::records::detail
