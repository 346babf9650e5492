#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <vector>

#include "cli/named_values.hpp"
#include "cli/options.hpp"
#include "records/measures/intensity.hpp"

namespace musim::cli {

/// What measures of a record depend on, as options --bracket, --mean-period-band, --intensity-band.
struct MeasureSettings {
    Number bracket{0.05};                                ///< threshold of the bracketed duration [g]
    std::vector<Number> mean_period_band{{0.25}, {20}};  ///< lowest and highest frequency of the mean period [Hz]
    std::vector<Number> intensity_band{{0.1}, {2.5}};    ///< first and last period of the spectrum intensity [s]

    void add_to(CLI::App& command);
};

/// Duration, energy and periods of an acceleration; those that another quantity does not give are missing. `intensity` is that of the same
/// series, leveled like it (records::level_uncorrected), both with `corner` for uncorrected records. Throws records::ProcessingError for
/// settings that make no sense.
NamedValues measure_record(const records::TimeSeries& leveled, const records::Intensity& intensity,
                           const std::optional<scaling::Frequency>& corner, const MeasureSettings& settings);

}  // namespace musim::cli
