#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "records/formats/read_record.hpp"
#include "records/headers/text_file.hpp"
#include "tests/records/refusal.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/shared_records.hpp"
#include "tests/support/temporary_folder.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;

constexpr std::size_t kHeaderBytes = 632;

// overwrites the number at byte `at`
template <class Number>
std::string with(std::string bytes, std::size_t at, Number value, std::endian order = std::endian::little) {
    std::string raw(reinterpret_cast<const char*>(&value), sizeof value);
    if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
    return bytes.replace(at, raw.size(), raw);
}

// three samples 0.5, -2, 1 of acceleration at 50 per second, 1.5 s after 2000-02-29 01:02:03.004, component HNE of XX.ABC
std::string make_sac(std::endian order = std::endian::little) {
    std::string bytes(kHeaderBytes + 12, '\0');
    for (std::size_t at = 0; at < 280; at += 4) bytes = with(bytes, at, -12345.0F, order);
    for (std::size_t at = 280; at < 440; at += 4) bytes = with(bytes, at, std::int32_t{-12345}, order);
    for (std::size_t at = 440; at < kHeaderBytes; at += 8) bytes.replace(at, 8, "-12345  ");
    struct Real {
        std::size_t at;
        float value;
    };
    for (const auto& [at, value] : {Real{0, 0.02F}, Real{4, -2.0F}, Real{8, 1.0F}, Real{20, 1.5F}, Real{24, 1.54F}, Real{228, 90.0F},
                                    Real{232, 90.0F}, Real{632, 0.5F}, Real{636, -2.0F}, Real{640, 1.0F}}) {
        bytes = with(bytes, at, value, order);
    }
    struct Integer {
        std::size_t at;
        std::int32_t value;
    };
    for (const auto& [at, value] : {Integer{280, 2000}, Integer{284, 60}, Integer{288, 1}, Integer{292, 2}, Integer{296, 3},
                                    Integer{300, 4}, Integer{304, 6}, Integer{316, 3}, Integer{340, 1}, Integer{344, 8}, Integer{420, 1}}) {
        bytes = with(bytes, at, value, order);
    }
    return bytes.replace(440, 8, "ABC     ").replace(600, 8, "HNE     ").replace(608, 8, "XX      ");
}

TEST_CASE("a SAC file of either byte order gives clock, names and samples") {
    const tests::TemporaryFolder folder;
    for (const std::endian order : {std::endian::little, std::endian::big}) {
        const GroundMotion motion = read_record(folder.write("a", make_sac(order)), {.unit = "g"});

        CHECK(motion.format == "SAC");
        CHECK(motion.station == "XX.ABC");
        CHECK(motion.time_zero == make_utc_time(2000, 2, 29, 1, 2, 3.004));
        const Component& component = motion.find_component("HNE");
        CHECK(component.azimuth_deg == 90.0);
        const TimeSeries expected(SampleQuantity::acceleration, 1.5 * scaling::si::seconds, 0.02 * scaling::si::seconds,
                                  {0.5 * 9.80665, -2.0 * 9.80665, 9.80665});
        CHECK(component.series == expected);
    }
}

TEST_CASE("LEVEN of a SAC file is true when it is not zero") {
    const tests::TemporaryFolder folder;
    const TimeSeries expected = read_record(folder.write("a", make_sac()), {.unit = "g"}).components.front().series;
    for (const std::int32_t value : {-1, 2, -12345}) {
        CAPTURE(value);
        CHECK(read_record(folder.write("b", with(make_sac(), 420, value)), {.unit = "g"}).components.front().series == expected);
    }
}

TEST_CASE("the unit of a SAC file has to be named, and to be of the quantity that its header gives") {
    const tests::TemporaryFolder folder;
    const auto path = folder.write("a", make_sac());
    const auto message = [&](const ReadOptions& options) { return tests::message_of<ReadError>([&] { read_record(path, options); }); };

    CHECK(message({}).find("a: unit of the samples is not given (SAC means nm/s^2 with IDEP = 8") != std::string::npos);
    CHECK(message({.unit = "cm"}).find("a: file holds acceleration (IDEP = 8; asked for: cm)") != std::string::npos);
    CHECK(message({.unit = "volt"}).find("a: unit 'volt' is unknown") != std::string::npos);
    CHECK(message({.dt = 0.01 * scaling::si::seconds, .unit = "g"}).find("a: file states its time step 0.02 s") != std::string::npos);

    // as the format's authors mean it
    const GroundMotion motion = read_record(path, {.unit = "nm/s^2"});
    CHECK(motion.components.front().series.samples()[1] == relative(-2e-9, 1e-15));
    // a header that gives nothing leaves the quantity to the unit
    const auto not_given = folder.write("b", with(make_sac(), 344, std::int32_t{5}));
    CHECK(read_record(not_given, {.unit = "cm/s"}).components.front().series.quantity() == SampleQuantity::velocity);
}

TEST_CASE("every defect of a SAC file is reported") {
    struct Case {
        std::string content;
        std::string said;
    };
    const std::string good = make_sac();
    const auto integer = [&](std::size_t at, std::int32_t value) { return with(good, at, value); };
    const auto real = [&](std::size_t at, float value) { return with(good, at, value); };
    for (const Case& row : {
             Case{good.substr(0, kHeaderBytes), "a: 632 bytes (a SAC header has 632, then come the samples; file is truncated)"},
             Case{good.substr(0, 400), "a: 400 bytes (a SAC header has 632"},
             Case{good.substr(0, good.size() - 1), "a: 11 bytes of samples for NPTS = 3 (file is truncated, 12 bytes expected)"},
             Case{good + "abcd", "a: 16 bytes of samples for NPTS = 3 (more samples than announced"},
             Case{integer(316, 0), "a: NPTS is 0 (must be positive)"},
             Case{integer(316, -12345), "a: NPTS is -12345"},
             Case{integer(316, std::numeric_limits<std::int32_t>::max()), "a: 12 bytes of samples for NPTS = 2147483647"},
             Case{real(0, -0.02F), "a: DELTA is -0.02 s"},
             Case{real(0, -12345.0F), "a: DELTA is -12345 s"},
             Case{real(0, std::numeric_limits<float>::quiet_NaN()), "a: DELTA is nan s"},
             Case{real(20, -12345.0F), "a: B is undefined"},
             Case{real(24, 1.6F), "a: E is 1.6 s (B, NPTS and DELTA make 1.54 s)"},
             Case{integer(340, 2), "a: SAC file type is 2"},
             Case{integer(420, 0), "a: LEVEN is 0"},
             Case{integer(284, 367), "a: reference time is year 2000, day 367"},
             Case{integer(288, 24), "a: reference time is year 2000, day 60, 24:2:3"},
             Case{real(4, -3.0F), "a: least sample is -2 (DEPMIN says -3)"},
             Case{real(8, 2.0F), "a: greatest sample is 1 (DEPMAX says 2)"},
             Case{real(636, std::numeric_limits<float>::infinity()), "a: sample 2 is inf"},
         }) {
        tests::check_refused(row.content, row.said, {.unit = "g"});
    }
}

TEST_CASE("real SAC files have the length, time step and extremes of their headers, the extremes where they were measured") {
    if (!tests::have_shared_records()) return;
    struct Case {
        std::string_view file;
        std::string_view component;
        std::size_t size;
        double dt;
        double least;
        double greatest;
        bool is_greatest_first;  ///< which of the two is the peak
        double peak_time;        ///< [s]
    };
    for (const Case& row : {
             Case{"sac/20190706031952.CJ.T001230.HNE.sac", "HNE", 15001, 0.02, 0.002108, 0.043384, true, 77.04},
             Case{"sac/20190706031952.CJ.T001230.HNN.sac", "HNN", 15001, 0.02, -0.003742, 0.0342233, true, 71.28},
             Case{"sac/20190706031952.CJ.T001230.HNZ.sac", "HNZ", 15001, 0.02, 0.993741, 1.01217, true, 73.0},
             Case{"sac/ALCTENE.UW..sac", "ENE", 10400, 0.01, -0.407088, 0.380344, false, 38.29},
             Case{"sac/test.sac.swap", "Q", 100, 1.0, -1.0, 1.0, false, 5.0},
         }) {
        CAPTURE(row.file);
        const TimeSeries series = read_record(tests::shared_records() / row.file, {.unit = "m/s^2"}).find_component(row.component).series;

        CHECK(series.size() == row.size);
        CHECK(series.dt().value() == row.dt);
        const auto [least, greatest] = std::minmax_element(series.samples().begin(), series.samples().end());
        CHECK(*least == relative(row.least, 5e-6));
        CHECK(*greatest == relative(row.greatest, 5e-6));
        const auto peak = (row.is_greatest_first ? greatest : least) - series.samples().begin();
        CHECK(static_cast<double>(peak) * row.dt == relative(row.peak_time, 1e-12));
    }
}

TEST_CASE("the headers of real SAC files give station, clock and direction") {
    if (!tests::have_shared_records()) return;
    const GroundMotion east = read_record(tests::shared_records() / "sac/20190706031952.CJ.T001230.HNE.sac", {.unit = "g"});
    CHECK(east.station == "CJ.T001230");
    CHECK(east.time_zero == make_utc_time(2019, 7, 6, 3, 19, 52.0));
    CHECK(east.components.front().azimuth_deg == 90.0);
    CHECK(east.integration_corner.has_value());

    const GroundMotion up = read_record(tests::shared_records() / "sac/20190706031952.CJ.T001230.HNZ.sac", {.unit = "g"});
    CHECK_FALSE(up.components.front().azimuth_deg);  // CMPINC 0: vertical, though CMPAZ is 90

    const GroundMotion sine = read_record(tests::shared_records() / "sac/test.sac.swap", {.unit = "m/s"});
    CHECK(sine.station == "STA");
    CHECK(sine.event == "FUNCGEN: SINE");
    CHECK(sine.time_zero == make_utc_time(1978, 7, 18, 8, 0, 0.0));
    CHECK(sine.components.front().series.start().value() == 10.0);
}

TEST_CASE("a real SAC file without a named unit is refused") {
    if (!tests::have_shared_records()) return;
    const std::string message =
        tests::message_of<ReadError>([] { read_record(tests::shared_records() / "sac/20190706031952.CJ.T001230.HNE.sac"); });
    CHECK(message.find("HNE.sac: unit of the samples is not given") != std::string::npos);
}

}  // namespace
}  // namespace musim::records
