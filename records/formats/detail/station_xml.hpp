#pragma once

#include <filesystem>
#include <optional>

#include "records/formats/detail/streams.hpp"

namespace musim::records::detail {

/// Response of a stream at a time by a StationXML file.
struct StreamResponse {
    SampleQuantity quantity = SampleQuantity::acceleration;
    double sensitivity = 1.0;                ///< total, at its frequency [counts per SI unit]; negative: reversed polarity
    std::optional<double> azimuth_deg = {};  ///< of positive motion; nothing for vertical channels
};

/// The response of the one channel epoch in the StationXML file that has these codes and covers first to last sample. Throws ReadError
/// `path: what (why); what to do` when the file cannot be read, has no such epoch or several, or no sensitivity from motion to counts.
StreamResponse read_stream_response(const std::filesystem::path& path, const StreamCodes& codes, UtcTime first, UtcTime last);

}  // namespace musim::records::detail
