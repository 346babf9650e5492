#pragma once

#include <cstddef>
#include <optional>

#include "records/formats/detail/text_table.hpp"

namespace musim::records::detail {

/// Two to three columns without time are components, more are one series, where their values do not show it (docs/user/record_formats.md).
inline constexpr std::size_t kMostUntimedComponents = 3;

/// Do the first `rows` values of a column rise from row to row in nine of ten cases?
bool is_rising(const TextTable& table, std::size_t column, std::size_t rows);

/// Do whole numbers rise by one from row to row?
bool is_index_column(const TextTable& table, std::size_t column);

/// Times of a motion in seconds: they rise evenly, by a step that is usual.
bool looks_like_seconds(const TextTable& table, std::size_t column);

/// Is no cell of a column a number?
bool is_empty_column(const TextTable& table, std::size_t column);

/// Do two columns hold the same numbers?
bool are_equal_columns(const TextTable& table, std::size_t a, std::size_t b);

/// "4684 0.0100" above values of one series: their number and the time step. Above rows of two values only where there are fewer.
bool has_counts_row(const TextTable& table);

/// Length of the groups that begin with a time each, several a line; nothing when there are none.
std::optional<std::size_t> find_timed_groups(const TextTable& table);

/// Meaning of the columns of a table without times, as far as its values show it.
enum class TableShape { components, series, unclear };

/// Neighbors of a motion are alike: those along lines in a series, those along columns in components.
TableShape compare_neighbors(const TextTable& table);

/// Is a column the integral of another, in whatever units? Its increments then follow the other's means.
bool is_integral(const TextTable& table, std::size_t integral, std::size_t column);

}  // namespace musim::records::detail
