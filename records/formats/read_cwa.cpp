#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "records/detail/text.hpp"
#include "records/formats/detail/parsers.hpp"
#include "records/formats/detail/table.hpp"
#include "records/headers/header_checks.hpp"
#include "records/headers/header_fields.hpp"

namespace musim::records::detail {
namespace {

/// Taiwan's standard time [h ahead of UTC]; the header names it, "StartTime(GMT+08)".
constexpr double kTaiwanHoursAhead = 8.0;

constexpr std::size_t kComponents = 3;

// header lines begin with '#' or are empty
std::size_t count_cwa_header_lines(const TextFile& file) {
    std::size_t lines = 0;
    while (lines < file.size() && (file.line(lines).empty() || file.line(lines).starts_with('#'))) ++lines;
    return lines;
}

// "Time U(+); N(+); E(+)" → "U", "N", "E", all positive in their direction
std::array<std::string_view, kComponents> read_names(const TextFile& file, const HeaderFields& header) {
    const HeaderField field = header.require("DataSequence");
    std::string_view rest = field.text;
    constexpr std::string_view kNameSeparators = " \t;";
    const bool has_time = equal_ignoring_case(take_token(rest, kNameSeparators), "Time");
    std::array<std::string_view, kComponents> names;
    bool is_usable = has_time;
    for (std::string_view& name : names) {
        name = take_token(rest, kNameSeparators);
        is_usable = is_usable && name.size() > 3 && name.ends_with("(+)");
        name = name.substr(0, name.find('('));
    }
    if (!is_usable || !take_token(rest, kNameSeparators).empty()) {
        file.fail(field.line, fmt::format("DataSequence is {} (must be 'Time' and three names with '(+)')", quoted(field.text)),
                  "fetch the record again");
    }
    return names;
}

// "0.658~   -0.837": largest and smallest sample
void check_extremes(const TextFile& file, const HeaderFields& header, std::string_view component, const NumberTable& table,
                    std::size_t column, const SampleUnit& unit) {
    const std::string name = fmt::format("AmplitudeMAX. {}", component);
    const HeaderField field = header.require(name);
    std::string_view rest = field.text;
    const std::vector<double>& samples = table.columns[column];
    const auto [smallest, largest] = std::minmax_element(samples.begin(), samples.end());
    for (const auto extreme : {largest, smallest}) {
        const std::string_view sample = text_in_table(file, table, static_cast<std::size_t>(extreme - samples.begin()), column);
        check_stated_peak(file, field.line, name, take_token(rest, " \t~"), {*extreme / unit.si, half_last_digit(sample)});
    }
}

// length and rate of the header, to one sample, and its rate against the time column
scaling::Time read_time_step(const TextFile& file, const HeaderFields& header, const NumberTable& table) {
    const HeaderField rate_field = header.require("SampleRate(Hz)");
    const double rate = header.require_positive("SampleRate(Hz)");
    const double step = even_time_step(file, table.columns.front(), table.lines);
    if (!(std::abs(step * rate - 1.0) <= 1e-3)) {
        file.fail(rate_field.line, fmt::format("SampleRate(Hz) is {} (the times are {} s apart)", quoted(rate_field.text), step),
                  "fetch the record again");
    }
    const double length = header.require_positive("RecordLength(sec)");
    if (!(std::abs(static_cast<double>(table.rows()) - length * rate) <= 1.0)) {
        file.fail(table.lines.back(),
                  fmt::format("{} rows for {} s at {} Hz (truncated, or more than announced)", table.rows(), length, rate),
                  "fetch the record again");
    }
    return checked_dt(file, rate_field.line, 1.0 / rate);
}

}  // namespace

GroundMotion parse_cwa(const TextFile& file, const ReadOptions& options) {
    const std::size_t header_lines = count_cwa_header_lines(file);
    const HeaderFields header(file, header_lines);
    const std::array<std::string_view, kComponents> names = read_names(file, header);
    const SampleUnit unit = header.require_acceleration("AmplitudeUnit");
    NumberTable table = read_table(file, header_lines, std::array{1.0, unit.si, unit.si, unit.si});
    const scaling::Time dt = read_time_step(file, header, table);
    const scaling::Time start = table.columns.front().front() * scaling::si::seconds;
    refuse_contradictions(file, options, unit, dt);

    GroundMotion motion{.source = file.path().string(), .format = "CWA"};
    for (std::size_t i = 0; i < kComponents; ++i) {
        std::vector<double>& samples = table.columns[i + 1];
        check_extremes(file, header, names.at(i), table, i + 1, unit);
        const bool is_horizontal = names.at(i) == "N" || names.at(i) == "E";
        motion.components.push_back({.name = std::string(names.at(i)),
                                     .azimuth_deg = is_horizontal ? find_azimuth_deg(names.at(i)) : std::nullopt,
                                     .series = {unit.quantity, start, dt, std::move(samples)}});
    }
    motion.event = fmt::format("{} GMT+08, magnitude {} (Ml)", header.text("Origin Time(GMT+08)"), header.text("Magnitude(Ml)"));
    motion.station = fmt::format("{}, {}", header.require("StationCode").text, header.text("StationName"));
    motion.time_zero = header.find_time("StartTime(GMT+08)", kTaiwanHoursAhead);
    // "DCoffset(corr)": a mean is taken off, the drift is not
    motion.integration_corner = kUncorrectedCornerHz * scaling::si::hertz;
    motion.history.push_back(fmt::format("read {} from {}, unit {}", motion.format, file.path().filename().string(), unit.name));
    return motion;
}

}  // namespace musim::records::detail
