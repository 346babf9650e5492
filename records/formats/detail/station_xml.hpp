#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "records/sample_unit.hpp"
#include "records/utc_time.hpp"

namespace musim::records::detail {

/// A data stream by its SEED codes.
struct StreamCodes {
    std::string network = {};
    std::string station = {};
    std::string location = {};  ///< often empty
    std::string channel = {};

    friend bool operator==(const StreamCodes&, const StreamCodes&) = default;
};

/// "CI.CLC..HNE"
std::string to_string(const StreamCodes& codes);

/// What a StationXML file says of a stream at a time.
struct StreamResponse {
    SampleQuantity quantity = SampleQuantity::acceleration;
    double sensitivity = 1.0;                ///< total, at its frequency [counts per SI unit]; negative: reversed polarity
    std::optional<double> azimuth_deg = {};  ///< of positive motion; nothing for vertical channels
};

/// The response of the one channel epoch in the StationXML file that has these codes and covers first to last sample. Throws ReadError
/// `path: what (why); what to do` when the file cannot be read, has no such epoch or several, or no sensitivity from motion to counts.
StreamResponse read_stream_response(const std::filesystem::path& path, const StreamCodes& codes, UtcTime first, UtcTime last);

}  // namespace musim::records::detail
