#pragma once

#include <optional>

#include "records/time_series.hpp"

/// Uncorrected records, which have their zero anywhere and drift; those that are corrected have no integration corner.
namespace musim::records {

/// Samples that measures of a record are taken from: with an integration corner (uncorrected records) the samples above their initial level
/// (remove_initial_level), else the samples as they are.
TimeSeries level_uncorrected(const TimeSeries& series, std::optional<scaling::Frequency> integration_corner);

/// The velocity of an acceleration record: its integral; of an uncorrected one, after its mean was taken out and it was high-passed at the
/// corner. Throws as integrate() and high_pass() do.
TimeSeries integrate_record(const TimeSeries& acceleration, std::optional<scaling::Frequency> integration_corner);

}  // namespace musim::records
