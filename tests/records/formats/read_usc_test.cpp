#include <doctest/doctest.h>

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

const std::string kCorrected =
    "CORRECTED ACCELEROGRAM  IIBB127 COMP N08W\nFILE     0 OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I:\nEVENT   21\nJAN 17, "
    "1994\nIBB127\n"
    "STATION USC# 0061   34 17 11N, 118 13 31W\nBIG TUJUNGA STATION, CA\nCOMP N08W\n"
    "ACCELEROGRAM IS BAND-PASS FILTERED BETWEEN  .225- .325 AND 25.00-27.00 HZ.\n"
    "PEAK ACCELERATION =  -242.39450  CMS/SEC/SEC AT    4.580   SEC.\n"
    "  3 POINTS OF ACC DATA EQUALLY SPACED AT   .020 SEC.  IN UNITS CM/SEC/SEC\n"
    "     1.000  -242.394     3.000\n";

TEST_CASE("a corrected USC file has the unit of its header's peak where its samples name none, and may end with its station") {
    const tests::TemporaryFolder folder;
    const GroundMotion motion = read_record(folder.write("a", kCorrected));
    CHECK(motion.format == "USC corrected");
    CHECK(motion.integration_corner->value() == 0.225);
    const std::string silent = replaced(kCorrected, "  IN UNITS CM/SEC/SEC", "");
    CHECK(read_record(folder.write("b", silent)).components[0].series == motion.components[0].series);
    CHECK(motion.components[0].series.samples()[1] == relative(-2.42394, 1e-15));
    CHECK(read_record(folder.write("c", silent + "IIBB127   BIG TUJUNGA STATION, CA    COMP N08W\n")).components[0].series.size() == 3);

    // neither: the unit is unknown
    tests::check_refused(replaced(silent, "  CMS/SEC/SEC", ""), "a:11: unit is missing");
    tests::check_refused(kCorrected + "     4.000\n", "a:13: line behind the last sample");
    tests::check_refused(replaced(kCorrected, "  .225-", "  none-"), "a:9: filter corner 'none' is no positive number");
    // a peak in another unit than the samples
    tests::check_refused(replaced(silent, "-242.39450", "-2.4239450"), "a:10: peak is");
}

// Its acceleration, integrated without a filter, drifts by 186 cm; header: PEAK VELOCITY 12.05681 CMS/SEC, PEAK DISPLACEMENT 1.42006 CMS.
TEST_CASE("a real USC file has the velocity and displacement of its header") {
    if (!tests::have_shared_records()) return;
    const GroundMotion motion = read_record(tests::shared_records() / "usc/017m30bt.s0a");
    const Intensity intensity = compute_intensity(motion.components[0].series, motion.integration_corner);
    // the header's signs are those of the structure's motion
    CHECK(-intensity.pga->value.value() == relative(-2.42394, 1e-3));
    CHECK(-intensity.pgv->value.value() == relative(0.1205681, 0.005));
    CHECK(-intensity.pgd->value.value() == relative(0.0142006, 0.05));
}

}  // namespace
}  // namespace musim::records
