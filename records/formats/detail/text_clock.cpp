#include "records/formats/detail/text_clock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "records/detail/text.hpp"
#include "records/formats/detail/parsers.hpp"
#include "records/formats/detail/table.hpp"
#include "records/formats/detail/text_features.hpp"

namespace musim::records::detail {
namespace {

/// Times beyond it lose digits that a step needs [units of the column].
constexpr double kLargeTime = 1e6;

/// Seconds since 1970 of the years 1998 and 2103: between them a time is that of a clock.
constexpr double kFirstUnixTime = 9e8, kLastUnixTime = 4.2e9;

bool is_usual(double step) {
    constexpr double kDust = 1e-6;  // relative; of printed times
    return step >= kShortestStep * (1.0 - kDust) && step <= kLongestStep * (1.0 + kDust);
}

/// The unit of time in which a `step` is `dt` [s]; nothing when none is.
std::optional<double> find_unit_of(double step, double dt) {
    for (const double seconds : {1.0, 1e-3, 1e-6, 1e-9, 60.0, 3600.0})
        if (is_same_time_step(step * seconds, dt)) return seconds;
    return std::nullopt;
}

void check_dt(const TextFile& file, const ReadOptions& options) {
    if (options.dt && (!(options.dt->value() > 0.0) || !std::isfinite(options.dt->value()))) {
        file.fail(fmt::format("time step is {} s (must be positive)", options.dt->value()), {"correct ", Setting::time_step});
    }
}

/// Seconds of one unit of a column of times, by its title, the text above, or its step.
double find_seconds(const TextFile& file, const TextTable& table, const TextHeading& heading, std::size_t column, double step,
                    const ReadOptions& options) {
    const std::optional<double> given = options.dt ? std::optional(options.dt->value()) : heading.dt;
    if (given) {
        if (const std::optional<double> seconds = find_unit_of(step, *given)) return *seconds;
        if (is_index_column(table, column)) return *given;
    }
    const std::string strange = column < heading.titles.size() ? plain_unit_text(heading.titles[column].unknown_unit) : "";
    for (const std::string_view unit : {"d", "day", "days", "tick", "ticks", "sample", "samples", "week", "weeks", "year", "years"}) {
        if (strange != unit || given) continue;
        file.fail(heading.titles_line, fmt::format("{} is in {} (no unit of times that is read)", place_of(column, heading), quoted(unit)),
                  {"give ", Setting::time_step});
    }
    if (is_usual(step)) return 1.0;
    const std::string rises = fmt::format("{} rises by {:.6g} a row", place_of(column, heading), step);
    if (given) {
        file.fail(heading.titles_line, fmt::format("{} (in no unit of time that is {} s)", rises, *given),
                  {"correct ", Setting::time_step, " or leave the column out with ", Setting::columns});
    }
    file.fail(table.rows.front().line, rises + " (no unit of time is named, and so many seconds are not usual)",
              {"name the unit in its title, as in \"Time (ms)\", or give ", Setting::time_step});
}

TextClock read_times(const TextFile& file, const TextTable& table, const TextHeading& heading, std::size_t column,
                     const ReadOptions& options) {
    const bool is_instant = table.kind(column) == CellKind::instant;
    std::optional<double> seconds = is_instant ? std::optional(1.0) : heading.stated.seconds;
    if (!is_instant && column < heading.titles.size() && heading.titles[column].unit.seconds) seconds = heading.titles[column].unit.seconds;

    // large times, such as those since 1970, are counted from the first, which keeps their last digits
    const double first = table.at(0, column);
    const double zero = std::abs(first) > kLargeTime ? first : 0.0;
    std::vector<double> times;
    std::vector<std::size_t> lines;
    times.reserve(table.rows.size());
    lines.reserve(table.rows.size());
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        times.push_back((table.at(row, column) - zero) * seconds.value_or(1.0));
        lines.push_back(table.rows[row].line);
    }
    const double printed = find_printed_step(file, table, column) * seconds.value_or(1.0);
    double step = checked_dt(file, lines.front(), even_time_step(file, times, lines, printed)).value();
    double start = first * seconds.value_or(1.0);
    if (!seconds) {
        const double unit = find_seconds(file, table, heading, column, step, options);
        step = to_short_decimal(step * unit);
        start *= unit;
    }
    if (!is_instant && start >= kFirstUnixTime && start < kLastUnixTime) {
        return {0.0, step, find_instant(UtcTime{}, start * scaling::si::seconds)};
    }
    if (!is_instant) return {start, step};
    TextClock clock{.start = 0.0, .dt = step};
    const std::string title = column < heading.titles.size() ? heading.titles[column].text : "";
    if (table.zero && (table.is_utc || title.find("UTC") != std::string::npos || title.find("GMT") != std::string::npos)) {
        clock.zero = find_instant(*table.zero, start * scaling::si::seconds);
    }
    return clock;
}

}  // namespace

TextClock find_text_clock(const TextFile& file, const TextTable& table, const TextHeading& heading, const TextLayout& layout,
                          const ReadOptions& options) {
    check_dt(file, options);
    if (layout.time) return read_times(file, table, heading, *layout.time, options);
    if (layout.dt) return {0.0, checked_dt(file, table.rows.front().line, *layout.dt).value()};
    if (heading.dt) return {0.0, *heading.dt};
    if (options.dt) return {0.0, options.dt->value()};
    if (layout.index) {
        file.fail(table.rows.front().line,
                  fmt::format("time step is unknown ({} counts rows, and is no time)", place_of(*layout.index, heading)),
                  {"give ", Setting::time_step});
    }
    file.fail("time step is unknown (first column is not an evenly increasing time)", {"give ", Setting::time_step});
}

}  // namespace musim::records::detail
