#include <doctest/doctest.h>

#include <cmath>
#include <numeric>
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

// four counts in one second, a count is 0.5 gal; about their mean of 2 they peak at 8 counts
const std::string kKnetFile =
    "Origin Time       2018/01/24 19:51:00\nLat.              41.0\nLong.             142.5\nDepth. (km)       30\nMag.              6.2\n"
    "Station Code      AOM001\nStation Lat.      41.5267\nStation Long.     140.9244\nStation Height(m) 39\n"
    "Record Time       2018/01/24 19:51:43\nSampling Freq(Hz) 4Hz\nDuration Time(s)  1\nDir.              E-W\n"
    "Scale Factor      2000(gal)/4000\nMax. Acc. (gal)   4.000\nLast Correction   2018/01/24 19:51:43\nMemo.             \n"
    "       0       10       -2        0 \n";

TEST_CASE("K-NET counts become accelerations, with the mean left in") {
    const tests::TemporaryFolder folder;
    const GroundMotion motion = read_record(folder.write("a", kKnetFile));

    CHECK(motion.format == "K-NET/KiK-net");
    CHECK(motion.station == "AOM001");
    CHECK(motion.event == "2018/01/24 19:51:00 JST, magnitude 6.2");
    REQUIRE(motion.integration_corner);
    const Component& component = motion.find_component("e-w");
    CHECK(component.azimuth_deg == 90.0);
    CHECK(component.series.dt().value() == 0.25);
    REQUIRE(component.series.size() == 4);
    CHECK(component.series.samples()[0] == 0.0);
    CHECK(component.series.samples()[1] == relative(0.05, 1e-15));
    CHECK(component.series.samples()[2] == relative(-0.01, 1e-15));
}

TEST_CASE("a K-NET clock is Japan's, and the samples begin 15 s before the record time") {
    const tests::TemporaryFolder folder;
    CHECK(read_record(folder.write("a", kKnetFile)).time_zero == make_utc_time(2018, 1, 24, 10, 51, 28.0));
}

TEST_CASE("KiK-net numbers its directions: borehole 1 to 3, surface 4 to 6") {
    const tests::TemporaryFolder folder;
    const auto component = [&](std::string_view direction) {
        return read_record(folder.write("a", replaced(kKnetFile, "E-W", direction))).components.front();
    };
    CHECK(component("1").azimuth_deg == 0.0);
    CHECK(component("2").azimuth_deg == 90.0);
    CHECK_FALSE(component("3").azimuth_deg);
    CHECK(is_vertical(component("3")));
    CHECK_FALSE(is_vertical(component("4")));
    CHECK(component("4").azimuth_deg == 0.0);
    CHECK(component("5").azimuth_deg == 90.0);
    CHECK(component("5").name == "5");
    CHECK_FALSE(component("6").azimuth_deg);
    CHECK(is_vertical(component("6")));
}

TEST_CASE("every defect of a K-NET file is reported with its line") {
    using tests::check_refused;
    check_refused(replaced(kKnetFile, "10       -2        0 ", ""),
                  "a:18: 1 values for Duration Time x Sampling Freq = 4 (file is truncated)");
    check_refused(kKnetFile + "       1\n", "a:19: more values than Duration Time x Sampling Freq = 4");
    check_refused(replaced(kKnetFile, "-2  ", "-2x "), "a:18: sample 3 is '-2x' (no finite number)");
    check_refused(replaced(kKnetFile, "4.000", "5.000"), "a:15: Max. Acc. (gal) is '5.000' (the samples peak at 4;");
    check_refused(replaced(kKnetFile, "4.000", "?"), "a:15: Max. Acc. (gal) is '?' (no number)");
    check_refused(replaced(kKnetFile, "2000(gal)", "2000"), "a:14: Scale Factor is '2000/4000' (must be 'a(gal)/b'");
    check_refused(replaced(kKnetFile, "/4000", "/0"), "a:14: Scale Factor is '2000(gal)/0'");
    check_refused(replaced(kKnetFile, "4Hz", "0Hz"), "a:11: Sampling Freq(Hz) is '0Hz' (must be positive)");
    check_refused(replaced(kKnetFile, "  1\nDir", "  1000000000000\nDir"), "a:12: 1000000000000 s of 0.25 s steps are no usable length");
    check_refused(replaced(kKnetFile, "  1\nDir", "\nDir"), "a: header has no 'Duration Time(s)' (missing or empty)");
    check_refused(replaced(kKnetFile, "E-W", "EWE"), "a:13: Dir. is 'EWE' (known: N-S, E-W, U-D, 1 to 6)");
    check_refused(replaced(kKnetFile, "Record Time       2018/01/24 19:51:43", "Record Time       2018/01/24 25:51:43"),
                  "a:10: Record Time is '2018/01/24 25:51:43' (no date and time)");
    check_refused(kKnetFile, "file states its time step 0.25 s (asked for: 0.01 s)", {.dt = 0.01 * scaling::si::seconds});
    check_refused(kKnetFile, "file holds acceleration (asked for: velocity)", {.quantity = SampleQuantity::velocity});
}

struct KnetFile {
    std::string_view file;
    std::size_t size;
    double dt;    ///< [s]
    double peak;  ///< about the mean of the record, magnitude as in the header, sign as in README [gal]
    double time;  ///< of the peak [s]
    double pgv;   ///< high-passed at 0.05 Hz, three digits [cm/s]
};

TEST_CASE("real K-NET and KiK-net files have the peaks of their headers") {
    if (!tests::have_shared_records()) return;
    for (const KnetFile& row : {KnetFile{"knet/AOM0011801241951.EW", 10200, 0.01, 4.0781, 38.580, 0.339},
                                KnetFile{"knet/AOM0011801241951.NS", 10200, 0.01, -4.9544, 38.980, 0.281},
                                KnetFile{"knet/AOM0011801241951.UD", 10200, 0.01, -2.2401, 36.070, 0.178},
                                KnetFile{"knet/CHB0021412312349.EW", 6800, 0.01, -6.8468, 15.460, 0.0916},
                                KnetFile{"knet/test.knet", 5900, 0.01, 4.3833, 22.460, 0.739},
                                KnetFile{"kiknet/AICH040010061330.EW2", 28600, 0.005, -3.8959, 58.160, 0.987},
                                KnetFile{"kiknet/AICH040010061330.NS2", 28600, 0.005, -5.6051, 60.805, 1.49},
                                KnetFile{"kiknet/AICH040010061330.UD2", 28600, 0.005, -1.4880, 75.665, 0.470},
                                KnetFile{"kiknet/NGNH311106302345.EW1", 12000, 0.01, -0.19186, 15.430, 0.00565},
                                KnetFile{"kiknet/NGNH311106302345.EW2", 12000, 0.01, 0.70814, 16.940, 0.0151}}) {
        CAPTURE(row.file);
        const GroundMotion motion = read_record(tests::shared_records() / row.file);
        const TimeSeries& series = motion.components.front().series;
        CHECK(series.size() == row.size);
        CHECK(series.dt().value() == relative(row.dt, 1e-12));

        std::vector<double> samples(series.samples().begin(), series.samples().end());
        const double mean = std::accumulate(samples.begin(), samples.end(), 0.0) / static_cast<double>(samples.size());
        for (double& sample : samples) sample -= mean;
        const TimeSeries centred = series.with_samples(std::move(samples));
        const auto peak = find_peak_acceleration(centred);
        CHECK(peak.value.value() * 100.0 == relative(row.peak, 5e-5));
        CHECK(peak.time.value() == doctest::Approx(row.time));
        // three digits, and another way to continue the record at its ends: 1 %; the mean would ring where the record begins
        CHECK(std::abs(compute_intensity(centred, motion.integration_corner).pgv->value.value()) * 100.0 == relative(row.pgv, 0.01));
    }
}

}  // namespace
}  // namespace musim::records
