#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "records/headers/text_file.hpp"
#include "records/utc_time.hpp"

namespace musim::records::detail {

/// Separator of the cells of a table of text, and form of its numbers.
struct CellSyntax {
    char separator = kBlanks;  ///< ',', ';', a tab, or one of these:
    bool has_decimal_commas = false;

    static constexpr char kBlanks = ' ';    ///< blanks and tabs
    static constexpr char kAnything = '*';  ///< blanks, tabs, commas and semicolons
};

/// The syntax of the lines of numbers in a file. Decimal commas are those between digits where semicolons or tabs part the cells, or quotes
/// enclose them, and no point stands in any number. Throws ReadError, with the line, where a comma may be either.
CellSyntax find_cell_syntax(const TextFile& file);

/// Cells of a line, without blanks and quotes around them; empty ones at its end go.
void split_row(std::string_view line, const CellSyntax& syntax, std::vector<std::string_view>& cells);

enum class CellKind : std::uint8_t { number, instant, date, clock, missing, text };

/// Cell of a table: a number, or a time [s] on the clock of the table: an instant or date after CellReader::zero, or a time of day.
struct Cell {
    CellKind kind = CellKind::text;
    double value = 0.0;
};

/// Reads the cells of one table.
class CellReader {
  public:
    explicit CellReader(const CellSyntax& syntax) : syntax_(syntax) {}

    /// "0,005" (where commas are decimal), "2024-04-02T22:45:22.147Z", "22:45:22.147", "NaN"; text for anything else, also for a second
    /// date of which nobody can say whether its month or its day comes first.
    Cell read(std::string_view text);

    /// First date met; none: no dates. In UTC when the dates say their zone.
    std::optional<UtcTime> zero() const { return zero_; }
    bool is_utc() const { return is_utc_; }

  private:
    Cell read_moment(std::string_view text);

    CellSyntax syntax_;
    std::optional<UtcTime> zero_;
    bool is_utc_ = false;
    std::string ambiguous_date_;
};

}  // namespace musim::records::detail
