#include <fmt/format.h>

#include <array>
#include <cmath>

#include "records/detail/text.hpp"
#include "records/formats/detail/parsers.hpp"
#include "records/formats/detail/streams.hpp"
#include "records/headers/header_fields.hpp"

namespace musim::records::detail {
namespace {

constexpr std::string_view kSeriesTitle = "TIMESERIES ";

/// "TIMESERIES XX_ABC__HNE_D, 4000 samples, 200 sps, 2024-04-02T00:01:40.000000, SLIST, FLOAT, M/S**2": one piece of a stream.
struct SeriesHeader {
    std::size_t line = 0;
    std::size_t count = 0;
    bool has_times = false;  ///< TSPAIR: each sample behind its time
    Stream piece = {};
};

// "XX_ABC__HNE_D", "XX.ABC.--.HNE.D", "FDSN:XX_ABC__H_N_E"; the last of five is a quality letter
std::optional<StreamCodes> parse_series_name(std::string_view name) {
    if (name.starts_with("FDSN:")) return parse_source_identifier(name);
    const char gap = name.find('_') == std::string_view::npos ? '.' : '_';
    std::array<std::string, 5> parts;
    std::size_t part = 0;
    for (const char letter : name) {
        if (letter == gap) {
            if (++part == parts.size()) return parse_source_identifier(name);
        } else {
            parts.at(part) += letter;
        }
    }
    if (part + 2 < parts.size()) return std::nullopt;  // the quality may be missing
    if (parts[2] == "--") parts[2].clear();
    return StreamCodes{parts[0], parts[1], parts[2], parts[3]};
}

// "2024-04-02T00:01:40.000000Z"; '-' within the date, letters and 'Z' around the time
std::optional<UtcTime> parse_series_time(std::string_view text) {
    std::string plain(text);
    if (plain.ends_with('Z')) plain.pop_back();
    for (char& letter : plain) {
        if (letter == '-') letter = '/';
        if (letter == 'T') letter = ' ';
    }
    return parse_date_time(plain);
}

// the number before a word: "4000 samples"
std::string_view number_of(std::string_view field, std::string_view word) {
    const std::string_view number = take_token(field);
    return trim(field) == word ? number : std::string_view{};
}

std::vector<std::string_view> split_at_commas(std::string_view text) {
    std::vector<std::string_view> fields;
    while (!text.empty()) {
        const std::size_t comma = text.find(',');
        fields.push_back(trim(text.substr(0, comma)));
        text = comma == std::string_view::npos ? std::string_view{} : text.substr(comma + 1);
    }
    return fields;
}

// "M/S**2" names a unit, "Counts" or nothing none
std::optional<SampleUnit> read_series_unit(const TextFile& file, std::size_t index, std::string_view text) {
    if (text.empty() || equal_ignoring_case(text, "Counts") || equal_ignoring_case(text, "Count")) return std::nullopt;
    if (const std::optional<SampleUnit> unit = find_sample_unit(text)) return unit;
    file.fail(index, fmt::format("unit {} is unknown (known: counts, {})", quoted(text), sample_unit_names()), "correct the header");
}

SeriesHeader read_series_header(const TextFile& file, std::size_t index) {
    enum Field : std::size_t { kName, kSeriesCount, kSeriesRate, kStart, kForm, kKind, kUnit, kFields };
    std::vector<std::string_view> fields = split_at_commas(file.line(index).substr(kSeriesTitle.size()));
    if (fields.size() + 1 < kFields) {
        file.fail(index, fmt::format("header has {} fields (name, samples, rate, start, form, kind and unit are needed)", fields.size()),
                  "fetch the record again");
    }
    fields.resize(kFields);
    SeriesHeader header{.line = index};
    const std::optional<StreamCodes> codes = parse_series_name(printable(fields[kName]));
    if (!codes) file.fail(index, fmt::format("{} is no name of a stream (NET_STA_LOC_CHA_QUALITY)", quoted(fields[kName])), "correct it");
    const std::optional<std::size_t> count = parse_count(number_of(fields[kSeriesCount], "samples"));
    if (!count) file.fail(index, fmt::format("{} is no number of samples", quoted(fields[kSeriesCount])), "correct the header");
    const std::optional<double> rate = parse_real(number_of(fields[kSeriesRate], "sps"));
    if (!rate) file.fail(index, fmt::format("{} is no sample rate ('200 sps')", quoted(fields[kSeriesRate])), "correct the header");
    const std::optional<UtcTime> start = parse_series_time(fields[kStart]);
    if (!start) file.fail(index, fmt::format("start is {} (no date and time)", quoted(fields[kStart])), "correct the header");
    header.has_times = equal_ignoring_case(fields[kForm], "TSPAIR");
    if (!header.has_times && !equal_ignoring_case(fields[kForm], "SLIST"))
        file.fail(index, fmt::format("form is {} (read: SLIST, TSPAIR)", quoted(fields[kForm])), "fetch the record in another form");
    if (!equal_ignoring_case(fields[kKind], "INTEGER") && !equal_ignoring_case(fields[kKind], "FLOAT"))
        file.fail(index, fmt::format("samples are {} (read: INTEGER, FLOAT)", quoted(fields[kKind])), "fetch another channel");
    header.count = *count;
    header.piece = {.codes = *codes, .first = *start, .rate = *rate, .unit = read_series_unit(file, index, fields[kUnit])};
    return header;
}

// "# SID: XX_ABC__HNE", "# sample_rate_hz: 20", ... from line `index` on, which is left at the line of titles behind them
SeriesHeader read_geocsv_header(const TextFile& file, std::size_t& index) {
    const std::size_t first = index;
    while (file.line(index).starts_with('#')) ++index;
    const auto find = [&](std::string_view name) -> std::string_view {
        for (std::size_t line = first; line < index; ++line) {
            const std::string_view text = trim(file.line(line).substr(1));
            if (text.starts_with(name) && text.substr(name.size()).starts_with(':')) return trim(text.substr(name.size() + 1));
        }
        return {};
    };
    const auto require = [&]<class Value>(std::string_view name, const std::optional<Value>& value) {
        if (!value) file.fail(first, fmt::format("{} is {} (missing or unusable)", name, quoted(find(name))), "correct the header");
        return *value;
    };
    SeriesHeader header{.line = first};
    header.piece.codes = require("SID", parse_series_name(printable(find("SID"))));
    header.count = require("sample_count", parse_count(find("sample_count")));
    header.piece.rate = require("sample_rate_hz", parse_real(find("sample_rate_hz")));
    header.piece.first = require("start_time", parse_series_time(find("start_time")));
    const std::vector<std::string_view> units = split_at_commas(find("field_unit"));  // "UTC, Counts" with times
    header.has_times = units.size() > 1;
    header.piece.unit = read_series_unit(file, first, units.empty() ? std::string_view{} : units.back());

    // counts with the factor that they are divided by
    const double factor = parse_real(find("scale_factor")).value_or(0.0);
    if (!header.piece.unit && factor != 0.0) {
        header.piece.unit = read_series_unit(file, first, find("scale_units"));
        if (header.piece.unit) header.piece.unit->si /= factor;
    }
    constexpr double kVertical = 90.0;  // [deg]
    const std::optional<double> dip = parse_real(find("dip_deg"));
    if (dip && std::abs(*dip) != kVertical) header.piece.azimuth_deg = parse_real(find("azimuth_deg"));
    return header;
}

bool is_geocsv(std::string_view line) { return line.starts_with('#') && trim(line.substr(1)).starts_with("dataset: GeoCSV"); }

bool begins_series(const TextFile& file, std::size_t index) {
    return file.line(index).starts_with(kSeriesTitle) || is_geocsv(file.line(index));
}

// a time is that of its place in the piece, to half a step
void check_series_time(const TextFile& file, std::size_t index, const SeriesHeader& header, std::size_t ordinal, std::string_view text) {
    const std::optional<UtcTime> time = parse_series_time(text);
    if (!time) file.fail(index, fmt::format("time is {} (no date and time)", quoted(text)), "repair the row");
    const double expected = static_cast<double>(ordinal) / header.piece.rate;
    const double elapsed = std::chrono::duration<double>(*time - header.piece.first).count();
    if (!(std::abs(elapsed - expected) * header.piece.rate <= 0.5)) {
        file.fail(index, fmt::format("time is {:.6f} s after the start (the sample rate gives {:.6f} s)", elapsed, expected),
                  "repair the row or correct the header");
    }
}

// the samples of a piece, behind its header; leaves `index` at the next header or the end
void read_series(const TextFile& file, const SeriesHeader& header, std::size_t& index, std::vector<double>& samples) {
    std::size_t found = 0;
    for (; index < file.size() && !begins_series(file, index); ++index) {
        std::string_view rest = file.line(index);
        const std::size_t above = found;
        const bool is_pair = header.has_times && !trim(rest).empty();
        if (is_pair) check_series_time(file, index, header, found, take_token(rest, " \t,"));
        for (std::string_view word = take_token(rest, " \t,"); !word.empty(); word = take_token(rest, " \t,")) {
            if (++found > header.count) {
                file.fail(index, fmt::format("more samples than the {} of line {}", header.count, header.line + 1),
                          "correct the header or fetch the record again");
            }
            samples.push_back(checked_sample(file, index, word, found, 1.0));
        }
        if (is_pair && found != above + 1)
            file.fail(index, fmt::format("{} values behind a time (TSPAIR has one)", found - above), "repair the row");
    }
    if (found < header.count) {
        file.fail(index - 1, fmt::format("{} samples for the {} of line {} (file is truncated)", found, header.count, header.line + 1),
                  "fetch the record again or correct the header");
    }
}

}  // namespace

// GeoCSV may hold any table; series have a rate
bool looks_like_slist(const TextFile& file) {
    constexpr std::size_t kLongestHeader = 30;  // lines
    if (!is_geocsv(file.line(0))) return begins_series(file, 0);
    for (std::size_t index = 0; index < kLongestHeader && file.line(index).starts_with('#'); ++index)
        if (trim(file.line(index).substr(1)).starts_with("sample_rate_hz:")) return true;
    return false;
}

GroundMotion parse_slist(const TextFile& file, const ReadOptions& options) {
    std::vector<Stream> streams;
    std::string_view format = "SLIST";
    bool has_counts = false;
    for (std::size_t index = 0; index < file.size();) {
        if (trim(file.line(index)).empty()) {
            ++index;
            continue;
        }
        if (!begins_series(file, index)) file.fail(index, "header of a series is missing (no 'TIMESERIES ...')", "fetch the record again");
        const bool is_csv = is_geocsv(file.line(index));
        const SeriesHeader header = is_csv ? read_geocsv_header(file, index) : read_series_header(file, index);
        format = is_csv ? "GeoCSV" : header.has_times ? "TSPAIR" : "SLIST";
        has_counts = has_counts || !header.piece.unit;
        Stream& stream = continue_stream(streams, header.piece, [&](std::string_view what_why, const Remedy& what_to_do) {
            file.fail(header.line, what_why, what_to_do);
        });
        read_series(file, header, ++index, stream.samples);
    }
    std::erase_if(streams, [](const Stream& stream) { return stream.samples.empty(); });
    if (streams.empty()) file.fail("no samples (no series, or empty ones)", "fetch the record again");
    check_count_options(file, options, format, has_counts);
    return make_motion(file, format, std::move(streams), options);
}

}  // namespace musim::records::detail
