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

// one corrected component of twelve samples: two lines a block, the second with two values; a pad of 5 s as the networks' files have
const std::string kGeonetFile =
    "Corrected accelerogram 20180212_211554_WPWS_20 GNS Science\nSite WPWS      39 56 38S  176 35 04E\nWaipawa\nInstrument Basalt\n"
    "Resolution: 24-bit\nAccelerogram\n6 km south of Waipukurau\n2018 February 12         21:15:54 UT\nEpicentre\n"
    "Number of points     12    Duration   0.22 sec\nInstrument corrected data at 0.020 sec intervals\nBand-pass filter\n"
    "Component S16W  Longitudinal Accelerometer Axis\n"
    "Acceleration:  peak    -41.6 mm/s/s at   0.10 sec     rms      2.2 mm/s/s\n"
    "Velocity:      peak     1.65 mm/s   at   0.12 sec     rms     0.09 mm/s\n"
    "Displacement record unevaluated\n"
    "    2018       2      12      21      15     540       0       0    2018       2\n"
    "      40       3      27     176      32      45       9       0      12      21\n"
    "      39      56      38     176      35       4     196     196     195      13\n"
    "      12     250     250      12      12       0       0       0      15   17000\n"
    "   200.0    0.70\n"
    "  39.944 176.584\n"
    "    0.22    5.00    5.00    0.22  0.0050  0.0200      0.      0.      0.  9806.6\n"
    "   -46.3   43.67\n    1.65   43.56\n   0.100   0.150\n"
    "     1.0     0.0     0.0     0.0     0.0   -41.6     0.0     0.0     0.0     0.0\n     2.0     3.0\n"
    "  0.0010  0.0000  0.0000  0.0000  0.0000  1.2000  1.6472  0.0000  0.0000  0.0000\n  0.0000  0.0000\n";

TEST_CASE("a GeoNet component gives samples in SI, its site and azimuth") {
    const tests::TemporaryFolder folder;
    const GroundMotion motion = read_record(folder.write("a", kGeonetFile));

    CHECK(motion.format == "GeoNet V2A");
    CHECK(motion.station == "WPWS, Waipawa");
    CHECK(motion.event == "6 km south of Waipukurau, 2018 February 12         21:15:54 UT");
    CHECK_FALSE(motion.integration_corner);
    const Component& component = motion.find_component("S16W");
    CHECK(component.azimuth_deg == 196.0);
    CHECK(component.series.dt().value() == 0.02);
    REQUIRE(component.series.size() == 12);
    CHECK(component.series.samples()[0] == relative(0.001, 1e-15));
    CHECK(component.series.samples()[5] == relative(-0.0416, 1e-15));
    CHECK(component.series.samples()[11] == relative(0.003, 1e-15));
}

TEST_CASE("the pad in front of a GeoNet recording lies before its clock's zero") {
    const tests::TemporaryFolder folder;
    const GroundMotion motion = read_record(folder.write("a", kGeonetFile));

    CHECK(motion.time_zero == make_utc_time(2018, 2, 12, 21, 15, 17.0));
    CHECK(motion.components.front().series.start().value() == -5.0);
}

TEST_CASE("the option chooses the block, and a block that was not evaluated is missed") {
    const tests::TemporaryFolder folder;
    const TimeSeries velocity =
        read_record(folder.write("a", kGeonetFile), {.quantity = SampleQuantity::velocity}).find_component("S16W").series;
    CHECK(velocity.quantity() == SampleQuantity::velocity);
    CHECK(velocity.samples()[6] == relative(0.0016472, 1e-15));

    tests::check_refused(kGeonetFile, "a:1: component has no displacement", {.quantity = SampleQuantity::displacement});
}

TEST_CASE("a peak of a GeoNet file may differ from its sample by the rounding of both") {
    const tests::TemporaryFolder folder;
    // eight letters hold -1017. where the header has two decimals
    const std::string strong = replaced(replaced(kGeonetFile, "     1.65 mm/s ", " -1016.55 mm/s "), "  1.6472", "  -1017.");
    CHECK(read_record(folder.write("a", strong), {.quantity = SampleQuantity::velocity}).components.front().series.samples()[6] ==
          relative(-1.017, 1e-15));
    tests::check_refused(replaced(strong, "-1016.55", "-1016.45"), "a:15: peak is '-1016.45' (the samples peak at -1017;");
}

TEST_CASE("every defect of a GeoNet file is reported with its line") {
    using tests::check_refused;
    check_refused(replaced(kGeonetFile, "  0.0000  0.0000\n", ""), "a:29: sample 11 of 12 is missing (file is truncated)");
    check_refused(replaced(kGeonetFile, "     2.0     3.0\n", "     2.0     3.0     4.0\n"), "a:28: line goes on after sample 12");
    check_refused(kGeonetFile + "  0.0000\n", "a:31: '  0.0000' is no header of a component (more samples than announced");
    check_refused(replaced(kGeonetFile, "     2.0     3.0\n", "     2.0     3,0\n"), "a:28: sample 12 is '3,0' (no decimal point");
    check_refused(replaced(kGeonetFile, "     2.0     3.0\n", "     2.0     x.0\n"), "a:28: sample 12 is 'x.0' (no finite number)");
    check_refused(replaced(kGeonetFile, "-41.6 mm", "-42.6 mm"), "a:14: peak is '-42.6' (the samples peak at -41.6;");
    check_refused(replaced(kGeonetFile, "1.65 mm", "1.85 mm"), "a:15: peak is '1.85' (the samples peak at 1.6472;");
    check_refused(replaced(kGeonetFile, "-41.6 mm/s/s", "-41.6 volt"), "a:14: unit 'volt' is none of acceleration");
    check_refused(replaced(kGeonetFile, "points     12", "points     13"),
                  "a:10: 'Number of points     13    Durat...' is no usable number");
    check_refused(replaced(replaced(kGeonetFile, "points     12", "points 900000000"), "250      12      12", "2509000000009000000"),
                  "is no usable number of points");
    check_refused(replaced(kGeonetFile, "Duration   0.22", "Duration   9.22"), "a:10: 12 points of 0.02 s do not make the duration in");
    check_refused(replaced(kGeonetFile, "at 0.020 sec", "at 0.005 sec"), "a:11: time step is 0.005 s (line 23 says 0.02 s)");
    check_refused(replaced(kGeonetFile, "at 0.020 sec", "at 0.000 sec"), "a:11: time step is 0 s (must be positive)");
    check_refused(replaced(kGeonetFile, "at 0.020 sec", "every sec"), "a:11: time step is missing");
    check_refused(replaced(kGeonetFile, "S16W", "S17W"), "a:13: component 'S17W' has the azimuth 197 (line 19 says 196;");
    check_refused(replaced(kGeonetFile, "    0.22    5.00", "    0.22   -5.00"), "a:23: pad in front is -5 s (must not be negative)");
    check_refused(replaced(kGeonetFile, "    0.22    5.00", "    0.22    five"), "a:23: number 2 of the header line is 'five' (no number)");
    check_refused(replaced(kGeonetFile, "      12      21\n", "      32      21\n"), "a:17: start of the recording is no date and time");
    check_refused(kGeonetFile + replaced(kGeonetFile, "   17000", "   18000"),
                  "a:47: recording starts at another time than that of the first");
    check_refused(kGeonetFile.substr(0, kGeonetFile.find("     1.0")), "a:26: sample 1 of 12 is missing (file is truncated)");
    check_refused(kGeonetFile, "file states its time step 0.02 s (asked for: 0.01 s)", {.dt = 0.01 * scaling::si::seconds});
}

TEST_CASE("compass bearings become azimuths in every quadrant") {
    if (!tests::have_shared_records()) return;
    const GroundMotion raw = read_record(tests::shared_records() / "geonet/20161113_110300_HSES_20.V1A");
    CHECK(raw.format == "GeoNet V1A");
    CHECK(raw.component_names() == "N10E, N80W, Up");
    CHECK(raw.components[0].azimuth_deg == 10.0);
    CHECK(raw.components[1].azimuth_deg == 280.0);
    CHECK_FALSE(raw.components[2].azimuth_deg);
    REQUIRE(raw.integration_corner);
    CHECK(raw.time_zero == make_utc_time(2016, 11, 13, 11, 2, 20.0));
    CHECK(raw.components[0].series.start().value() == 0.0);

    const GroundMotion corrected = read_record(tests::shared_records() / "geonet/20180212_211557_WPWS_20.V2A");
    CHECK(corrected.component_names() == "S16W, S74E, Up");
    CHECK(corrected.components[1].azimuth_deg == 106.0);
}

TEST_CASE("velocity and displacement of a real GeoNet record peak when and as its header says") {
    if (!tests::have_shared_records()) return;
    const std::filesystem::path path = tests::shared_records() / "geonet/20180212_211557_WPWS_20.V2A";
    const TimeSeries acceleration = read_record(path).find_component("S74E").series;
    const TimeSeries velocity = read_record(path, {.quantity = SampleQuantity::velocity}).find_component("S74E").series;
    const TimeSeries displacement = read_record(path, {.quantity = SampleQuantity::displacement}).find_component("S74E").series;

    // header: -194.0 mm/s² at 43.66 s, 5.09 mm/s at 43.62 s, 0.279 mm at 43.66 s
    CHECK(find_peak_acceleration(acceleration).time.value() == doctest::Approx(43.66));
    CHECK(find_peak_velocity(velocity).value.value() * 1000.0 == relative(5.0909, 1e-5));
    CHECK(find_peak_velocity(velocity).time.value() == doctest::Approx(43.62));
    CHECK(find_peak_displacement(displacement).value.value() * 1000.0 == relative(0.27895, 1e-5));
    CHECK(find_peak_displacement(displacement).time.value() == doctest::Approx(43.66));
}

}  // namespace
}  // namespace musim::records
