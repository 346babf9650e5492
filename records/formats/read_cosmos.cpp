#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "records/detail/text.hpp"
#include "records/formats/detail/parsers.hpp"
#include "records/headers/direction.hpp"
#include "records/headers/fixed_columns.hpp"
#include "records/headers/header_checks.hpp"
#include "records/headers/own_titles.hpp"

namespace musim::records::detail {
namespace {

/// Numbers of the two numeric headers, counted from 1 as the format's description does [COSMOS strong-motion format 1.20].
enum IntegerNumber : std::size_t { kStartYear = 40, kStartMonth = 42, kStartDay, kStartHour, kStartMinute, kAzimuth = 54 };
enum RealNumber : std::size_t {
    kMicrovoltsPerCount = 22,
    kStartSecond = 30,
    kVoltsPerG = 42,
    kGain = 47,
    kStepInMilliseconds = 62,
    kLengthInSeconds,
    kPeak
};
constexpr double kUnknown = -999.0;

/// One channel as the file holds it.
struct Channel {
    std::size_t start = 0;                                      ///< its first line
    std::size_t data = 0;                                       ///< the line that announces its samples
    std::optional<scaling::Frequency> integration_corner = {};  ///< that musim wrote
    std::optional<scaling::Time> start_time = {};               ///< likewise
    Direction direction = {};
    std::optional<UtcTime> first_sample = {};
    SampleUnit unit = {};
    std::optional<TimeSeries> series = {};
};

std::size_t leading_count(const TextFile& file, std::size_t index, std::string_view noun) {
    std::string_view rest = file.line(index);
    return checked_count(file, index, take_token(rest), "correct the line", noun);
}

FixedColumns stated_columns(const TextFile& file, std::size_t index) {
    const std::string_view line = file.line(index);
    const std::size_t format = find_ignoring_case(line, "FORMAT");
    if (format != std::string_view::npos) {
        if (const std::optional<FixedColumns> columns = find_columns(line.substr(format))) return *columns;
    }
    file.fail(index, "Fortran format is missing (no 'Format=(8f9.6)' or the like)", "fetch the record again");
}

// "100 Integer-header values follow on  10 lines, Format= (10I8)"
NumericHeader read_announced_header(const TextFile& file, std::size_t index, std::string_view title, std::string_view noun) {
    if (!contains_ignoring_case(file.line(index), title)) {
        file.fail(std::min(index, file.size() - 1), fmt::format("header line is missing (no '{} values follow')", title),
                  "fetch the record again");
    }
    return read_numeric_header(file, {index + 1, leading_count(file, index, noun), stated_columns(file, index), noun}, kUnknown);
}

// "(Format v01.20 with 13 text lines)"
std::size_t count_text_lines(const TextFile& file, std::size_t start) {
    const std::string_view line = file.line(start);
    constexpr std::string_view kWith = " WITH ";
    const std::size_t with = find_ignoring_case(line, kWith);
    std::string_view rest = with == std::string_view::npos ? std::string_view{} : line.substr(with + kWith.size());
    const std::optional<std::size_t> count = parse_count(take_token(rest));
    constexpr std::size_t kFewest = 13;  // those that are read here; later versions may add some
    if (!count || *count < kFewest || *count > file.size()) {
        file.fail(start, "channel header is unusable (no '(Format v01.20 with 13 text lines)')", "fetch the record again");
    }
    return *count;
}

// below "4 Comment line(s) follow": those lines; the first line behind them
std::size_t skip_comments(const TextFile& file, std::size_t index) {
    if (!contains_ignoring_case(file.line(index), "COMMENT LINE")) {
        file.fail(std::min(index, file.size() - 1), "header line is missing (no 'Comment line(s) follow')", "fetch the record again");
    }
    ++index;
    while (trim(file.line(index)).starts_with('|')) ++index;
    return index;
}

// "|<SCNL>23837.HNN.CE.--": the network's name of the channel; empty when absent
std::string find_channel_code(const TextFile& file, std::size_t first, std::size_t last) {
    constexpr std::string_view kTag = "<SCNL>";
    for (std::size_t index = first; index < last; ++index) {
        const std::size_t tag = file.line(index).find(kTag);
        if (tag == std::string_view::npos) continue;
        std::string_view rest = file.line(index).substr(tag + kTag.size());
        take_token(rest, ".");
        return std::string(take_token(rest, ". "));
    }
    return {};
}

// "Sta Chan   ?: 90 Deg (Rcrdr Chan  ?)", "Sta Cha:  1: 340 deg (Rcrdr Chan  1)"
Direction read_title(std::string_view title) {
    title = title.substr(0, title.find('('));
    const std::size_t colon = title.rfind(':');
    return read_direction(colon == std::string_view::npos ? std::string_view{} : title.substr(colon + 1));
}

std::optional<UtcTime> find_start(const NumericHeader& integers, const NumericHeader& reals) {
    const auto part = [&](std::size_t number) { return integers.date_part(number); };
    return make_utc_time(part(kStartYear), part(kStartMonth), part(kStartDay), part(kStartHour), part(kStartMinute),
                         reals.find(kStartSecond).value_or(-1.0));
}

// what one count is worth: volts by the recorder, g by the sensor
SampleUnit unit_of_counts(const TextFile& file, const NumericHeader& reals) {
    const auto positive = [&](std::size_t number) {
        const double value = reals.find(number).value_or(kUnknown);
        if (value > 0.0) return value;
        file.fail(reals.line_of(number),
                  fmt::format("real-header value {} is {} (counts need microvolts per count, volts per g and gain)", number, value),
                  "use the record in physical units (V1)");
    };
    const double volts = 1e-6 * positive(kMicrovoltsPerCount) / positive(kGain);
    return {"counts", SampleQuantity::acceleration, volts / positive(kVoltsPerG) * scaling::kStandardGravity.value()};
}

// "13400 acceleration pts, approx  67 secs, units=g.     (02)Format=(8f9.6)"
SampleUnit read_unit(const TextFile& file, std::size_t index, const NumericHeader& reals) {
    const std::string_view line = file.line(index);
    constexpr std::string_view kUnits = "UNITS=";
    const std::size_t units = find_ignoring_case(line, kUnits);
    if (units == std::string_view::npos) file.fail(index, "unit is missing (no 'units=')", "write e.g. 'units=g (02)'");
    std::string_view rest = line.substr(units + kUnits.size());
    const std::string_view name = take_token(rest, " (,");
    if (equal_ignoring_case(name, "counts") && contains_ignoring_case(line, "ACCEL")) return unit_of_counts(file, reals);
    if (const std::optional<SampleUnit> unit = find_sample_unit(name)) return *unit;
    file.fail(index, fmt::format("unit {} is unknown (known: counts of acceleration, {})", quoted(name), sample_unit_names()),
              "correct the line");
}

std::vector<double> read_samples(const TextFile& file, const Channel& channel, const NumericHeader& reals, scaling::Time dt) {
    const std::size_t count = leading_count(file, channel.data, "point");
    check_record_length(file, channel.data, count, dt, reals.find(kLengthInSeconds).value_or(0.0), reals.line_of(kLengthInSeconds));
    const NumberBlock block{channel.data + 1, count, stated_columns(file, channel.data)};
    std::vector<double> samples = read_block(file, block, channel.unit.si);
    if (const std::optional<double> peak = reals.find(kPeak)) {
        // networks state the peak before they round the samples, or remove their mean: four digits agree
        const double tolerance = 1e-3 * std::abs(*peak) + half_last_digit(text_of_number(file, block, find_peak(samples)));
        check_peak(file, reals.line_of(kPeak), samples, {*peak, tolerance, channel.unit.si, channel.unit.name});
    }
    return samples;
}

// one channel from line `index`; leaves `index` behind its end mark
Channel read_channel(const TextFile& file, std::size_t& index) {
    Channel channel{.start = index};
    const std::size_t text_lines = count_text_lines(file, index);
    const NumericHeader integers = read_announced_header(file, index + text_lines, "Integer-header", "integer-header value");
    const NumericHeader reals = read_announced_header(file, integers.end(), "Real-header", "real-header value");
    channel.data = skip_comments(file, reals.end());
    for (std::size_t line = reals.end(); line < channel.data; ++line) {
        if (!channel.integration_corner) channel.integration_corner = find_integration_corner(file, line);
        if (!channel.start_time) channel.start_time = find_start_time(file, line);
    }

    constexpr std::size_t kTitleLine = 8;
    channel.direction = read_title(file.line(channel.start + kTitleLine));
    check_azimuth(file, integers.line_of(kAzimuth), integers.find(kAzimuth).value_or(0.0), channel.direction, channel.start + kTitleLine);
    const std::string code = find_channel_code(file, reals.end(), channel.data);
    if (equal_ignoring_case(channel.direction.name, "Other") && !code.empty()) channel.direction.name = code;
    channel.first_sample = find_start(integers, reals);

    channel.unit = read_unit(file, channel.data, reals);
    const scaling::Time dt =
        checked_dt(file, reals.line_of(kStepInMilliseconds), 1e-3 * reals.find(kStepInMilliseconds).value_or(kUnknown));
    std::vector<double> samples = read_samples(file, channel, reals, dt);
    index = channel.data + 1 + lines_of(samples.size(), stated_columns(file, channel.data));
    channel.series.emplace(channel.unit.quantity, channel.start_time.value_or(scaling::Time()), dt, std::move(samples));

    if (find_ignoring_case(file.line(index), "END-OF-DATA") != 0 && !file.line(index).starts_with("/&")) {
        file.fail(std::min(index, file.size() - 1),
                  "end mark 'End-of-data' of the channel is missing (truncated, or more samples than announced)", "fetch the record again");
    }
    ++index;
    return channel;
}

// "Statn No: 05- 23837 Code:CE-23837  CGS  Pomona - Orange Grove & Fairplex" → "CE.23837 Pomona - Orange Grove & Fairplex"
std::string read_station(std::string_view line) {
    constexpr std::string_view kCode = "CODE:";
    const std::size_t found = find_ignoring_case(line, kCode);
    if (found == std::string_view::npos) return std::string(trim(line));
    std::string_view rest = line.substr(found + kCode.size());
    std::string code(take_token(rest));
    std::replace(code.begin(), code.end(), '-', '.');
    take_token(rest);  // the agency
    return fmt::format("{} {}", code, trim(rest));
}

// the quantity asked for; else acceleration, unless the file has none
SampleQuantity chosen_quantity(const TextFile& file, const ReadOptions& options, const std::vector<Channel>& channels) {
    const SampleQuantity wanted = options.quantity.value_or(SampleQuantity::acceleration);
    const bool is_there = std::any_of(channels.begin(), channels.end(), [&](const Channel& c) { return c.unit.quantity == wanted; });
    if (is_there) return wanted;
    if (options.quantity)
        file.fail(fmt::format("file has no {} (asked for)", to_string(wanted)), Remedy{"give another value for ", Setting::quantity});
    return channels.front().unit.quantity;
}

}  // namespace

GroundMotion parse_cosmos(const TextFile& file, const ReadOptions& options) {
    std::vector<Channel> channels;
    for (std::size_t index = 0; index < file.size();) {
        if (file.line(index).empty()) {
            ++index;
        } else {
            channels.push_back(read_channel(file, index));
        }
    }
    if (channels.empty()) file.fail("file has no channel (no header)", "fetch the record again");

    constexpr std::size_t kEventLine = 1;
    constexpr std::size_t kStationLine = 4;
    GroundMotion motion{.source = file.path().string()};
    motion.event = trim(file.line(channels.front().start + kEventLine));
    motion.station = read_station(file.line(channels.front().start + kStationLine));

    const SampleQuantity quantity = chosen_quantity(file, options, channels);
    const bool is_corrected = find_ignoring_case(file.line(channels.front().start), "CORRECTED") == 0;
    for (Channel& channel : channels) {
        if (channel.unit.quantity != quantity) continue;
        refuse_contradictions(file, options, channel.unit, channel.series->dt());
        TimeSeries& series = *channel.series;
        if (motion.components.empty() && channel.first_sample) motion.time_zero = find_instant(*channel.first_sample, -series.start());
        if (motion.time_zero && channel.first_sample && !channel.start_time) {
            const double start = std::chrono::duration<double>(*channel.first_sample - *motion.time_zero).count();
            series = TimeSeries(quantity, start * scaling::si::seconds, series.dt(), {series.samples().begin(), series.samples().end()});
        }
        motion.components.push_back({std::move(channel.direction.name), channel.direction.azimuth_deg, std::move(series)});
    }

    if (!is_corrected) motion.integration_corner = channels.front().integration_corner.value_or(kUncorrectedCornerHz * scaling::si::hertz);
    motion.format = is_corrected ? "COSMOS V2" : channels.front().unit.name == "counts" ? "COSMOS V0" : "COSMOS V1";
    motion.history.push_back(fmt::format("read {} from {}", motion.format, file.path().filename().string()));
    return motion;
}

}  // namespace musim::records::detail
