#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "records/detail/text_file.hpp"
#include "scaling/units.hpp"

namespace musim::records::detail {

/// What musim writes in front of GroundMotion::integration_corner in headers of other people's formats: "INTEGRATION CORNER= 0.5 HZ".
inline constexpr std::string_view kCornerTitle = "INTEGRATION CORNER";

/// The corner that a header line tells behind kCornerTitle; nothing where it tells none. Throws ReadError when it is no positive number.
std::optional<scaling::Frequency> find_integration_corner(const TextFile& file, std::size_t index);

}  // namespace musim::records::detail
