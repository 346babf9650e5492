#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "records/detail/text.hpp"
#include "records/formats/detail/announced_block.hpp"
#include "records/formats/detail/parsers.hpp"
#include "records/formats/detail/timed_samples.hpp"
#include "records/headers/direction.hpp"
#include "records/headers/header_checks.hpp"

namespace musim::records::detail {
namespace {

/// Lines of the text header, from the one that names volume I.
enum UscHeaderLine : std::size_t { kUscEventLine = 1, kUscStationLine = 4, kUscPlaceLine = 5, kUscComponentLine = 6 };

// "STATION USC# 0057   34 25 09N, 118 25 34W" and "16628 W. LOST CANYON RD., CANYON COUNTRY, CA                            44"
std::string read_station(const TextFile& file, std::size_t header) {
    std::string_view rest = file.line(header + kUscStationLine);
    const std::size_t number = rest.find('#');
    rest.remove_prefix(number == std::string_view::npos ? rest.size() : number + 1);
    return fmt::format("USC.{} {}", take_token(rest), first_field(file.line(header + kUscPlaceLine)));
}

// "COMP N00W                                                               9"
Direction read_component(const TextFile& file, std::size_t header) {
    std::string_view rest = file.line(header + kUscComponentLine);
    if (!equal_ignoring_case(take_token(rest), "COMP")) {
        file.fail(header + kUscComponentLine, "component is missing (no 'COMP N00W')", "fetch the record again");
    }
    return read_direction(take_token(rest));
}

// some files name their station once more behind the samples
bool names_station(const TextFile& file, std::size_t header, std::string_view line) {
    const std::string_view place = first_field(file.line(header + kUscPlaceLine));
    return contains_ignoring_case(line, "USC#") || (!place.empty() && contains_ignoring_case(line, place));
}

void check_end(const TextFile& file, std::size_t header, std::size_t index) {
    for (; index < file.size(); ++index) {
        if (file.line(index).empty() || names_station(file, header, file.line(index))) continue;
        file.fail(index, "line behind the last sample (more values than the header's count)", "correct the number of points");
    }
}

// "PEAK   VELOCITY   =    12.05681    CMS/SEC   AT    4.500   SEC.": a unit for the block below " 1887 POINTS OF VEL DATA EQUALLY SPACED
// ..."
std::optional<SampleUnit> find_header_unit(const TextFile& file, std::size_t first_block, std::string_view announcement) {
    constexpr std::array kUnits{std::tuple{"ACC", "ACCELERATION", "cm/s^2"}, std::tuple{"VEL", "VELOCITY", "cm/s"},
                                std::tuple{"DIS", "DISPLACEMENT", "cm"}};
    constexpr std::array kPrinted{"CMS/SEC/SEC", "CMS/SEC", "CMS"};
    for (std::size_t i = 0; i < kUnits.size(); ++i) {
        const auto& [block, quantity, unit] = kUnits.at(i);
        if (!contains_ignoring_case(announcement, block)) continue;
        for (std::size_t index = 0; index < first_block; ++index) {
            const std::string_view line = file.line(index);
            if (find_ignoring_case(line, "PEAK") != 0 || !contains_ignoring_case(line, quantity)) continue;
            std::string_view rest = line.substr(std::min(line.find('='), line.size() - 1) + 1);
            take_token(rest);
            if (equal_ignoring_case(take_token(rest), kPrinted.at(i))) return find_sample_unit(unit);
        }
    }
    return std::nullopt;
}

// "ACCELEROGRAM IS BAND-PASS FILTERED BETWEEN  .225- .325 AND 25.00-27.00 HZ.": below the first corner the samples hold nothing of the
// motion, and their integral drifts away from the velocity and displacement of the same file
std::optional<scaling::Frequency> find_filter_corner(const TextFile& file) {
    constexpr std::string_view kTitle = "BAND-PASS FILTERED BETWEEN";
    constexpr std::size_t kLongestHeader = 60;  // lines
    for (std::size_t index = 0; index < std::min(file.size(), kLongestHeader); ++index) {
        const std::size_t found = find_ignoring_case(file.line(index), kTitle);
        if (found == std::string_view::npos) continue;
        std::string_view rest = file.line(index).substr(found + kTitle.size());
        const std::string_view number = take_token(rest, " \t-");
        const std::optional<double> hertz = parse_real(number);
        if (!hertz || !(*hertz > 0.0 && std::isfinite(*hertz))) {
            file.fail(index, fmt::format("filter corner {} is no positive number", quoted(number)), "fetch the record again");
        }
        return *hertz * scaling::si::hertz;
    }
    return std::nullopt;
}

// "PEAK   VELOCITY   =    12.05681    CMS/SEC   AT    4.500   SEC."
void check_stated_peak(const TextFile& file, std::size_t first, std::size_t last, std::span<const double> samples,
                       std::string_view largest_sample, const SampleUnit& unit) {
    for (std::size_t index = first; index < last; ++index) {
        const std::string_view line = file.line(index);
        if (find_ignoring_case(line, "PEAK") != 0 || !contains_ignoring_case(line, to_string(unit.quantity))) continue;
        std::string_view rest = line.substr(std::min(line.find('='), line.size() - 1) + 1);
        const std::string_view printed = take_token(rest);
        const std::optional<double> peak = parse_real(printed);
        if (!peak) continue;
        // cut or rounded: a whole last digit each
        const double tolerance = 2.0 * (half_last_digit(printed) + half_last_digit(largest_sample));
        check_peak(file, index, samples, {*peak, tolerance, unit.si, unit.name});
    }
}

// blocks of acceleration, velocity and displacement, of which one is wanted; all are read, so that damage anywhere is seen
TimeSeries read_corrected(const TextFile& file, const ReadOptions& options) {
    constexpr std::size_t kLongestHeader = 60;  // lines; met: 46
    const std::size_t headers_end = std::min(file.size(), kLongestHeader);
    std::size_t index = 0;
    while (index < headers_end && !announces_samples(file.line(index))) ++index;
    const std::size_t first_block = index;

    const SampleQuantity wanted = options.quantity.value_or(SampleQuantity::acceleration);
    std::optional<TimeSeries> series;
    while (announces_samples(file.line(index))) {
        const BlockHeader block = read_block_header(file, index, find_header_unit(file, first_block, file.line(index)));
        const NumberBlock numbers{block.line + 1, block.count, block.columns};
        std::vector<double> samples = read_block(file, numbers, block.unit.si);
        check_stated_peak(file, 0, first_block, samples, text_of_number(file, numbers, find_peak(samples)), block.unit);
        index = block.line + 1 + lines_of(block.count, block.columns);
        if (block.unit.quantity != wanted || series) continue;
        refuse_contradictions(file, options, block.unit, block.dt);
        series.emplace(wanted, 0.0 * scaling::si::seconds, block.dt, std::move(samples));
    }
    if (!series) {
        file.fail(std::min(first_block, file.size() - 1), fmt::format("file has no {}", to_string(wanted)),
                  Remedy{"give another value for ", Setting::quantity, ", or fetch the record again"});
    }
    check_end(file, 1, index);
    return *std::move(series);
}

}  // namespace

GroundMotion parse_usc(const TextFile& file, const ReadOptions& options) {
    const bool is_corrected = find_ignoring_case(file.line(0), "CORRECTED ACCELEROGRAM") == 0;
    const std::size_t header = is_corrected ? 1 : 0;
    GroundMotion motion{.source = file.path().string(), .format = is_corrected ? "USC corrected" : "USC uncorrected"};
    motion.event = first_field(file.line(header + kUscEventLine));
    motion.station = read_station(file, header);
    motion.history.push_back(fmt::format("read {} from {}", motion.format, file.path().filename().string()));
    Direction direction = read_component(file, header);

    std::optional<TimeSeries> series;
    if (is_corrected) {
        series = read_corrected(file, options);
        if (series->quantity() == SampleQuantity::acceleration) motion.integration_corner = find_filter_corner(file);
    } else {
        if (!announces_volume1_pairs(file, header)) {
            file.fail(header, "unit is missing (no 'UNITS ARE SEC AND G/10')", "fetch the record again");
        }
        std::size_t index = header;
        ResampledSeries resampled = read_volume1_pairs(file, index);
        check_end(file, header, index);
        refuse_contradictions(file, options, kTenthOfG, resampled.series.dt());
        if (!resampled.note.empty()) motion.history.push_back(std::move(resampled.note));
        series = std::move(resampled.series);
        motion.integration_corner = kUncorrectedCornerHz * scaling::si::hertz;
    }
    motion.components.push_back({std::move(direction.name), direction.azimuth_deg, *std::move(series)});
    return motion;
}

}  // namespace musim::records::detail
