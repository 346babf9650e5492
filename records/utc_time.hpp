#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "scaling/units.hpp"

namespace musim::records {

/// An instant, coordinated universal time, to the microsecond; leap seconds are not counted.
using UtcTime = std::chrono::sys_time<std::chrono::microseconds>;

/// The instant that a clock `hours_ahead` of UTC shows as this date and time of day; nothing when there is no such date or time. A second
/// of 60 (a leap second) counts as the next minute's first.
std::optional<UtcTime> make_utc_time(int year, int month, int day, int hour, int minute, double second, double hours_ahead = 0.0);

/// The instant so much later than another, rounded to the microsecond; nothing outside of the years 1 to 9999.
std::optional<UtcTime> find_instant(UtcTime zero, scaling::Time later);

/// "2019/07/06 03:19:23.038300", as detail::parse_date_time reads it.
std::string to_string(UtcTime time);

}  // namespace musim::records
