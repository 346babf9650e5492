#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "records/formats/read_record.hpp"
#include "records/measures/intensity.hpp"
#include "tests/records/refusal.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/shared_records.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;
using tests::replaced;

const std::string kCwaFile =
    "#Earthquake Information\n#Origin Time(GMT+08): 2018/02/06-23:50:42\n#Magnitude(Ml): 6.0\n\n#StationCode: EAS\n#StationName: Anshuo\n"
    "#StartTime(GMT+08): 2018/02/06-23:50:29.500\n#RecordLength(sec): 3\n#SampleRate(Hz): 1\n#AmplitudeUnit:  gal. DCoffset(corr)\n"
    "#AmplitudeMAX. U:    0.658~   -0.837\n#AmplitudeMAX. N:    1.256~    0.000\n#AmplitudeMAX. E:    0.000~   -0.778\n"
    "#DataSequence: Time U(+); N(+); E(+)\n#Data: 4F10.3\n"
    "     0.000     0.658     0.000     0.000\n     1.000    -0.837     0.000    -0.778\n     2.000     0.000     1.256     0.000\n";

TEST_CASE("a CWA file gives its components in the order it names, and Taiwan's clock in UTC") {
    const tests::TemporaryFolder folder;
    const GroundMotion motion = read_record(folder.write("a", kCwaFile));

    CHECK(motion.format == "CWA");
    CHECK(motion.station == "EAS, Anshuo");
    CHECK(motion.event == "2018/02/06-23:50:42 GMT+08, magnitude 6.0 (Ml)");
    CHECK(motion.time_zero == make_utc_time(2018, 2, 6, 15, 50, 29.5));
    CHECK(motion.component_names() == "U, N, E");
    CHECK_FALSE(motion.components[0].azimuth_deg);
    CHECK(motion.components[1].azimuth_deg == 0.0);
    CHECK(motion.components[2].azimuth_deg == 90.0);
    CHECK(motion.components[2].series.dt().value() == 1.0);
    REQUIRE(motion.components[2].series.size() == 3);
    CHECK(motion.components[2].series.samples()[1] == relative(-0.00778, 1e-15));
}

TEST_CASE("every defect of a CWA file is reported with its line") {
    using tests::check_refused;
    const std::string last = "     2.000     0.000     1.256     0.000\n";
    check_refused(replaced(kCwaFile, "(sec): 3", "(sec): 5"), "a:18: 3 rows for 5 s at 1 Hz (truncated, or more than announced)");
    check_refused(replaced(kCwaFile, "(sec): 3", "(sec): 1000000000000"), "a:18: 3 rows for 1000000000000 s at 1 Hz");
    check_refused(kCwaFile + "     3.000     0.000     0.000     0.000\n     4.000     0.000     0.000     0.000\n",
                  "a:20: 5 rows for 3 s");
    check_refused(replaced(kCwaFile, last, ""), "a:12: AmplitudeMAX. N is '1.256' (the samples peak at 0;");
    check_refused(replaced(kCwaFile, "     0.000    -0.778", "    -0.778"), "a:17: 3 values (the header names 4 columns)");
    check_refused(replaced(kCwaFile, "     0.000    -0.778", "     0.0.0    -0.778"), "a:17: sample 2 is '0.0.0' (no finite number)");
    check_refused(replaced(kCwaFile, "     1.000    -0.837", "     1.500    -0.837"), "a:17: time is 1.5 s (even sampling gives 1 s)");
    check_refused(replaced(kCwaFile, "(Hz): 1", "(Hz): 50"), "a:9: SampleRate(Hz) is '50' (the times are 1 s apart)");
    check_refused(replaced(kCwaFile, "(Hz): 1", "(Hz): zero"), "a:9: SampleRate(Hz) is 'zero' (must be a positive number)");
    check_refused(replaced(kCwaFile, "#SampleRate(Hz): 1\n", ""), "a: header has no 'SampleRate(Hz)'");
    check_refused(replaced(kCwaFile, "E(+)", "E(-)"), "a:14: DataSequence is 'Time U(+); N(+); E(-)' (must be 'Time' and three names");
    check_refused(replaced(kCwaFile, "gal.", "volt"), "a:10: AmplitudeUnit is 'volt DCoffset(corr)' (no unit of acceleration)");
    check_refused(replaced(kCwaFile, "29.500", "99.500"), "a:7: StartTime(GMT+08) is '2018/02/06-23:50:99.500' (no date and time)");
    check_refused(kCwaFile.substr(0, kCwaFile.find("     0.000     0.658")), "a: no samples follow the header");
    check_refused(kCwaFile, "file states its unit gal (asked for: g)", {.unit = "g"});
}

TEST_CASE("a real CWA record has its station and clock") {
    if (!tests::have_shared_records()) return;
    const GroundMotion motion = read_record(tests::shared_records() / "cwa/1-EAS.dat");
    CHECK(motion.station == "EAS, Anshuo");
    CHECK(motion.time_zero == make_utc_time(2018, 2, 6, 15, 50, 29.0));
    CHECK(motion.find_component("E").azimuth_deg == 90.0);
    // its drift is no motion: integrated without a filter, N moves by 39 cm
    CHECK(motion.integration_corner->value() == kUncorrectedCornerHz);
    const Intensity intensity = compute_intensity(motion.find_component("N").series, motion.integration_corner);
    CHECK(std::abs(intensity.pgd->value.value()) < 0.01);
}

}  // namespace
}  // namespace musim::records
