#include "records/formats/detail/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "records/detail/text.hpp"
#include "records/formats/detail/parsers.hpp"
#include "records/formats/resample_uneven.hpp"

namespace musim::records::detail {

std::vector<double> read_values(const TextFile& file, std::size_t begin, std::size_t end, const AnnouncedCount& announced, double si) {
    constexpr std::size_t kReservedAtMost = 1U << 20U;  // values; a damaged count must not claim the memory
    constexpr std::string_view kSeparators = " \t,";
    std::vector<double> values;
    values.reserve(std::min(announced.count, kReservedAtMost));
    for (std::size_t index = begin; index < end; ++index) {
        std::string_view rest = file.line(index);
        for (std::string_view token = take_token(rest, kSeparators); !token.empty(); token = take_token(rest, kSeparators)) {
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
    constexpr std::string_view kSeparators = " \t,";
    NumberTable table{.columns = std::vector<std::vector<double>>(si.size()), .lines = {}};
    for (std::size_t index = begin; index < file.size(); ++index) {
        std::string_view rest = file.line(index);
        if (trim(rest).empty()) continue;
        std::size_t column = 0;
        for (std::string_view token = take_token(rest, kSeparators); !token.empty(); token = take_token(rest, kSeparators)) {
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

double even_time_step(const TextFile& file, std::span<const double> times, std::span<const std::size_t> lines) {
    if (times.size() < 2) file.fail(lines.front(), "one row gives no time step (two at least are needed)", "fetch the record again");
    const double dt = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
    for (std::size_t row = 0; row < times.size(); ++row) {
        const double expected = times.front() + static_cast<double>(row) * dt;
        if (!(std::abs(times[row] - expected) <= kTimeJitter * dt)) {
            file.fail(lines[row], fmt::format("time is {} s (even sampling gives {:.6g} s)", times[row], expected),
                      "resample the record evenly");
        }
    }
    return to_short_decimal(dt);
}

}  // namespace musim::records::detail
