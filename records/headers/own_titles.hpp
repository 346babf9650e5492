#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "records/headers/text_file.hpp"
#include "scaling/units.hpp"

/// Titles that musim writes into headers of other people's formats, and reads there again.
namespace musim::records::detail {

/// In front of GroundMotion::integration_corner: "INTEGRATION CORNER= 0.5 HZ".
inline constexpr std::string_view kCornerTitle = "INTEGRATION CORNER";

/// In front of TimeSeries::start, where it is not zero: "MUSIM START TIME= 230.5 SEC".
inline constexpr std::string_view kStartTitle = "MUSIM START TIME";

/// The corner that a header line gives behind kCornerTitle; nothing where it gives none. Throws ReadError when it is no positive number.
std::optional<scaling::Frequency> find_integration_corner(const TextFile& file, std::size_t index);

/// The start that a header line gives behind kStartTitle; nothing where it gives none. Throws ReadError when it is no finite number.
std::optional<scaling::Time> find_start_time(const TextFile& file, std::size_t index);

/// Codes that a station's name begins with, and the rest of it.
struct StationCodes {
    std::string network = "XX";  ///< at most two letters; XX: none, by SEED's convention
    std::string station = {};    ///< at most five letters
    std::string name = {};
};

/// "CE.23837 Pomona" → CE, 23837, Pomona; a name without such codes is all name, at station `unknown`.
StationCodes split_station(std::string_view text, std::string_view unknown);

}  // namespace musim::records::detail
