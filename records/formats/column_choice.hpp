#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace musim::records {

/// Column of a text record that a caller chose, and what it is.
struct ColumnChoice {
    std::string name;    ///< "time", or the component's name
    std::string column;  ///< its number, counted from 1; its title; "1-8": several values a line of one series

    bool operator==(const ColumnChoice&) const = default;
};

/// Chosen columns, the time among them where the file has it; components in this order.
using ColumnChoices = std::vector<ColumnChoice>;

/// Name of the choice that is the time [s, unless the title gives another unit].
inline constexpr std::string_view kTimeColumn = "time";

/// Choices of "time=2,x=3" or "time=Time,NS=Acc NS". Throws ReadError for a text that is not NAME=COLUMN, separated by commas, for a name
/// that occurs twice, and when no component is among them.
ColumnChoices parse_column_choices(std::string_view text);

/// Throws ReadError for choices that parse_column_choices() would not return.
void check_column_choices(const ColumnChoices& choices);

/// "time=2,x=3".
std::string to_string(const ColumnChoices& choices);

}  // namespace musim::records
