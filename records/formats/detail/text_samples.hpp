#pragma once

#include <string>
#include <vector>

#include "records/formats/detail/text_layout.hpp"

namespace musim::records::detail {

/// Column whose values are the samples of a component.
struct SampleColumn {
    std::size_t column = 0;
    std::string name = {};  ///< empty: the component has the number of its place
    SampleUnit unit;
};

/// The columns that become components, and remarks on the choice.
struct ChosenSamples {
    std::vector<SampleColumn> columns;    ///< translations of one quantity and rotations of one
    bool is_unit_given = true;            ///< false: nobody names a unit, SI is taken
    std::vector<std::string> notes = {};  ///< columns left out, units overruled
};

/// Chooses the columns of one quantity: the one asked for, else accelerations, else the only one; beside translations those of the
/// rotations with as many derivatives, or else of rates, angles or angular accelerations. A unit is the caller's, else that of the
/// column's title, else the one that the text above the table states, else SI. Columns in units of no motion are left out beside those that
/// have one, and so are rotations without a unit. Throws ReadError for a unit that stands in a title and is not understood, for samples
/// that are no motion, for a column without a unit beside others with one, and where the quantity may be either of two.
ChosenSamples choose_samples(const TextFile& file, const TextTable& table, const TextHeading& heading, const TextLayout& layout,
                             const ReadOptions& options);

}  // namespace musim::records::detail
