#pragma once

#include <optional>
#include <string_view>

#include "records/utc_time.hpp"

namespace musim::records::detail {

/// Date and time as headers write them: "2018/01/24 19:51:43", "20/07/2017 22:30:58.000000 (GMT)", "2018/02/06-23:50:29.000",
/// "20190728_160919.870". A clock `hours_ahead` of UTC shows it; text behind the time is not looked at. Nothing when it cannot be read.
std::optional<UtcTime> parse_date_time(std::string_view text, double hours_ahead = 0.0);

}  // namespace musim::records::detail
