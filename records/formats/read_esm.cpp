#include <fmt/format.h>

#include <cmath>

#include "records/detail/text.hpp"
#include "records/formats/detail/parsers.hpp"
#include "records/formats/detail/table.hpp"
#include "records/headers/header_checks.hpp"
#include "records/headers/header_fields.hpp"

namespace musim::records::detail {
namespace {

// header lines hold a colon ("NDATA: 5600"), samples do not
std::size_t count_esm_header_lines(const TextFile& file) {
    std::size_t lines = 0;
    while (file.line(lines).find(':') != std::string_view::npos) ++lines;
    return lines;
}

SampleUnit read_unit(const TextFile& file, const HeaderFields& header) {
    const HeaderField field = header.require("UNITS");
    const std::optional<SampleUnit> unit = find_sample_unit(field.text);
    if (!unit) {
        file.fail(field.line, fmt::format("UNITS is {} (known: {})", quoted(field.text), sample_unit_names()), "correct the header");
    }
    const HeaderField type = header.require("DATA_TYPE");
    if (!equal_ignoring_case(type.text, to_string(unit->quantity))) {
        file.fail(type.line, fmt::format("DATA_TYPE is {} (UNITS {} are of {})", quoted(type.text), unit->name, to_string(unit->quantity)),
                  "use the acceleration, velocity or displacement file of the record");
    }
    return *unit;
}

// "PGA_CM/S^2: 1.632", with or without the sign of the peak
void check_peak(const TextFile& file, const HeaderFields& header, std::size_t begin, const SampleUnit& unit,
                const std::vector<double>& samples) {
    for (const std::string_view name : {"PGA_CM/S^2", "PGV_CM/S", "PGD_CM"}) {
        const std::optional<HeaderField> field = header.find(name);
        if (!field) continue;
        const std::string_view magnitude = field->text.substr(field->text.starts_with('-') ? 1 : 0);
        const std::string_view largest = text_of_value(file, begin, find_peak(samples));
        check_stated_peak(file, field->line, name, magnitude, {std::abs(signed_peak(samples)) / unit.si, half_last_digit(largest)});
    }
}

// "HNE" → 90: the last letter of a stream is its direction; "HN1" and "HNZ" have no azimuth
std::optional<double> azimuth_of_stream(std::string_view stream) {
    return stream.ends_with('N') || stream.ends_with('E') ? find_azimuth_deg(stream.substr(stream.size() - 1)) : std::nullopt;
}

std::string joined(std::string_view first, std::string_view gap, std::string_view second) {
    return fmt::format("{}{}{}", first, first.empty() || second.empty() ? "" : gap, second);
}

}  // namespace

GroundMotion parse_esm(const TextFile& file, const ReadOptions& options) {
    const std::size_t header_lines = count_esm_header_lines(file);
    const HeaderFields header(file, header_lines);
    const SampleUnit unit = read_unit(file, header);
    const scaling::Time dt = checked_dt(file, header.require("SAMPLING_INTERVAL_S").line, header.require_positive("SAMPLING_INTERVAL_S"));
    refuse_contradictions(file, options, unit, dt);
    std::vector<double> samples = read_values(file, header_lines, file.size(), {header.require_count("NDATA"), "NDATA"}, unit.si);
    check_peak(file, header, header_lines, unit, samples);

    GroundMotion motion{.source = file.path().string(), .format = "ESM"};
    motion.event =
        joined(header.text("EVENT_NAME"), ", ", joined(header.text("EVENT_DATE_YYYYMMDD"), " ", header.text("EVENT_TIME_HHMMSS")));
    motion.station = joined(joined(header.text("NETWORK"), ".", header.text("STATION_CODE")), ", ", header.text("STATION_NAME"));
    motion.time_zero = header.find_time("DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS");
    const std::string_view stream = header.require("STREAM").text;
    motion.components.push_back({.name = std::string(stream),
                                 .azimuth_deg = azimuth_of_stream(stream),
                                 .series = {unit.quantity, 0.0 * scaling::si::seconds, dt, std::move(samples)}});
    const bool is_raw = contains_ignoring_case(header.text("BASELINE_CORRECTION"), "NOT REMOVED");
    if (is_raw) motion.integration_corner = kUncorrectedCornerHz * scaling::si::hertz;
    motion.history.push_back(fmt::format("read {} from {}, unit {}", motion.format, file.path().filename().string(), unit.name));
    return motion;
}

}  // namespace musim::records::detail
