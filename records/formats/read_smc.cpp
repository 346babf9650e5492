#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "records/detail/text.hpp"
#include "records/formats/detail/parsers.hpp"
#include "records/formats/detail/timed_samples.hpp"
#include "records/headers/direction.hpp"
#include "records/headers/fixed_columns.hpp"
#include "records/headers/header_checks.hpp"

namespace musim::records::detail {
namespace {

// 11 lines of text, 6 of integers, 10 of reals, comments, samples
constexpr NumberBlock kIntegers{11, 48, {.per_line = 8, .width = 10, .is_integer = true}, "integer-header value"};
constexpr NumberBlock kReals{17, 50, {.per_line = 5, .width = 15}, "real-header value"};
constexpr double kUnknownInteger = -32768.0;
constexpr double kUnknownReal = 1.7e38;

/// Lines of the text header.
enum SmcTextLine : std::size_t { kSmcTitleLine = 0, kSmcEventLine = 3, kSmcStationLine = 5 };
/// Numbers of the numeric headers, counted from 1.
enum SmcInteger : std::size_t {
    kSmcStartYear = 2,
    kSmcStartDayOfYear,
    kSmcStartHour,
    kSmcStartMinute,
    kSmcStartSecond,
    kSmcStartMillisecond,
    kSmcAzimuth = 14,
    kSmcComments = 16,
    kSmcCount = 17,
    kSmcStationNumber = 30,
    kSmcDigits = 47
};
enum SmcReal : std::size_t { kSmcRate = 2, kSmcLargest = 30, kSmcSmallest = 32 };

/// Samples by the first letter of the file.
struct Content {
    SampleUnit unit;
    bool is_corrected = true;
};

Content read_content(const TextFile& file, const ReadOptions& options) {
    const auto in_centimeters = [](SampleQuantity quantity) { return *find_sample_unit(fmt::format("c{}", si_unit_name(quantity))); };
    const std::string_view title = file.line(kSmcTitleLine);
    if (title.empty()) file.fail(kSmcTitleLine, "title is missing (no '2 CORRECTED ACCELEROGRAM' or the like)", "fetch the record again");
    switch (title.front()) {
        case '0':
            return {in_centimeters(options.quantity.value_or(SampleQuantity::acceleration))};
        case '1':
            return {in_centimeters(SampleQuantity::acceleration), false};
        case '2':
            return {in_centimeters(SampleQuantity::acceleration)};
        case '3':
            return {in_centimeters(SampleQuantity::velocity)};
        case '4':
            return {in_centimeters(SampleQuantity::displacement)};
        default:
            file.fail(kSmcTitleLine, "file holds spectra (no time series)", "use the file of the accelerogram");
    }
}

// below the real header: as many comments as the integer header says; the first line behind them
std::size_t skip_comments(const TextFile& file, const NumericHeader& integers, std::size_t first) {
    std::size_t end = first;
    while (file.line(end).starts_with('|')) ++end;
    const std::optional<double> stated = integers.find(kSmcComments);
    if (stated && *stated != static_cast<double>(end - first)) {
        file.fail(integers.line_of(kSmcComments),
                  fmt::format("{} comments announced (found: {}; header or comments are damaged)", *stated, end - first),
                  "fetch the record again");
    }
    return end;
}

std::size_t count_numbers(const TextFile& file, const NumericHeader& integers) {
    const double count = integers.find(kSmcCount).value_or(0.0);
    if (count < 1.0) {
        file.fail(integers.line_of(kSmcCount),
                  fmt::format("number of values is {} (must be a positive integer)", integers.numbers[kSmcCount - 1]),
                  "correct integer-header value 17");
    }
    return static_cast<std::size_t>(count);
}

// eight numbers of ten letters, unless the header asks for eight digits
FixedColumns find_body_columns(const TextFile& file, const NumericHeader& integers) {
    constexpr double kUsualDigits = 5.0;
    constexpr double kManyDigits = 8.0;
    const double digits = integers.find(kSmcDigits).value_or(kUsualDigits);
    if (digits == kUsualDigits) return {.per_line = 8, .width = 10};
    if (digits == kManyDigits) return {.per_line = 5, .width = 14};
    file.fail(integers.line_of(kSmcDigits), fmt::format("{} digits a value (known: 5 and 8)", digits), "fetch the record again");
}

// the year and the rest say when the record starts only where they give it to the millisecond; else it is the earthquake's minute
std::optional<UtcTime> find_start(const NumericHeader& integers) {
    const auto part = [&](std::size_t number) { return integers.date_part(number); };
    const int day = part(kSmcStartDayOfYear), millisecond = part(kSmcStartMillisecond);
    if (day < 1 || day > 366 || millisecond < 0 || millisecond > 999) return std::nullopt;
    const std::optional<UtcTime> first_of_january =
        make_utc_time(part(kSmcStartYear), 1, 1, part(kSmcStartHour), part(kSmcStartMinute), part(kSmcStartSecond) + 1e-3 * millisecond);
    if (!first_of_january) return std::nullopt;
    return *first_of_january + std::chrono::days(day - 1);
}

// "station = APEEL Array #2 - Redwood City  component=    133": what follows `name`, up to `end`
std::string_view field_after(std::string_view line, std::string_view name, std::string_view end) {
    const std::size_t found = find_ignoring_case(line, name);
    if (found == std::string_view::npos) return {};
    std::string_view rest = line.substr(found + name.size());
    rest = rest.substr(std::min(rest.find('='), rest.size() - 1) + 1);
    return trim(end.empty() ? rest : rest.substr(0, find_ignoring_case(rest, end)));
}

std::string read_station(const TextFile& file, const NumericHeader& integers) {
    const std::string name(field_after(file.line(kSmcStationLine), "station", "component"));
    const std::optional<double> number = integers.find(kSmcStationNumber);
    return number && *number > 0.0 ? std::string(trim(fmt::format("{} {}", *number, name))) : name;
}

Direction read_component(const TextFile& file, const NumericHeader& integers) {
    const std::string_view name = field_after(file.line(kSmcStationLine), "component", "");
    const std::optional<double> stored = integers.find(kSmcAzimuth);
    Direction direction = read_direction(name.empty() && stored ? fmt::format("{} Deg", *stored) : std::string(name));
    check_azimuth(file, integers.line_of(kSmcAzimuth), stored.value_or(0.0), direction, kSmcStationLine);
    if (direction.name.empty()) direction.name.push_back('1');
    return direction;
}

void check_extremes(const TextFile& file, const NumericHeader& reals, std::span<const double> samples, std::string_view largest_sample,
                    const SampleUnit& unit) {
    const std::optional<double> largest = reals.find(kSmcLargest);
    const std::optional<double> smallest = reals.find(kSmcSmallest);
    if (!largest || !smallest) return;
    const double peak = std::max(std::abs(*largest), std::abs(*smallest));
    const double header_rounding = half_last_digit(text_of_number(file, reals.block, (*largest == peak ? kSmcLargest : kSmcSmallest) - 1));
    const double tolerance = 1e-4 * peak + header_rounding + half_last_digit(largest_sample);  // real files differ in the fifth digit
    check_peak(file, reals.line_of(kSmcLargest), samples, {peak, tolerance, unit.si, unit.name});
}

// some files are filled up with blanks or zero bytes
void check_end(const TextFile& file, std::size_t index) {
    for (; index < file.size(); ++index) {
        if (file.line(index).find_first_not_of(std::string_view("\0 ", 2)) != std::string_view::npos) {
            file.fail(index, "line behind the last sample (more values than the header's count)", "correct integer-header value 17");
        }
    }
}

}  // namespace

GroundMotion parse_smc(const TextFile& file, const ReadOptions& options) {
    const Content content = read_content(file, options);
    const NumericHeader integers = read_numeric_header(file, kIntegers, kUnknownInteger);
    const NumericHeader reals = read_numeric_header(file, kReals, kUnknownReal);
    const NumberBlock body{skip_comments(file, integers, reals.end()), count_numbers(file, integers), find_body_columns(file, integers)};
    GroundMotion motion{.source = file.path().string(), .format = "SMC"};
    motion.history.push_back(fmt::format("read SMC from {}, unit {}", file.path().filename().string(), content.unit.name));

    // without a sampling rate the numbers are pairs of time and value
    std::optional<TimeSeries> series;
    if (const std::optional<double> rate = reals.find(kSmcRate)) {
        const scaling::Time dt = checked_dt(file, reals.line_of(kSmcRate), 1.0 / *rate);
        std::vector<double> samples = read_block(file, body, content.unit.si);
        check_extremes(file, reals, samples, text_of_number(file, body, find_peak(samples)), content.unit);
        series.emplace(content.unit.quantity, 0.0 * scaling::si::seconds, dt, std::move(samples));
    } else {
        const TimedSamples timed = read_timed_samples(file, body, content.unit.si);
        check_extremes(file, reals, timed.samples, text_of_number(file, body, 2 * find_peak(timed.samples) + 1), content.unit);
        ResampledSeries resampled = resample(file, content.unit.quantity, timed);
        if (!resampled.note.empty()) motion.history.push_back(std::move(resampled.note));
        series = std::move(resampled.series);
    }
    check_end(file, body.line + lines_of(body.count, body.columns));
    refuse_contradictions(file, options, content.unit, series->dt());

    const std::string_view event = trim(file.line(kSmcEventLine));
    motion.event = event == "*" ? std::string_view{} : event;
    motion.station = read_station(file, integers);
    motion.time_zero = find_start(integers);
    if (!content.is_corrected) motion.integration_corner = kUncorrectedCornerHz * scaling::si::hertz;
    Direction direction = read_component(file, integers);
    motion.components.push_back({std::move(direction.name), direction.azimuth_deg, *std::move(series)});
    return motion;
}

}  // namespace musim::records::detail
