#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "records/detail/text.hpp"
#include "records/formats/detail/parsers.hpp"
#include "records/headers/direction.hpp"
#include "records/headers/fixed_columns.hpp"
#include "records/headers/header_checks.hpp"

namespace musim::records::detail {
namespace {

// a component is 16 lines of text, 4 of integers, 6 of reals, and its blocks of samples, numbers ten a line in eight letters each
constexpr std::size_t kPlaceLine = 6;
constexpr std::size_t kGeonetOriginLine = 7;
constexpr std::size_t kPointsLine = 9;
constexpr std::size_t kIntervalLine = 10;
constexpr std::size_t kComponentLine = 12;
constexpr std::size_t kPeakLine = 13;  ///< acceleration; velocity and displacement on the next two
constexpr std::size_t kIntegerLine = 16;
constexpr std::size_t kRealLine = 20;
constexpr std::size_t kHeaderLines = 26;
constexpr FixedColumns kGeonetColumns{.per_line = 10, .width = 8};

/// One component's header, at its place in the file.
struct Section {
    const TextFile& file;
    std::size_t start;

    std::string_view text(std::size_t line) const { return file.line(start + line); }

    /// The number in `column` of header line `line`.
    double number(std::size_t line, std::size_t column) const {
        const std::string_view whole = text(line);
        const std::size_t at = std::min(column * kGeonetColumns.width, whole.size());
        const std::string_view digits = trim(whole.substr(at, kGeonetColumns.width));
        const std::optional<double> value = parse_real(digits);
        if (!value) {
            file.fail(start + line, fmt::format("number {} of the header line is {} (no number)", column + 1, quoted(digits)),
                      "fetch the record again");
        }
        return *value;
    }
};

/// A block of samples of one quantity, announced by the line of its peak.
struct Block {
    SampleUnit unit;
    std::string_view peak;
    std::size_t count = 0;
};

bool is_corrected(const Section& section) { return find_ignoring_case(section.text(0), "CORRECTED ACCELEROGRAM") == 0; }

// first number behind `phrase`
std::optional<double> number_after(std::string_view line, std::string_view phrase) {
    const std::size_t found = find_ignoring_case(line, phrase);
    if (found == std::string_view::npos) return std::nullopt;
    line.remove_prefix(found + phrase.size());
    return parse_real(take_token(line));
}

// "Raw readings in units of 1.00 mm/s/s  at intervals of 0.005 s" or "Instrument corrected data at 0.020 sec intervals"; again in the reals
scaling::Time read_time_step(const Section& section) {
    const std::string_view line = section.text(kIntervalLine);
    const std::size_t index = section.start + kIntervalLine;
    const std::optional<double> step = is_corrected(section) ? number_after(line, " at ") : number_after(line, "intervals of");
    if (!step) section.file.fail(index, fmt::format("time step is missing in {}", quoted(line)), "fetch the record again");
    const scaling::Time dt = checked_dt(section.file, index, *step);

    constexpr std::size_t kStepColumn = 5;
    const double again = section.number(kRealLine + 2, kStepColumn);
    if (!(std::abs(again - *step) <= 1e-3 * *step)) {
        section.file.fail(index, fmt::format("time step is {} s (line {} says {} s)", *step, section.start + kRealLine + 3, again),
                          "fetch the record again or correct the header");
    }
    return dt;
}

// "Velocity:      peak     1.65 mm/s   at  43.56 sec" and the number of points in the integers; nothing for "record unevaluated"
std::optional<Block> read_block_header(const Section& section, std::size_t which) {
    constexpr std::array<SampleQuantity, 3> kOrder{SampleQuantity::acceleration, SampleQuantity::velocity, SampleQuantity::displacement};
    const std::string_view line = section.text(kPeakLine + which);
    const std::size_t index = section.start + kPeakLine + which;
    if (contains_ignoring_case(line, "unevaluated")) return std::nullopt;

    const std::size_t found = find_ignoring_case(line, "peak");
    std::string_view rest = line.substr(found == std::string_view::npos ? line.size() : found + 4);
    const std::string_view peak = take_token(rest);
    const std::string_view unit_name = take_token(rest);
    const std::optional<SampleUnit> unit = find_sample_unit(unit_name);
    if (!unit || unit->quantity != kOrder.at(which)) {
        section.file.fail(
            index, fmt::format("unit {} is none of {} (known: {})", quoted(unit_name), to_string(kOrder.at(which)), sample_unit_names()),
            "fetch the record again");
    }

    const std::optional<double> announced = number_after(section.text(kPointsLine), "Number of points");
    const double count = section.number(kIntegerLine + 3, 3 + which);
    constexpr double kMost = 1e7;  // seven digits fit the column
    if (!announced || *announced != count || !(count >= 1.0 && count <= kMost) || count != std::floor(count)) {
        section.file.fail(section.start + kPointsLine,
                          fmt::format("{} is no usable number of points (line {} says {} for the {})", quoted(section.text(kPointsLine)),
                                      section.start + kIntegerLine + 4, count, to_string(unit->quantity)),
                          "fetch the record again or correct the header");
    }
    return Block{*unit, peak, static_cast<std::size_t>(count)};
}

// "Number of points  5800    Duration 115.98 sec", of which the duration may count one sample less
void check_duration(const Section& section, std::size_t count, scaling::Time dt) {
    const std::optional<double> duration = number_after(section.text(kPointsLine), "Duration");
    constexpr double kPrinted = 0.01;  // [s]
    if (duration && std::abs(static_cast<double>(count) * dt.value() - *duration) <= 2.0 * dt.value() + kPrinted) return;
    section.file.fail(section.start + kPointsLine,
                      fmt::format("{} points of {} s do not make the duration in {}", count, dt.value(),
                                  quoted(section.text(kPointsLine).substr(std::min<std::size_t>(24, section.text(kPointsLine).size())))),
                      "fetch the record again or correct the header");
}

// "Component S16W  Longitudinal Accelerometer Axis" → "S16W", 196°, which the integers repeat
Component read_orientation(const Section& section, TimeSeries series) {
    std::string_view rest = section.text(kComponentLine);
    take_token(rest);
    const std::string_view name = take_token(rest);
    const std::optional<double> azimuth = parse_bearing(name);
    constexpr std::size_t kAzimuthColumn = 7;
    const double stored = section.number(kIntegerLine + 2, kAzimuthColumn);
    if (azimuth && std::fmod(stored, 360.0) != std::fmod(*azimuth, 360.0)) {
        section.file.fail(section.start + kComponentLine,
                          fmt::format("component {} has the azimuth {} (line {} says {}; header is damaged)", quoted(name), *azimuth,
                                      section.start + kIntegerLine + 3, stored),
                          "fetch the record again or correct the header");
    }
    return {.name = std::string(name), .azimuth_deg = azimuth, .series = std::move(series)};
}

// when the recorder's buffer starts: spread over the last two columns of the integers, seconds in milliseconds; zeros when unknown
std::optional<UtcTime> read_buffer_start(const Section& section) {
    const double year = section.number(kIntegerLine, 8);
    if (year == 0.0) return std::nullopt;
    std::array<int, 5> date{};
    constexpr std::array<std::array<std::size_t, 2>, 5> kPlaces{{{0, 8}, {0, 9}, {1, 8}, {1, 9}, {3, 8}}};
    for (std::size_t i = 0; i < date.size(); ++i) {
        const double part = section.number(kIntegerLine + kPlaces.at(i)[0], kPlaces.at(i)[1]);
        date.at(i) = part >= 0.0 && part <= 9999.0 ? static_cast<int>(part) : -1;
    }
    const double milliseconds = section.number(kIntegerLine + 3, 9);
    const std::optional<UtcTime> time = make_utc_time(date[0], date[1], date[2], date[3], date[4], milliseconds / 1000.0);
    if (!time) {
        section.file.fail(section.start + kIntegerLine, "start of the recording is no date and time (last two columns of the integers)",
                          "fetch the record again or correct the header");
    }
    return time;
}

// seconds put in front of the recording by the processing; the header's times do not count them
scaling::Time read_pad(const Section& section) {
    const double pad = section.number(kRealLine + 2, 1);
    constexpr double kMost = 1e4;  // [s]; the pads met are 5 s long
    if (!(pad >= 0.0 && pad <= kMost)) {
        section.file.fail(section.start + kRealLine + 2, fmt::format("pad in front is {} s (must not be negative)", pad),
                          "fetch the record again or correct the header");
    }
    return pad * scaling::si::seconds;
}

// all blocks of a component are read and checked; `index` moves behind them
std::optional<TimeSeries> read_blocks(const Section& section, const ReadOptions& options, scaling::Time start, std::size_t& index) {
    const TextFile& file = section.file;
    const SampleQuantity wanted = options.quantity.value_or(SampleQuantity::acceleration);
    const scaling::Time dt = read_time_step(section);
    std::optional<TimeSeries> series;
    index = section.start + kHeaderLines;
    for (std::size_t which = 0; which < 3; ++which) {
        const std::optional<Block> block = read_block_header(section, which);
        if (!block) continue;
        check_duration(section, block->count, dt);
        const NumberBlock numbers{.line = index, .count = block->count, .columns = kGeonetColumns};
        std::vector<double> samples = read_block(file, numbers, block->unit.si);
        index += lines_of(block->count, kGeonetColumns);
        // a sample of eight letters has fewer decimals the larger it is
        const std::string_view largest = text_of_number(file, numbers, find_peak(samples));
        check_stated_peak(file, section.start + kPeakLine + which, "peak", block->peak,
                          {signed_peak(samples) / block->unit.si, half_last_digit(largest)});
        if (block->unit.quantity != wanted) continue;
        refuse_contradictions(file, options, block->unit, dt);
        series.emplace(wanted, start, dt, std::move(samples));
    }
    if (!series)
        file.fail(section.start, fmt::format("component has no {}", to_string(wanted)),
                  Remedy{"give another value for ", Setting::quantity});
    return series;
}

}  // namespace

GroundMotion parse_geonet(const TextFile& file, const ReadOptions& options) {
    GroundMotion motion{.source = file.path().string()};
    const Section first{file, 0};
    motion.format = is_corrected(first) ? "GeoNet V2A" : "GeoNet V1A";
    motion.event = fmt::format("{}, {}", trim(first.text(kPlaceLine)), trim(first.text(kGeonetOriginLine)));
    std::string_view site = first.text(1);
    take_token(site);
    motion.station = fmt::format("{}, {}", take_token(site), trim(first.text(2)));
    motion.time_zero = read_buffer_start(first);

    for (std::size_t index = 0; index < file.size();) {
        const Section section{file, index};
        if (section.text(0).empty()) {
            ++index;
            continue;
        }
        if (section.text(0) != first.text(0)) {
            file.fail(
                index,
                fmt::format("{} is no header of a component (more samples than announced, or another recording)", quoted(section.text(0))),
                "fetch the record again");
        }
        if (read_buffer_start(section) != motion.time_zero) {
            file.fail(index + kIntegerLine, "recording starts at another time than that of the first component", "split the file");
        }
        const scaling::Time start = 0.0 * scaling::si::seconds - read_pad(section);
        std::optional<TimeSeries> series = read_blocks(section, options, start, index);
        motion.components.push_back(read_orientation(section, *std::move(series)));
    }
    if (!is_corrected(first)) motion.integration_corner = kUncorrectedCornerHz * scaling::si::hertz;
    motion.history.push_back(fmt::format("read {} from {}, {} s of padding in front", motion.format, file.path().filename().string(),
                                         0.0 - motion.components.front().series.start().value()));
    return motion;
}

}  // namespace musim::records::detail
