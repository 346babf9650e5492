#include <doctest/doctest.h>

#include <string>

#include "records/formats/read_record.hpp"
#include "tests/records/refusal.hpp"
#include "tests/support/relative.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;
using tests::replaced;

// a name in Shift-JIS behind the code, as the agency writes it
const std::string kJmaFile =
    "SITE CODE= AB1  \x97\xD6\x93\x87,37.5,137.2\r\n LAT.=  37.1234\r\n LON.= 136.5678\r\n SAMPLING RATE= 100Hz\r\n UNIT  = gal(cm/s/s)\r\n"
    "INITIAL TIME = 2020 01 02 16 09 30\r\nNS,EW,UD\r\n0.125,-0.25,980.5\r\n1.0,2.0,3.0\r\n-4,-5,-6\r\n";

TEST_CASE("a JMA file gives three axes in SI and its clock in UTC") {
    const tests::TemporaryFolder folder;
    const GroundMotion motion = read_record(folder.write("a", kJmaFile));

    CHECK(motion.format == "JMA");
    CHECK(motion.station == "AB1");
    CHECK(motion.time_zero == make_utc_time(2020, 1, 2, 7, 9, 30.0));
    REQUIRE(motion.integration_corner);
    CHECK(motion.component_names() == "NS, EW, UD");
    CHECK(motion.find_component("EW").azimuth_deg == 90.0);
    CHECK(is_vertical(motion.find_component("UD")));
    const TimeSeries& series = motion.find_component("NS").series;
    CHECK(series.dt().value() == 0.01);
    REQUIRE(series.size() == 3);
    CHECK(series.samples()[0] == relative(0.00125, 1e-15));
    CHECK(series.samples()[2] == relative(-0.04, 1e-15));
}

TEST_CASE("columns of a JMA file are those of its titles, and commas that a spreadsheet adds are none") {
    const tests::TemporaryFolder folder;
    std::string text = replaced(kJmaFile, "NS,EW,UD", "NS,UD,EW");
    text = replaced(text, "100Hz", "100Hz,,");
    CHECK(read_record(folder.write("a", text)).find_component("UD").series.samples()[0] == relative(-0.0025, 1e-15));
}

TEST_CASE("every defect of a JMA file is reported with its line") {
    using tests::check_refused;
    check_refused(replaced(kJmaFile, "-4,-5,-6", "-4,-5"), "a:10: 2 values (the header names 3 columns)");
    check_refused(replaced(kJmaFile, "1.0,2.0", "1.0,x2.0"), "a:9: sample 2 is 'x2.0' (no finite number)");
    check_refused(replaced(kJmaFile, "100Hz", "0Hz"), "a:4: SAMPLING RATE is '0Hz' (must be positive, in Hz)");
    check_refused(replaced(kJmaFile, "gal(", "volt("), "a:5: UNIT is 'volt(cm/s/s)' (no unit of acceleration)");
    check_refused(replaced(kJmaFile, "2020 01", "2020 13"), "a:6: INITIAL TIME is '2020 13 02 16 09 30' (no date and time)");
    check_refused(replaced(kJmaFile, "NS,EW,UD", "NS,EW,AB"), "a: no line names the columns (NS,EW,UD)");
    check_refused(kJmaFile.substr(0, kJmaFile.find("0.125")), "a: no samples follow the header (file is truncated)");
    check_refused(kJmaFile, "a: file states its unit gal (asked for: g)", {.unit = "g"});
}

}  // namespace
}  // namespace musim::records
