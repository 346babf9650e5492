#include "records/formats/detail/timed_samples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "records/detail/text.hpp"
#include "records/headers/header_checks.hpp"

namespace musim::records::detail {

namespace {

constexpr std::size_t kCountsLine = 10;
constexpr std::size_t kUnitLine = 11;
std::size_t read_count(const TextFile& file, std::size_t index) {
    const std::string_view text = value_of(file.line(index), "NO. OF POINTS");
    const std::optional<std::size_t> count = parse_count(text);
    constexpr std::size_t kMost = 1'000'000'000;  // a day of samples at 10 kHz; twice as many numbers are far from overflow
    if (!count || *count == 0 || *count > kMost) {
        file.fail(index, fmt::format("number of points {} is unusable (must be a positive integer)", quoted(text)), "correct the line");
    }
    return *count;
}

// columns of seven letters; some files put a blank before the first
FixedColumns find_pair_columns(const TextFile& file, std::size_t line, std::size_t count) {
    FixedColumns columns{.per_line = 10, .width = 7};
    const std::size_t length = file.line(line).size();
    const std::size_t expected = columns.width * std::min(columns.per_line, 2 * count);
    if (length == expected + 1) columns.indent = 1;
    if (length != expected + columns.indent) {
        file.fail(line, fmt::format("line has {} letters ({} expected: times and values of {} letters)", length, expected, columns.width),
                  "fetch the record again");
    }
    return columns;
}

// runs of equal times lie evenly within half a last digit to both sides of what is printed; how many times were moved
std::size_t spread_equal_times(const TextFile& file, const NumberBlock& block, std::vector<double>& times) {
    std::size_t moved = 0;
    for (std::size_t first = 0; first < times.size();) {
        std::size_t end = first + 1;
        while (end < times.size() && times[end] == times[first]) ++end;
        const std::size_t run = end - first;
        if (run > 1) {
            const double half = half_last_digit(text_of_number(file, block, 2 * first));
            const double printed = times[first];
            for (std::size_t i = 0; i < run; ++i)
                times[first + i] = printed + half * (static_cast<double>(2 * i + 1) / static_cast<double>(run) - 1.0);
            moved += run;
        }
        first = end;
    }
    return moved;
}

}  // namespace

TimedSamples read_timed_samples(const TextFile& file, const NumberBlock& block, double si) {
    if (block.count % 2 != 0) {
        file.fail(block.line, fmt::format("{} numbers announced (pairs of time and value need an even count)", block.count),
                  "correct the number of points");
    }
    const std::vector<double> numbers = read_block(file, block);
    const auto line_of_pair = [&](std::size_t pair) { return block.line + 2 * pair / block.columns.per_line; };

    TimedSamples timed{.line = block.line, .times = {}, .samples = {}};
    for (std::size_t pair = 0; 2 * pair < numbers.size(); ++pair) {
        const double sample = numbers[2 * pair + 1] * si;
        if (!std::isfinite(sample)) {
            file.fail(line_of_pair(pair), fmt::format("sample {} is {} (too large)", pair + 1, numbers[2 * pair + 1]), "repair the value");
        }
        timed.times.push_back(numbers[2 * pair]);
        timed.samples.push_back(sample);
    }
    timed.spread = spread_equal_times(file, block, timed.times);
    if (const std::optional<std::size_t> found = find_time_out_of_order(timed.times)) {
        file.fail(line_of_pair(*found), fmt::format("time {} is {} s (not after the one before it)", *found + 1, timed.times[*found]),
                  "repair the time or fetch the file again");
    }
    return timed;
}

ResampledSeries resample(const TextFile& file, SampleQuantity quantity, const TimedSamples& timed) {
    try {
        ResampledSeries resampled = resample_uneven(quantity, timed.times, timed.samples);
        if (timed.spread > 0) {
            resampled.note += fmt::format("{}{} times that are printed alike spread within their last digit",
                                          resampled.note.empty() ? "" : ", ", timed.spread);
        }
        return resampled;
    } catch (const ReadError& error) {
        throw error.seen_from<ReadError>(file.place_of(timed.line));
    }
}

bool announces_volume1_pairs(const TextFile& file, std::size_t start) {
    const std::string_view line = file.line(start + kUnitLine);
    return contains_ignoring_case(line, "UNITS") && contains_ignoring_case(line, "SEC AND G/10");
}

ResampledSeries read_volume1_pairs(const TextFile& file, std::size_t& index) {
    const std::size_t start = index;
    const std::size_t count = read_count(file, start + kCountsLine);
    const std::size_t body = start + kVolume1HeaderLines;
    if (body >= file.size())
        file.fail(file.size() - 1, fmt::format("sample 1 of {} is missing (file is truncated)", count), "fetch the record again");
    const NumberBlock block{body, 2 * count, find_pair_columns(file, body, count), "number"};
    const TimedSamples timed = read_timed_samples(file, block, kTenthOfG.si);

    // the header rounds to its last digit, and to milliseconds
    const std::string_view counts_line = file.line(start + kCountsLine);
    for (const std::string_view name : {std::string_view("RECORD LENGTH"), std::string_view("DURATION")}) {
        const std::optional<double> length = parse_real(value_of(counts_line, name));
        if (!length) continue;
        const double mean_step = (timed.times.back() - timed.times.front()) / static_cast<double>(std::max<std::size_t>(count, 2) - 1);
        check_record_length(file, start + kCountsLine, count, mean_step * scaling::si::seconds, *length, start + kCountsLine);
    }
    const std::string_view printed = value_of(file.line(start + kUnitLine), "MAX");
    if (const std::optional<double> peak = parse_real(printed)) {
        // samples are in tenths of g; the header's digits are cut or rounded
        const double rounding = 0.1 * half_last_digit(text_of_number(file, block, 2 * find_peak(timed.samples) + 1));
        const double tolerance = 2.0 * half_last_digit(printed) + rounding;
        check_peak(file, start + kUnitLine, timed.samples, {*peak, tolerance, 10.0 * kTenthOfG.si, "g"});
    }
    index = body + lines_of(block.count, block.columns);
    return resample(file, SampleQuantity::acceleration, timed);
}

}  // namespace musim::records::detail
