#pragma once

#include <optional>
#include <string_view>

#include "records/sample_unit.hpp"

namespace musim::records::detail {

/// Meaning of a text that stands where a unit stands: of a motion, of time, or of something that is no motion.
struct ColumnUnit {
    std::optional<SampleUnit> motion = {};
    std::optional<double> seconds = {};  ///< of one unit of time
    std::string_view foreign = {};       ///< "a voltage", "counts", ...: no unit of a motion

    bool is_known() const { return motion || seconds || !foreign.empty(); }
};

/// Meaning of `text` as a unit, brackets and case aside: "(cm/s²)", "ms", "mV", "°C". Nothing is set for a text that is no known unit.
ColumnUnit read_column_unit(std::string_view text);

}  // namespace musim::records::detail
