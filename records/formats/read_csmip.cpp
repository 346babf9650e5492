#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "records/detail/text.hpp"
#include "records/formats/detail/announced_block.hpp"
#include "records/formats/detail/parsers.hpp"
#include "records/formats/detail/timed_samples.hpp"
#include "records/headers/direction.hpp"
#include "records/headers/header_checks.hpp"

namespace musim::records::detail {
namespace {

/// Lines of text above the numbers of a volume 1 channel; volume 2 has more.
constexpr std::size_t kFewestTextLines = 13;

struct CsmipChannel {
    Direction direction;
    std::optional<TimeSeries> series;  ///< of the wanted quantity
    SampleUnit unit;
    bool is_corrected = false;
    std::string note = {};  ///< how uneven samples became even
};

bool starts_with_ignoring_case(std::string_view line, std::string_view start) { return find_ignoring_case(line, start) == 0; }

// "Chan  2: 360 Deg   Location: Abutment 1"
Direction read_csmip_title(std::string_view title) {
    const std::string_view rest = title.substr(title.find(':') + 1);
    return read_direction(first_field(trim(rest.substr(0, find_ignoring_case(rest, "Location")))));
}

// the azimuth is the 11th of the 16 five-letter integers on the second line of the integer header
void check_stored_azimuth(const TextFile& file, std::size_t title_line, std::size_t integer_line, const Direction& direction) {
    constexpr std::size_t kAzimuthColumn = 50;
    constexpr std::size_t kIntegerWidth = 5;
    const std::string_view line = file.line(integer_line);
    if (line.size() < kAzimuthColumn + kIntegerWidth) return;
    const std::optional<double> stored = parse_real(trim(line.substr(kAzimuthColumn, kIntegerWidth)));
    if (stored) check_azimuth(file, integer_line, *stored, direction, title_line);
}

// counts and length in the text header must agree with the line above the samples
void check_header(const TextFile& file, std::size_t start, std::size_t text_lines, const BlockHeader& block) {
    for (std::size_t index = start; index < start + text_lines; ++index) {
        const std::string_view line = file.line(index);
        std::string_view points = line;
        if (const std::size_t found = find_ignoring_case(line, "NO. OF POINTS"); found != std::string_view::npos) {
            points = line.substr(std::min(line.find('=', found), line.size() - 1) + 1);
        } else if (!contains_ignoring_case(line, "POINTS OF INSTRUMENT")) {
            points = {};
        }
        const std::string_view count = take_token(points);
        if (!count.empty() && parse_count(count) != block.count) {
            file.fail(block.line, fmt::format("{} points announced (line {} says {})", block.count, index + 1, quoted(count)),
                      "fetch the record again or correct the header");
        }

        const std::size_t length_at = find_ignoring_case(line, "RECORD LENGTH");
        if (length_at == std::string_view::npos) continue;
        std::string_view rest = line.substr(std::min(line.find('=', length_at), line.size() - 1) + 1);
        const std::optional<double> length = parse_real(take_token(rest));
        if (!length) continue;
        check_record_length(file, block.line, block.count, block.dt, *length, index);
    }
}

// even samples below the lines that announce them, from line `index`, which is left behind them
void read_blocks(const TextFile& file, std::size_t start, std::size_t text_lines, std::size_t& index, SampleQuantity wanted,
                 CsmipChannel& channel) {
    const std::size_t headers_end = std::min(file.size(), start + 60);  // longest header known: 46 lines
    while (index < headers_end && !announces_samples(file.line(index))) ++index;
    if (index == headers_end) {
        file.fail(start, "no line announces samples (neither evenly spaced nor pairs in sec and g/10)", "fetch the record again");
    }

    // volume 2 holds three blocks, of which one is wanted; all are read, so that damage anywhere is seen
    while (announces_samples(file.line(index))) {
        const BlockHeader block = read_block_header(file, index);
        check_header(file, start, text_lines, block);
        std::vector<double> samples = read_block(file, {block.line + 1, block.count, block.columns}, block.unit.si);
        index = block.line + 1 + lines_of(block.count, block.columns);
        if (block.unit.quantity != wanted || channel.series) continue;
        channel.unit = block.unit;
        channel.series.emplace(wanted, 0.0 * scaling::si::seconds, block.dt, std::move(samples));
    }
    if (!channel.series)
        file.fail(start, fmt::format("channel has no {}", to_string(wanted)), Remedy{"give another value for ", Setting::quantity});
}

// (time, value) pairs of the channel that starts on line `index`, which is left behind them
void read_pairs(const TextFile& file, std::size_t& index, SampleQuantity wanted, CsmipChannel& channel) {
    if (wanted != SampleQuantity::acceleration) {
        file.fail(index, fmt::format("channel has no {}", to_string(wanted)), Remedy{"give another value for ", Setting::quantity});
    }
    ResampledSeries resampled = read_volume1_pairs(file, index);
    channel.unit = kTenthOfG;
    channel.note = std::move(resampled.note);
    channel.series = std::move(resampled.series);
}

// one channel from line `index`; leaves `index` behind its end mark
CsmipChannel read_channel(const TextFile& file, std::size_t& index, SampleQuantity wanted) {
    const std::size_t start = index;
    CsmipChannel channel;
    channel.is_corrected = starts_with_ignoring_case(file.line(start), "CORRECTED ACCELEROGRAM");
    if (!channel.is_corrected && !starts_with_ignoring_case(file.line(start), "UNCORRECTED ACCELEROGRAM DATA")) {
        file.fail(start, "channel header is missing (no 'Corrected accelerogram' or 'Uncorrected Accelerogram Data')",
                  "fetch the record again");
    }
    const std::size_t text_lines = channel.is_corrected ? 25 : kFewestTextLines;

    // title and samples stand below a fixed number of header lines
    std::size_t title = start;
    while (title < start + text_lines && !starts_with_ignoring_case(trim(file.line(title)), "CHAN")) ++title;
    if (title == start + text_lines) file.fail(start, "channel title is missing (no 'Chan n: direction')", "fetch the record again");
    channel.direction = read_csmip_title(file.line(title));
    check_stored_azimuth(file, title, start + text_lines + 1, channel.direction);

    if (!channel.is_corrected && announces_volume1_pairs(file, start)) {
        read_pairs(file, index, wanted, channel);
    } else {
        index = start + text_lines;
        read_blocks(file, start, text_lines, index, wanted, channel);
    }

    if (!file.line(index).starts_with("/&")) {
        file.fail(std::min(index, file.size() - 1), "end mark '/&' of the channel is missing (truncated, or more samples than announced)",
                  "fetch the record again");
    }
    ++index;
    return channel;
}

// "Start time:  7/06/19, 03:16: 8.0 UTC (GPS)"; a trigger time is later than the first sample where the recorder remembers, and not read
std::optional<UtcTime> find_start_time(const TextFile& file, std::size_t start, std::size_t text_lines) {
    constexpr std::string_view kLabel = "Start time:";
    constexpr int kOldestYear = 70;  // two digits stand for 1970 to 2069
    for (std::size_t index = start; index < std::min(file.size(), start + text_lines); ++index) {
        const std::size_t at = find_ignoring_case(file.line(index), kLabel);
        if (at == std::string_view::npos) continue;
        std::string_view rest = file.line(index).substr(at + kLabel.size());
        constexpr std::string_view kGaps = " /,:";
        std::array<int, 5> numbers{};  // month, day, year, hour, minute
        for (int& number : numbers) {
            const std::string_view digits = take_token(rest, kGaps);
            const auto value = digits.size() <= 2 ? parse_count(digits) : std::nullopt;
            if (!value) return std::nullopt;
            number = static_cast<int>(*value);
        }
        const auto second = parse_real(take_token(rest, kGaps));
        if (!second || take_token(rest) != "UTC") return std::nullopt;
        const int year = numbers[2] + (numbers[2] < kOldestYear ? 2000 : 1900);
        return make_utc_time(year, numbers[0], numbers[1], numbers[3], numbers[4], *second);
    }
    return std::nullopt;
}

}  // namespace

GroundMotion parse_csmip(const TextFile& file, const ReadOptions& options) {
    const SampleQuantity wanted = options.quantity.value_or(SampleQuantity::acceleration);
    GroundMotion motion{.source = file.path().string()};
    bool is_corrected = false;
    std::vector<std::string> notes;
    for (std::size_t index = 0; index < file.size();) {
        if (file.line(index).empty()) {
            ++index;
            continue;
        }
        const std::size_t start = index;
        CsmipChannel channel = read_channel(file, index, wanted);
        refuse_contradictions(file, options, channel.unit, channel.series->dt());
        if (motion.components.empty()) {
            is_corrected = channel.is_corrected;
            motion.event = first_field(file.line(start + (is_corrected ? 2 : 1)));
            motion.station = first_field(file.line(start + (is_corrected ? 6 : 5)));
            motion.time_zero = find_start_time(file, start, kFewestTextLines);
        }
        if (!channel.note.empty()) notes.push_back(fmt::format("{}: {}", channel.direction.name, channel.note));
        motion.components.push_back({std::move(channel.direction.name), channel.direction.azimuth_deg, *std::move(channel.series)});
    }
    if (motion.components.empty()) file.fail("file has no channel (no header)", "fetch the record again");
    motion.format = is_corrected ? "CSMIP V2" : "CSMIP V1";
    if (!is_corrected) motion.integration_corner = kUncorrectedCornerHz * scaling::si::hertz;
    motion.history.push_back(fmt::format("read {} from {}", motion.format, file.path().filename().string()));
    motion.history.insert(motion.history.end(), notes.begin(), notes.end());
    return motion;
}

}  // namespace musim::records::detail
