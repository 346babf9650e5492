#include <doctest/doctest.h>

#include "records/headers/header_fields.hpp"
#include "records/utc_time.hpp"

namespace musim::records {
namespace {

using namespace std::chrono_literals;

TEST_CASE("an instant is the same whatever clock shows it") {
    // Chi-Chi, 1999-09-20 17:47:16 UTC, was 01:47:16 of the next day in Taiwan
    const UtcTime utc = std::chrono::sys_days(std::chrono::year(1999) / 9 / 20) + 17h + 47min + 16s + 250ms;
    CHECK(make_utc_time(1999, 9, 20, 17, 47, 16.25) == utc);
    CHECK(make_utc_time(1999, 9, 21, 1, 47, 16.25, 8.0) == utc);
    CHECK(make_utc_time(1999, 9, 20, 14, 17, 16.25, -3.5) == utc);
}

TEST_CASE("an instant as text is read back to the microsecond, also before 1970") {
    for (const auto& [time, text] : {std::pair(make_utc_time(2019, 7, 6, 3, 19, 23.0383), "2019/07/06 03:19:23.038300"),
                                     std::pair(make_utc_time(1940, 5, 19, 4, 36, 40.000001), "1940/05/19 04:36:40.000001")}) {
        CHECK(to_string(*time) == text);
        CHECK(detail::parse_date_time(text) == time);
    }
}

TEST_CASE("a date or time that does not exist is none") {
    CHECK_FALSE(make_utc_time(2019, 2, 29, 0, 0, 0.0));
    CHECK_FALSE(make_utc_time(2019, 13, 1, 0, 0, 0.0));
    CHECK_FALSE(make_utc_time(2019, 1, 1, 24, 0, 0.0));
    CHECK_FALSE(make_utc_time(2019, 1, 1, 0, 60, 0.0));
    CHECK_FALSE(make_utc_time(2019, 1, 1, 0, 0, -0.5));
    CHECK(make_utc_time(2016, 12, 31, 23, 59, 60.5) == make_utc_time(2017, 1, 1, 0, 0, 0.5));
}

}  // namespace
}  // namespace musim::records
