#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <vector>

#include "cli/named_values.hpp"
#include "cli/options.hpp"
#include "records/measures/intensity.hpp"

namespace musim::cli {

/// The structure that a record is put in proportion to, as options --friction, --length, --slenderness.
struct StructureOptions {
    std::optional<Number> friction;     ///< friction coefficient μ
    std::optional<Number> length;       ///< l [m]
    std::optional<Number> slenderness;  ///< angle α between diagonal and height of a block [deg]

    void add_to(CLI::App& command);
    bool any() const { return friction || length || slenderness; }
};

/// How strong a record is for a structure in standard gravity, in dimensionless groups, and how far a Newmark block slides (its largest
/// distance); missing where the structure or the record does not give it. `intensity` is that of the same series, leveled like it
/// (records::level_uncorrected).
NamedValues compute_record_groups(const records::TimeSeries& leveled, const records::Intensity& intensity,
                                  const StructureOptions& structure);

}  // namespace musim::cli
