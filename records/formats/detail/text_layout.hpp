#pragma once

#include <optional>
#include <string>
#include <vector>

#include "records/formats/detail/text_heading.hpp"
#include "records/formats/detail/text_table.hpp"
#include "records/formats/read_record.hpp"

namespace musim::records::detail {

/// Which columns of a table are what.
struct TextLayout {
    std::optional<std::size_t> time = {};   ///< column of the times
    std::vector<std::size_t> samples = {};  ///< columns that may be components
    std::vector<std::string> names = {};    ///< of these, as chosen or titled; empty where there is none
    std::optional<std::size_t> index = {};  ///< column that counts rows, where there are no times
    std::optional<double> dt = {};          ///< of a row "4684 0.0100" above the values [s]
    bool is_series = false;                 ///< several values a line of one series, now one a row
};

/// Finds out which columns of a table are what: by the choice of the caller, by titles, else by what they hold. The table is made even:
/// times and values side by side come one below the other, so do the values of one series. Throws ReadError where two readings are
/// possible.
///
/// - Times are in the column that its title calls so, else in the first that rises in nine of ten rows; whole numbers that rise by one
///   are an index, unless a title or unit says that they are times.
/// - Without titles: groups of values a line that begin with a time each, "t a t a t a", are rows; without times, up to three columns are
///   components, more are one series, where neighbors along a line or along a column do not show which.
TextLayout find_text_layout(const TextFile& file, TextTable& table, const TextHeading& heading, const ReadOptions& options);

/// A column in messages: "column 2 'Acc (g)'".
std::string place_of(std::size_t column, const TextHeading& heading);

}  // namespace musim::records::detail
