#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "records/formats/detail/column_unit.hpp"

namespace musim::records::detail {

/// A column's title, as far as it is understood: "Linear Acceleration x (m/s^2)", "acc_g", "Time [ms]", "t / s".
struct ColumnTitle {
    std::string text = {};                        ///< as it stands in the file, for messages
    std::string name = {};                        ///< without its unit
    std::optional<SampleQuantity> quantity = {};  ///< by a word of the name, else by the unit
    ColumnUnit unit = {};
    std::string unknown_unit = {};  ///< text that stands where a unit stands and is none that is known, or not one of the quantity
    bool is_time = false;           ///< by a word or by its unit
    bool is_index = false;          ///< by a word: "No.", "sample", "index"
    bool is_magnitude = false;      ///< by a word: "absolute", "resultant"
    bool is_rotation = false;       ///< by a word or by its unit: "roll", "rx (deg)", "gyro x"
    bool is_remark = false;         ///< by a word: what loggers add to samples, "Battery", "Comment", "Temperature"

    /// Is anything but a name understood?
    bool is_understood() const { return quantity || unit.is_known() || is_time || is_index; }
};

/// Understands a column's title.
ColumnTitle read_column_title(std::string_view text);

/// Adds what the cell of a row of units says to the title above it; a unit that contradicts the title's own is an unknown one.
void add_unit(ColumnTitle& title, std::string_view unit_text);

/// True for cells of a row of units that say nothing: "", "-", "TS", "Smp".
bool is_empty_unit(std::string_view text);

/// Unit that a line of text states for the samples below it: "# Units: (g)", "acceleration time history in cm/s^2", "(mm/s^2)".
struct UnitStatement {
    std::optional<SampleUnit> motion = {};  ///< of a translation
    std::optional<SampleUnit> rotation = {};
    std::optional<double> seconds = {};           ///< unit of time
    std::string unknown = {};                     ///< text behind "unit:" that is no unit of a motion
    std::optional<SampleQuantity> quantity = {};  ///< that the line speaks of, when of one only
    bool is_explicit = false;                     ///< stated by the word "unit"
};

/// Unit that a line states, if any.
UnitStatement read_unit_statement(std::string_view line);

}  // namespace musim::records::detail
