#include <fmt/format.h>

#include <array>

#include "records/detail/text.hpp"
#include "records/formats/detail/column_unit.hpp"
#include "records/formats/detail/parsers.hpp"
#include "records/formats/detail/table.hpp"
#include "records/headers/direction.hpp"

namespace musim::records::detail {
namespace {

constexpr std::size_t kColumns = 4;

/// A column's title, "N-S(cm/s/s)".
struct Title {
    std::string_view name;
    std::string_view unit;
};

// comment lines on top; the last one holds the titles
std::size_t count_header_lines(const TextFile& file) {
    std::size_t lines = 0;
    while (file.line(lines).starts_with('#')) ++lines;
    return lines;
}

// "#    time(sec)      N-S(cm/s/s) ..." or "# Time (s), NS (cm/s), ...": time and three axes; nothing for anything else
std::optional<std::array<Title, kColumns>> find_titles(const TextFile& file) {
    const std::size_t lines = count_header_lines(file);
    if (lines == 0) return std::nullopt;
    std::string_view rest = file.line(lines - 1).substr(1);
    std::array<Title, kColumns> titles;
    for (Title& title : titles) {
        const std::size_t open = rest.find('(');
        const std::size_t close = rest.find(')');
        if (close == std::string_view::npos || open > close) return std::nullopt;
        std::string_view name = rest.substr(0, open);
        title = {take_token(name, " \t,"), rest.substr(open + 1, close - open - 1)};
        rest.remove_prefix(close + 1);
    }
    const bool is_seconds = read_column_unit(titles[0].unit).seconds == 1.0;
    if (!equal_ignoring_case(titles[0].name, "time") || !is_seconds || !trim(rest).empty()) return std::nullopt;
    for (std::size_t i = 1; i < kColumns; ++i)
        if (!is_axis(titles.at(i).name)) return std::nullopt;
    return titles;
}

// true when a line above the titles speaks of an acceleration
bool names_acceleration(const TextFile& file, std::size_t titles_line) {
    for (std::size_t index = 0; index < titles_line; ++index) {
        if (contains_ignoring_case(file.line(index), "acceleration")) return true;
    }
    return false;
}

// some accelerations are titled "cm/s" by mistake: the word in the text above decides
SampleUnit read_unit(const TextFile& file, std::size_t index, const std::array<Title, kColumns>& titles) {
    for (std::size_t i = 1; i < kColumns; ++i) {
        if (titles.at(i).unit != titles[1].unit) {
            file.fail(
                index,
                fmt::format("units {} and {} differ (columns must hold one quantity)", quoted(titles[1].unit), quoted(titles.at(i).unit)),
                "split the file");
        }
    }
    const std::optional<SampleUnit> unit = find_sample_unit(titles[1].unit);
    if (!unit) {
        file.fail(index, fmt::format("unit {} is unknown (known: {})", quoted(titles[1].unit), sample_unit_names()), "correct the titles");
    }
    const bool is_mistaken = unit->quantity == SampleQuantity::velocity && names_acceleration(file, index);
    return is_mistaken ? *find_sample_unit(fmt::format("{}^2", unit->name)) : *unit;
}

}  // namespace

bool looks_like_bbp(const TextFile& file) { return find_titles(file).has_value(); }

GroundMotion parse_bbp(const TextFile& file, const ReadOptions& options) {
    const std::size_t header_lines = count_header_lines(file);
    const std::optional<std::array<Title, kColumns>> titles = find_titles(file);
    if (!titles) file.fail("no comment names the columns (time and three axes)", "check the file");
    const SampleUnit unit = read_unit(file, header_lines - 1, *titles);
    NumberTable table = read_table(file, header_lines, std::array{1.0, unit.si, unit.si, unit.si});
    const scaling::Time dt = checked_dt(file, table.lines.front(), even_time_step(file, table.columns.front(), table.lines));
    const scaling::Time start = table.columns.front().front() * scaling::si::seconds;
    refuse_contradictions(file, options, unit, dt);

    GroundMotion motion{.source = file.path().string(), .format = "SCEC BBP"};
    for (std::size_t i = 1; i < kColumns; ++i) {
        const std::string_view name = titles->at(i).name;
        motion.components.push_back({.name = std::string(name),
                                     .azimuth_deg = azimuth_of_axis(name),
                                     .series = {unit.quantity, start, dt, std::move(table.columns[i])}});
    }
    motion.history.push_back(fmt::format("read {} from {}, unit {} (titled {})", motion.format, file.path().filename().string(), unit.name,
                                         quoted(titles->at(1).unit)));
    return motion;
}

}  // namespace musim::records::detail
