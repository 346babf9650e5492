#pragma once

#include <optional>
#include <string>
#include <vector>

#include "records/formats/detail/column_title.hpp"
#include "records/formats/detail/text_table.hpp"

namespace musim::records::detail {

/// Shortest and longest time step that a number without a unit of time may be [s]: 100 kHz, and one of slow response histories.
inline constexpr double kShortestStep = 1e-5;
inline constexpr double kLongestStep = 0.1;

/// Statements of the text above a table about its columns.
struct TextHeading {
    std::vector<ColumnTitle> titles;              ///< one a column; none: the columns have no titles
    std::size_t titles_line = 0;                  ///< of the titles, or of their units
    UnitStatement stated;                         ///< of columns without a unit of their own
    std::optional<std::size_t> stated_line = {};  ///< of the unit, or of the text that is none
    std::optional<double> dt = {};                ///< "dt = 0.005 s", "Sampling rate: 200 Hz" [s]
    std::optional<std::size_t> free_text = {};    ///< second line of text, comments aside, that is neither titles nor units
    bool is_understood = false;                   ///< some title is
};

/// Understands the header of a table. Throws ReadError when it states two units.
TextHeading read_text_heading(const TextFile& file, const TextTable& table);

}  // namespace musim::records::detail
