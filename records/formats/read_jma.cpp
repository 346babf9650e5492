#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "records/detail/text.hpp"
#include "records/formats/detail/parsers.hpp"
#include "records/formats/detail/table.hpp"
#include "records/headers/direction.hpp"
#include "records/headers/header_fields.hpp"

namespace musim::records::detail {
namespace {

constexpr double kJmaHoursAhead = 9.0;
constexpr std::size_t kLongestJmaHeader = 20;  // lines; met: 7

/// A line `NAME = text`; commas, which spreadsheets add behind it, are no part of it.
std::optional<HeaderField> find_jma_field(const TextFile& file, std::string_view name) {
    for (std::size_t index = 0; index < kLongestJmaHeader; ++index) {
        std::string_view line = trim(file.line(index));
        if (find_ignoring_case(line, name) != 0) continue;
        line = trim(line.substr(name.size()));
        if (!line.starts_with('=')) continue;
        line = trim(line.substr(1));
        while (line.ends_with(',')) line = trim(line.substr(0, line.size() - 1));
        return HeaderField{index, line};
    }
    return std::nullopt;
}

HeaderField require_jma_field(const TextFile& file, std::string_view name) {
    const std::optional<HeaderField> field = find_jma_field(file, name);
    if (field && !field->text.empty()) return *field;
    file.fail(fmt::format("header has no '{} ='", name), "fetch the record again");
}

// "gal(cm/s/s)"
SampleUnit read_jma_unit(const TextFile& file) {
    const HeaderField field = require_jma_field(file, "UNIT");
    const std::optional<SampleUnit> unit = find_sample_unit(field.text.substr(0, field.text.find('(')));
    if (unit && unit->quantity == SampleQuantity::acceleration) return *unit;
    file.fail(field.line, fmt::format("UNIT is {} (no unit of acceleration)", quoted(field.text)), "correct the header");
}

// "100Hz"
scaling::Time read_jma_step(const TextFile& file) {
    const HeaderField field = require_jma_field(file, "SAMPLING RATE");
    const std::optional<double> rate = parse_real(trim(field.text.substr(0, find_ignoring_case(field.text, "HZ"))));
    if (!rate || !(*rate > 0.0))
        file.fail(field.line, fmt::format("SAMPLING RATE is {} (must be positive, in Hz)", quoted(field.text)), "correct the header");
    return checked_dt(file, field.line, 1.0 / *rate);
}

// "2024 01 01 16 10 08.5", Japan's time
std::optional<UtcTime> read_jma_start(const TextFile& file) {
    const std::optional<HeaderField> field = find_jma_field(file, "INITIAL TIME");
    if (!field || field->text.empty()) return std::nullopt;
    std::string_view rest = field->text;
    constexpr std::string_view kGaps = " \t/:-T";
    std::array<int, 5> parts{};
    for (int& part : parts) {
        const std::string_view word = take_token(rest, kGaps);
        const std::optional<std::size_t> number = word.size() <= 4 ? parse_count(word) : std::nullopt;
        part = number ? static_cast<int>(*number) : -1;
    }
    const std::optional<double> second = parse_real(take_token(rest, kGaps));
    const std::optional<UtcTime> time =
        make_utc_time(parts[0], parts[1], parts[2], parts[3], parts[4], second.value_or(-1.0), kJmaHoursAhead);
    if (!time) file.fail(field->line, fmt::format("INITIAL TIME is {} (no date and time)", quoted(field->text)), "correct the header");
    return time;
}

// the line of titles, "NS,EW,UD", with up to three names of axes and nothing else
std::vector<std::string_view> find_jma_titles(const TextFile& file, std::size_t& index) {
    for (index = 0; index < std::min(file.size(), kLongestJmaHeader); ++index) {
        std::vector<std::string_view> names;
        std::string_view rest = file.line(index);
        for (std::string_view name = take_token(rest, " \t,"); !name.empty(); name = take_token(rest, " \t,")) names.push_back(name);
        if (!names.empty() && std::all_of(names.begin(), names.end(), is_axis)) return names;
    }
    file.fail("no line names the columns (NS,EW,UD)", "fetch the record again");
}

// the code before the name, which is written in Japan's letters of one encoding or another
std::string read_jma_site(const TextFile& file) {
    const HeaderField field = require_jma_field(file, "SITE CODE");
    const auto end =
        std::find_if(field.text.begin(), field.text.end(), [](char letter) { return letter == ',' || letter < ' ' || letter > '~'; });
    return std::string(trim(field.text.substr(0, static_cast<std::size_t>(end - field.text.begin()))));
}

}  // namespace

bool looks_like_jma(const TextFile& file) { return find_jma_field(file, "SITE CODE") && find_jma_field(file, "SAMPLING RATE"); }

GroundMotion parse_jma(const TextFile& file, const ReadOptions& options) {
    const SampleUnit unit = read_jma_unit(file);
    const scaling::Time dt = read_jma_step(file);
    refuse_contradictions(file, options, unit, dt);
    std::size_t titles_line = 0;
    const std::vector<std::string_view> names = find_jma_titles(file, titles_line);
    NumberTable table = read_table(file, titles_line + 1, std::vector<double>(names.size(), unit.si));

    GroundMotion motion{.source = file.path().string(), .format = "JMA"};
    motion.station = read_jma_site(file);
    motion.time_zero = read_jma_start(file);
    for (std::size_t i = 0; i < names.size(); ++i) {
        motion.components.push_back({.name = std::string(names[i]),
                                     .azimuth_deg = azimuth_of_axis(names[i]),
                                     .series = {unit.quantity, 0.0 * scaling::si::seconds, dt, std::move(table.columns[i])}});
    }
    motion.integration_corner = kUncorrectedCornerHz * scaling::si::hertz;  // the instrument's offset is left in
    motion.history.push_back(fmt::format("read {} from {}, unit {}", motion.format, file.path().filename().string(), unit.name));
    return motion;
}

}  // namespace musim::records::detail
