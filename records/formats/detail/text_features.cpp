#include "records/formats/detail/text_features.hpp"

#include <algorithm>
#include <cmath>

#include "records/formats/detail/text_heading.hpp"

namespace musim::records::detail {
namespace {

/// Rows from which on values show what they are.
constexpr std::size_t kTellingRows = 8;

/// Does a sequence rise from one to the next in nine of ten cases? Times with a slip in them still look like times, no motion rises that
/// long.
template <class Value>
bool is_rising(std::size_t count, const Value& value) {
    if (count < 2) return false;
    std::size_t rising = 0;
    for (std::size_t i = 1; i < count; ++i) rising += value(i) > value(i - 1) ? 1U : 0U;
    return 10 * rising >= 9 * (count - 1);
}

}  // namespace

bool is_rising(const TextTable& table, std::size_t column, std::size_t rows) {
    return is_rising(rows, [&](std::size_t row) { return table.at(row, column); });
}

bool looks_like_seconds(const TextTable& table, std::size_t column) {
    const std::size_t rows = table.rows.size();
    if (rows < kTellingRows || is_index_column(table, column)) return false;
    const double first = table.at(0, column), step = (table.at(rows - 1, column) - first) / static_cast<double>(rows - 1);
    if (!(step >= kShortestStep && step <= kLongestStep)) return false;
    for (std::size_t row = 0; row < rows; ++row)
        if (!(std::abs(table.at(row, column) - first - static_cast<double>(row) * step) <= 0.5 * step)) return false;
    return true;
}

bool is_empty_column(const TextTable& table, std::size_t column) {
    for (std::size_t row = 0; row < table.rows.size(); ++row)
        if (!std::isnan(table.at(row, column))) return false;
    return true;
}

bool are_equal_columns(const TextTable& table, std::size_t a, std::size_t b) {
    for (std::size_t row = 0; row < table.rows.size(); ++row)
        if (table.at(row, a) != table.at(row, b)) return false;
    return true;
}

bool has_counts_row(const TextTable& table) {
    if (table.rows.size() < 3 || table.columns() != 2) return false;
    const double count = table.values[0], step = table.values[1];
    const std::size_t second = table.rows[1].size;
    const bool is_even = std::all_of(table.rows.begin() + 1, table.rows.end() - 1, [&](const TextRow& row) { return row.size == second; });
    if (count != std::floor(count) || !is_even || second == 2) return false;
    // one value a line is a series whatever its number; several are one when it is right
    return second == 1 || (step > 0.0 && step <= kLongestStep && count == static_cast<double>(table.values.size() - 2));
}

std::optional<std::size_t> find_timed_groups(const TextTable& table) {
    const std::size_t width = table.columns();
    const std::size_t count = table.values.size();
    const bool is_even = std::all_of(table.rows.begin(), table.rows.end() - 1, [&](const TextRow& row) { return row.size == width; });
    for (std::size_t size = 2; is_even && 2 * size <= width; ++size) {
        if (width % size != 0 || count % size != 0 || count / size < 3) continue;
        const auto time = [&](std::size_t group) { return table.values[group * size]; };
        if (!is_rising(count / size, time)) continue;
        // times rise evenly, values need not
        const double step = (time(count / size - 1) - time(0)) / static_cast<double>(count / size - 1);
        std::size_t even = 0;
        for (std::size_t i = 1; i < count / size; ++i) even += std::abs(time(i) - time(i - 1) - step) <= 0.5 * step ? 1U : 0U;
        if (10 * even >= 9 * (count / size - 1)) return size;
    }
    return std::nullopt;
}

TableShape compare_neighbors(const TextTable& table) {
    const std::size_t width = table.columns();
    if (table.rows.size() < kTellingRows) return width <= kMostUntimedComponents ? TableShape::components : TableShape::series;
    double along_lines = 0.0, along_columns = 0.0;
    const std::size_t count = table.values.size();
    for (std::size_t i = 1; i < count; ++i) along_lines += std::abs(table.values[i] - table.values[i - 1]);
    for (std::size_t i = width; i < count; ++i) along_columns += std::abs(table.values[i] - table.values[i - width]);
    along_lines /= static_cast<double>(count - 1);
    along_columns /= static_cast<double>(count - width);
    constexpr double kClearly = 0.8;  // of one another
    if (along_lines < kClearly * along_columns) return TableShape::series;
    if (along_columns < kClearly * along_lines) return TableShape::components;
    return TableShape::unclear;
}

bool is_integral(const TextTable& table, std::size_t integral, std::size_t column) {
    double both = 0.0, of_integral = 0.0, of_column = 0.0;
    for (std::size_t row = 1; row < table.rows.size(); ++row) {
        const double increment = table.at(row, integral) - table.at(row - 1, integral);
        const double mean = 0.5 * (table.at(row, column) + table.at(row - 1, column));
        both += increment * mean;
        of_integral += increment * increment;
        of_column += mean * mean;
    }
    constexpr double kAlike = 0.99;  // correlation; printed digits and a baseline correction leave more, two directions far less
    return table.rows.size() >= kTellingRows && both > kAlike * std::sqrt(of_integral * of_column) && both > 0.0;
}

bool is_index_column(const TextTable& table, std::size_t column) {
    if (table.rows.size() < 2 || table.kind(column) != CellKind::number) return false;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const double value = table.at(row, column);
        if (value != std::floor(value) || (row > 0 && value - table.at(row - 1, column) != 1.0)) return false;
    }
    return true;
}

}  // namespace musim::records::detail
