#pragma once

#include <string>
#include <string_view>

namespace musim::records::detail {

/// Codes that a station's name begins with, and the rest of it.
struct StationCodes {
    std::string network = "XX";  ///< at most two letters; XX: none, by SEED's convention
    std::string station = {};    ///< at most five letters
    std::string name = {};
};

/// "CE.23837 Pomona" → CE, 23837, Pomona; a name without such codes is all name, at station `unknown`.
StationCodes split_station(std::string_view text, std::string_view unknown);

}  // namespace musim::records::detail
