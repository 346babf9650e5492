#include "records/utc_time.hpp"

#include <fmt/format.h>

#include <cmath>

namespace musim::records {

std::optional<UtcTime> make_utc_time(int year, int month, int day, int hour, int minute, double second, double hours_ahead) {
    const bool in_range = year >= 1 && year <= 9999 && month >= 1 && month <= 12 && day >= 1 && day <= 31 && hour >= 0 && hour < 24 &&
                          minute >= 0 && minute < 60 && second >= 0.0 && second < 61.0 && std::abs(hours_ahead) <= 24.0;
    if (!in_range) return std::nullopt;
    const std::chrono::year_month_day date{std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
                                           std::chrono::day(static_cast<unsigned>(day))};
    if (!date.ok()) return std::nullopt;
    const auto microseconds = [](double seconds) { return std::chrono::microseconds(std::llround(1e6 * seconds)); };
    return std::chrono::sys_days(date) + std::chrono::hours(hour) + std::chrono::minutes(minute) + microseconds(second) -
           microseconds(3600.0 * hours_ahead);
}

std::optional<UtcTime> find_instant(UtcTime zero, scaling::Time later) {
    constexpr UtcTime kFirst = std::chrono::sys_days(std::chrono::year(1) / 1 / 1),
                      kEnd = std::chrono::sys_days(std::chrono::year(10000) / 1 / 1);
    const std::chrono::duration<double> seconds(later.value());
    if (!(seconds >= kFirst - zero && seconds < kEnd - zero)) return std::nullopt;
    return zero + std::chrono::microseconds(std::llround(1e6 * seconds.count()));
}

std::string to_string(UtcTime time) {
    const auto day = std::chrono::floor<std::chrono::days>(time);
    const std::chrono::year_month_day date(day);
    const std::chrono::hh_mm_ss clock(time - day);
    return fmt::format("{:04}/{:02}/{:02} {:02}:{:02}:{:02}.{:06}", static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                       static_cast<unsigned>(date.day()), clock.hours().count(), clock.minutes().count(), clock.seconds().count(),
                       clock.subseconds().count());
}

}  // namespace musim::records
