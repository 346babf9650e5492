#include "records/formats/detail/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "records/detail/text.hpp"
#include "records/formats/detail/parsers.hpp"
#include "records/formats/resample_uneven.hpp"

namespace musim::records::detail {
namespace {

constexpr std::string_view kTableSeparators = " \t,";

/// A clock of even steps.
struct EvenTimes {
    double start;
    double step;
    double rounding = 0.0;  ///< of printed times

    double time(std::size_t row) const { return start + static_cast<double>(row) * step; }
    bool meets(double time_of_row, std::size_t row) const {
        return std::abs(time_of_row - time(row)) <= std::max(kTimeJitter * step, rounding);
    }
    /// The first row whose time is off by more than a clock's jitter.
    std::optional<std::size_t> find_miss(std::span<const double> times) const {
        for (std::size_t row = 0; row < times.size(); ++row)
            if (!meets(times[row], row)) return row;
        return std::nullopt;
    }
    std::size_t count_misses(std::span<const double> times) const {
        std::size_t misses = 0;
        for (std::size_t row = 0; row < times.size(); ++row) misses += meets(times[row], row) ? 0 : 1;
        return misses;
    }
};

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// the clock that most rows keep
EvenTimes find_usual_times(std::span<const double> times) {
    std::vector<double> values;
    for (std::size_t row = 1; row < times.size(); ++row) values.push_back(times[row] - times[row - 1]);
    const double step = median(values);
    values.clear();
    for (std::size_t row = 0; row < times.size(); ++row) values.push_back(times[row] - static_cast<double>(row) * step);
    return {median(std::move(values)), step};
}

/// Step of times that are even but for rounding: where that is seen, a whole number of samples a second that explains all of them, else the
/// short decimal that the mean step means.
double find_rounded_step(std::span<const double> times, const EvenTimes& mean) {
    constexpr double kSeen = 1e-3;  // of a step; rounding below it does not hide the step
    const auto miss_of = [&](const EvenTimes& even) {
        double miss = 0.0;
        for (std::size_t row = 0; row < times.size(); ++row) miss = std::max(miss, std::abs(times[row] - even.time(row)));
        return miss;
    };
    if (mean.step < 1.0 && miss_of(mean) > kSeen * mean.step) {
        const EvenTimes whole_rate{times.front(), 1.0 / std::round(1.0 / mean.step)};
        if (miss_of(whole_rate) <= mean.rounding) return whole_rate.step;
    }
    return to_short_decimal(mean.step);
}

}  // namespace

std::string_view text_of_value(const TextFile& file, std::size_t begin, std::size_t ordinal) {
    for (std::size_t index = begin; index < file.size(); ++index) {
        std::string_view rest = file.line(index);
        for (std::string_view token = take_token(rest, kTableSeparators); !token.empty(); token = take_token(rest, kTableSeparators)) {
            if (ordinal-- == 0) return token;
        }
    }
    return {};
}

std::string_view text_in_table(const TextFile& file, const NumberTable& table, std::size_t row, std::size_t column) {
    return text_of_value(file, table.lines.at(row), column);
}

std::vector<double> read_values(const TextFile& file, std::size_t begin, std::size_t end, const AnnouncedCount& announced, double si) {
    constexpr std::size_t kReservedAtMost = 1U << 20U;  // values; a damaged count must not claim the memory
    std::vector<double> values;
    values.reserve(std::min(announced.count, kReservedAtMost));
    for (std::size_t index = begin; index < end; ++index) {
        std::string_view rest = file.line(index);
        for (std::string_view token = take_token(rest, kTableSeparators); !token.empty(); token = take_token(rest, kTableSeparators)) {
            const double sample = checked_sample(file, index, token, values.size() + 1, si);
            if (values.size() == announced.count) {
                file.fail(index, fmt::format("more values than {} = {} (header and data disagree)", announced.name, announced.count),
                          fmt::format("correct {} or fetch the record again", announced.name));
            }
            values.push_back(sample);
        }
    }
    if (values.size() < announced.count) {
        file.fail(std::max<std::size_t>(end, 1) - 1,
                  fmt::format("{} values for {} = {} (file is truncated)", values.size(), announced.name, announced.count),
                  fmt::format("fetch the record again or correct {}", announced.name));
    }
    return values;
}

NumberTable read_table(const TextFile& file, std::size_t begin, std::span<const double> si) {
    NumberTable table{.columns = std::vector<std::vector<double>>(si.size()), .lines = {}};
    for (std::size_t index = begin; index < file.size(); ++index) {
        std::string_view rest = file.line(index);
        if (trim(rest).empty()) continue;
        std::size_t column = 0;
        for (std::string_view token = take_token(rest, kTableSeparators); !token.empty(); token = take_token(rest, kTableSeparators)) {
            if (column < si.size()) table.columns[column].push_back(checked_sample(file, index, token, table.rows() + 1, si[column]));
            ++column;
        }
        if (column != si.size()) {
            file.fail(index, fmt::format("{} values (the header names {} columns)", column, si.size()), "repair the row");
        }
        table.lines.push_back(index);
    }
    if (table.lines.empty()) file.fail("no samples follow the header (file is truncated)", "fetch the record again");
    return table;
}

void check_rows(const TextFile& file, const NumberTable& table, const AnnouncedCount& announced) {
    if (table.rows() < announced.count) {
        file.fail(table.lines.back(), fmt::format("{} rows for {} = {} (file is truncated)", table.rows(), announced.name, announced.count),
                  fmt::format("fetch the record again or correct {}", announced.name));
    }
    if (table.rows() > announced.count) {
        file.fail(table.lines[announced.count],
                  fmt::format("more rows than {} = {} (header and data disagree)", announced.name, announced.count),
                  fmt::format("correct {} or fetch the record again", announced.name));
    }
}

double even_time_step(const TextFile& file, std::span<const double> times, std::span<const std::size_t> lines, double printed) {
    if (times.size() < 2) file.fail(lines.front(), "one row gives no time step (two at least are needed)", "fetch the record again");
    const double step = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
    constexpr double kDust = 1.01;  // rounding of both ends
    const EvenTimes mean{times.front(), step, printed <= 0.5 * step ? kDust * printed : 0.0};
    const std::optional<std::size_t> uneven = mean.find_miss(times);
    if (!uneven) return mean.rounding > 0.0 ? find_rounded_step(times, mean) : to_short_decimal(mean.step);

    // one wrong time at an end shifts the mean step of all; the medians show which it is
    const EvenTimes median_times = find_usual_times(times);
    const EvenTimes& usual = median_times.count_misses(times) < mean.count_misses(times) ? median_times : mean;
    const std::size_t row = usual.find_miss(times).value_or(*uneven);
    const bool may_be_counts =
        row == 0 && times[0] == std::floor(times[0]) && std::abs(times[0] - static_cast<double>(times.size())) <= 1.0;
    file.fail(lines[row],
              fmt::format("time is {:.10g} s (even sampling gives {:.9g} s{})", times[row], usual.time(row),
                          may_be_counts ? ", and as many rows follow: it may be the number of points" : ""),
              may_be_counts ? "remove the row" : "resample the record evenly");
}

}  // namespace musim::records::detail
