#include "records/read_csmip.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "records/detail/fixed_columns.hpp"
#include "records/detail/parsers.hpp"
#include "records/detail/text.hpp"

namespace musim::records {
namespace detail {
namespace {

/// One block of samples, or rather the line that announces it.
struct BlockHeader {
    std::size_t line = 0;
    std::size_t count = 0;
    scaling::Time dt = {};
    SampleUnit unit = {};
    FixedColumns columns = {};
};

struct Channel {
    std::string name;
    std::optional<double> azimuth_deg;
    std::optional<TimeSeries> series;  ///< of the wanted quantity
    SampleUnit unit;
    bool is_corrected = false;
};

bool starts_with_ignoring_case(std::string_view line, std::string_view start) { return find_ignoring_case(line, start) == 0; }

bool announces_samples(std::string_view line) {
    return contains_ignoring_case(line, "ACCELEROGRAM POINTS AT") || contains_ignoring_case(line, "DATA EQUALLY SPACED AT");
}

// text up to the next gap of three blanks: header lines hold several fields
std::string first_field(std::string_view line) { return std::string(trim(line.substr(0, line.find("   ")))); }

// "(8f9.6)" somewhere in the line; nothing when the file leaves it out
std::optional<FixedColumns> find_columns(std::string_view line) {
    for (std::size_t open = line.find('('); open != std::string_view::npos; open = line.find('(', open + 1)) {
        std::string_view rest = line.substr(open + 1);
        const std::size_t letter = rest.find_first_of("fFeE");
        if (letter == std::string_view::npos) continue;
        const std::optional<std::size_t> per_line = parse_count(rest.substr(0, letter));
        rest.remove_prefix(letter + 1);
        const std::optional<std::size_t> width = parse_count(take_token(rest, ".)"));
        if (per_line && width && *per_line > 0 && *width > 0) return FixedColumns{*per_line, *width};
    }
    return std::nullopt;
}

// without a format the first line of samples tells: eight right-justified numbers of equal width
FixedColumns infer_columns(const TextFile& file, std::size_t line, std::size_t count) {
    const FixedColumns usual;
    const std::size_t values = std::min(count, usual.per_line);
    const std::size_t length = file.line(line + 1).size();
    if (length == 0 || length % values != 0) {
        file.fail(line + 1, fmt::format("column width cannot be told ({} letters for {} values)", length, values),
                  "add the Fortran format, e.g. (8f10.3), to the line above");
    }
    return {usual.per_line, length / values};
}

SampleUnit read_unit(const TextFile& file, std::size_t index) {
    const std::string_view line = file.line(index);
    for (const std::string_view phrase : {std::string_view("UNITS OF"), std::string_view("UNITS:"), std::string_view(", IN ")}) {
        const std::size_t found = find_ignoring_case(line, phrase);
        if (found == std::string_view::npos) continue;
        std::string_view rest = line.substr(found + phrase.size());
        const std::string_view name = take_token(rest, " )");
        if (const std::optional<SampleUnit> unit = find_sample_unit(name)) return *unit;
        file.fail(index, fmt::format("unit {} is unknown (known: {})", quoted(name), sample_unit_names()), "correct the line");
    }
    file.fail(index, "unit is missing (no 'units of')", "write e.g. 'in units of g'");
}

// "32080 Accelerogram points at 100 pts/sec in units of g.       Format: (8f9.6)"
// " 7500 points of accel data equally spaced at  .010 sec, in cm/sec2. (8f10.6)"
BlockHeader read_block_header(const TextFile& file, std::size_t index) {
    const std::string_view line = file.line(index);
    BlockHeader header{.line = index, .unit = read_unit(file, index)};

    std::string_view rest = line;
    const std::string_view count = take_token(rest);
    const std::optional<std::size_t> points = parse_count(count);
    if (!points || *points == 0) {
        file.fail(index, fmt::format("number of points {} is unusable (must be a positive integer)", quoted(count)), "correct the line");
    }
    header.count = *points;

    rest = line.substr(find_ignoring_case(line, " AT ") + 4);
    const std::string_view number = take_token(rest);
    const bool is_rate = starts_with_ignoring_case(trim(rest), "PTS");
    const std::optional<double> step = parse_real(number);
    if (!step) file.fail(index, fmt::format("time step {} is no number", quoted(number)), "correct the line");
    header.dt = checked_dt(file, index, is_rate ? 1.0 / *step : *step);

    header.columns = find_columns(line).value_or(FixedColumns{});
    if (header.columns.width == 0) header.columns = infer_columns(file, index, header.count);
    return header;
}

// "Chan  2: 360 Deg   Location: Abutment 1" → "360", 360°; "Chan 3: Up" → "Up", no azimuth
void read_orientation(std::string_view title, Channel& channel) {
    std::string_view rest = title.substr(title.find(':') + 1);
    rest = rest.substr(0, find_ignoring_case(rest, "Location"));
    const std::string orientation = first_field(trim(rest));
    const std::size_t degrees = find_ignoring_case(orientation, " DEG");
    channel.name = trim(std::string_view(orientation).substr(0, degrees));
    if (degrees != std::string_view::npos) channel.azimuth_deg = parse_real(channel.name);
}

// direction as text and as the 11th of the 16 five-letter integers on the second line of the integer header: 0 and -999 stand for unknown
void check_azimuth(const TextFile& file, std::size_t title_line, std::size_t integer_line, const Channel& channel) {
    if (!channel.azimuth_deg) return;
    constexpr std::size_t kAzimuthColumn = 50;
    constexpr std::size_t kIntegerWidth = 5;
    const std::string_view line = file.line(integer_line);
    if (line.size() < kAzimuthColumn + kIntegerWidth) return;
    const std::optional<double> stored = parse_real(trim(line.substr(kAzimuthColumn, kIntegerWidth)));
    if (!stored || *stored == 0.0 || *stored == -999.0) return;
    if (std::fmod(*stored, 360.0) != std::fmod(*channel.azimuth_deg, 360.0) || *stored > 360.0) {
        file.fail(integer_line,
                  fmt::format("azimuth is {} (line {} says {} Deg; header is damaged)", *stored, title_line + 1, channel.name),
                  "fetch the record again or correct the header");
    }
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
        if (!length || *length <= 0.0) continue;
        // 1 % and two steps: the length is rounded to whole seconds or counts one sample less
        const double dt = block.dt.value();
        if (std::abs(static_cast<double>(block.count) * dt - *length) > 0.01 * *length + 2.0 * dt) {
            file.fail(block.line, fmt::format("{} points of {} s do not make the {} s of line {}", block.count, dt, *length, index + 1),
                      "correct the time step or the number of points");
        }
    }
}

// one channel from line `index`; leaves `index` behind its end mark
Channel read_channel(const TextFile& file, std::size_t& index, SampleQuantity wanted) {
    const std::size_t start = index;
    Channel channel;
    channel.is_corrected = starts_with_ignoring_case(file.line(start), "CORRECTED ACCELEROGRAM");
    if (!channel.is_corrected && !starts_with_ignoring_case(file.line(start), "UNCORRECTED ACCELEROGRAM DATA")) {
        file.fail(start, "channel header is missing (no 'Corrected accelerogram' or 'Uncorrected Accelerogram Data')",
                  "fetch the record again");
    }
    const std::size_t text_lines = channel.is_corrected ? 25 : 13;

    // title and samples stand below a fixed number of header lines
    std::size_t title = start;
    while (title < start + text_lines && !starts_with_ignoring_case(trim(file.line(title)), "CHAN")) ++title;
    if (title == start + text_lines) file.fail(start, "channel title is missing (no 'Chan n: direction')", "fetch the record again");
    read_orientation(file.line(title), channel);
    check_azimuth(file, title, start + text_lines + 1, channel);

    index = start + text_lines;
    const std::size_t headers_end = std::min(file.size(), start + 60);  // longest header known: 46 lines
    while (index < headers_end && !announces_samples(file.line(index))) ++index;
    if (index == headers_end) {
        file.fail(start, "no line announces evenly spaced samples (uneven (time, value) pairs are not supported)",
                  "use the corrected record (V2)");
    }

    // volume 2 holds three blocks, of which one is wanted; all are read, so that damage anywhere is seen
    while (announces_samples(file.line(index))) {
        const BlockHeader block = read_block_header(file, index);
        check_header(file, start, text_lines, block);
        std::vector<double> samples = read_fixed_columns(file, block.line + 1, block.count, block.columns, block.unit.si);
        index = block.line + 1 + block.columns.lines_of(block.count);
        if (block.unit.quantity != wanted || channel.series) continue;
        channel.unit = block.unit;
        channel.series.emplace(wanted, 0.0 * scaling::si::seconds, block.dt, std::move(samples));
    }
    if (!channel.series) file.fail(start, fmt::format("channel has no {}", to_string(wanted)), "ask for another --quantity");

    if (!file.line(index).starts_with("/&")) {
        file.fail(std::min(index, file.size() - 1), "end mark '/&' of the channel is missing (truncated, or more samples than announced)",
                  "fetch the record again");
    }
    ++index;
    return channel;
}

}  // namespace

GroundMotion parse_csmip(const TextFile& file, const ReadOptions& options) {
    const SampleQuantity wanted = options.quantity.value_or(SampleQuantity::acceleration);
    GroundMotion motion{.source = file.path().string()};
    bool is_corrected = false;
    for (std::size_t index = 0; index < file.size();) {
        if (file.line(index).empty()) {
            ++index;
            continue;
        }
        const std::size_t start = index;
        Channel channel = read_channel(file, index, wanted);
        refuse_contradictions(file, options, channel.unit, channel.series->dt());
        if (motion.components.empty()) {
            is_corrected = channel.is_corrected;
            motion.event = first_field(file.line(start + (is_corrected ? 2 : 1)));
            motion.station = first_field(file.line(start + (is_corrected ? 6 : 5)));
        }
        motion.components.push_back({std::move(channel.name), channel.azimuth_deg, *std::move(channel.series)});
    }
    motion.format = is_corrected ? "CSMIP V2" : "CSMIP V1";
    if (!is_corrected) motion.integration_corner = kUncorrectedCornerHz * scaling::si::hertz;
    motion.history.push_back(fmt::format("read {} from {}", motion.format, file.path().filename().string()));
    return motion;
}

}  // namespace detail

GroundMotion read_csmip(const std::filesystem::path& path, const ReadOptions& options) {
    return detail::parse_csmip(detail::TextFile(path, detail::read_bytes(path)), options);
}

}  // namespace musim::records
