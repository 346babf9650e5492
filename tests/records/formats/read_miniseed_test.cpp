#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "records/formats/read_record.hpp"
#include "records/measures/intensity.hpp"
#include "records/processing/processing.hpp"
#include "tests/records/refusal.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/shared_records.hpp"
#include "tests/support/temporary_folder.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;

constexpr std::size_t kRecordBytes = 128;

std::string big_endian(std::uint32_t value, std::size_t bytes) {
    std::string raw;
    for (std::size_t i = bytes; i-- > 0;) raw += static_cast<char>(value >> (8 * i) & 0xFF);
    return raw;
}

// bytes at `at` replaced
std::string with(std::string record, std::size_t at, const std::string& bytes) { return record.replace(at, bytes.size(), bytes); }

/// A record of 32-bit integers at 100 samples a second, `tenths_of_ms` after 2020-02-29 12:00:00.
std::string make_record(const std::string& channel, std::uint32_t tenths_of_ms, const std::vector<std::int32_t>& counts,
                        const std::string& location = "  ") {
    std::string record = "000001D ABC  " + location + channel + "XX";
    record += big_endian(2020, 2) + big_endian(60, 2) + std::string("\x0C\0\0\0", 4) + big_endian(tenths_of_ms, 2);
    record += big_endian(static_cast<std::uint32_t>(counts.size()), 2) + big_endian(100, 2) + big_endian(1, 2);
    record += std::string("\0\0\0\1", 4) + big_endian(0, 4) + big_endian(64, 2) + big_endian(48, 2);
    record += big_endian(1000, 2) + big_endian(0, 2) + std::string("\3\1\7\0", 4);
    record.resize(64, '\0');
    for (const std::int32_t count : counts) record += big_endian(static_cast<std::uint32_t>(count), 4);
    record.resize(kRecordBytes, '\0');
    return record;
}

std::string station_xml(const std::string& epochs) {
    return R"(<?xml version="1.0"?><FDSNStationXML xmlns="http://www.fdsn.org/xml/station/1"><Network code="XX"><Station code="ABC">)" +
           epochs + "</Station></Network></FDSNStationXML>";
}

std::string epoch(const std::string& dates, const std::string& sensitivity, const std::string& input,
                  const std::string& output = "counts") {
    return "<Channel code=\"HNE\" locationCode=\"\" " + dates +
           "><Azimuth>90.0</Azimuth><Dip>0.0</Dip><Response><InstrumentSensitivity><Value>" + sensitivity +
           "</Value><Frequency>1</Frequency><InputUnits><Name>" + input + "</Name></InputUnits><OutputUnits><Name>" + output +
           "</Name></OutputUnits></InstrumentSensitivity></Response></Channel>";
}

const std::string kAlways = R"(startDate="2000-01-01T00:00:00")";

TEST_CASE("the records of a miniSEED file become components with their own starts, divided by the sensitivity") {
    const tests::TemporaryFolder folder;
    const auto path = folder.write("a", make_record("HNE", 100, {4, -8}) + make_record("HNZ", 0, {2}) + make_record("HNE", 300, {12}));

    const GroundMotion motion = read_record(path, {.sensitivity = 4.0});

    CHECK(motion.format == "miniSEED");
    CHECK(motion.station == "XX.ABC");
    CHECK(motion.component_names() == "HNE, HNZ");
    CHECK(motion.time_zero == make_utc_time(2020, 2, 29, 12, 0, 0.0));
    REQUIRE(motion.integration_corner);
    CHECK(motion.integration_corner->value() == 0.05);
    const scaling::Time dt = 0.01 * scaling::si::seconds;
    CHECK(motion.components[0].series == TimeSeries(SampleQuantity::acceleration, dt, dt, {1.0, -2.0, 3.0}));
    CHECK(motion.components[1].series == TimeSeries(SampleQuantity::acceleration, 0.0 * dt, dt, {0.5}));
}

TEST_CASE("a channel code that occurs at two locations is distinguished by them") {
    const tests::TemporaryFolder folder;
    const auto path = folder.write("a", make_record("HNE", 0, {1}, "00") + make_record("HNE", 0, {2}, "10"));

    CHECK(read_record(path, {.sensitivity = 1.0}).component_names() == "00.HNE, 10.HNE");
}

TEST_CASE("the instrument letter suggests the quantity, and an option decides it but for counts of an accelerometer") {
    const tests::TemporaryFolder folder;
    const auto velocity = folder.write("a", make_record("HHE", 0, {1}));
    const auto unknown = folder.write("b", make_record("HYE", 0, {1}));
    const auto message = [](const auto& path, const ReadOptions& options) {
        return tests::message_of<ReadError>([&] { read_record(path, options); });
    };

    CHECK(read_record(velocity, {.sensitivity = 1.0}).components.front().series.quantity() == SampleQuantity::velocity);
    // a response was removed, or an accelerometer has a seismometer's code, as HL in Taiwan
    for (const double sensitivity : {1.0, 400.0}) {
        const Component component =
            read_record(velocity, {.quantity = SampleQuantity::acceleration, .sensitivity = sensitivity}).components.front();
        CHECK(component.series.quantity() == SampleQuantity::acceleration);
        CHECK(component.series.samples()[0] == 1.0 / sensitivity);
    }
    const auto accelerometer = folder.write("c", make_record("HNE", 0, {1}));
    CHECK(message(accelerometer, {.quantity = SampleQuantity::velocity, .sensitivity = 400.0})
              .find("c: channel HNE is an accelerometer's (asked for: velocity in counts)") != std::string::npos);
    CHECK(read_record(accelerometer, {.quantity = SampleQuantity::velocity, .sensitivity = 1.0}).components.front().series.quantity() ==
          SampleQuantity::velocity);
    CHECK(message(unknown, {.sensitivity = 1.0}).find("b: channel code 'HYE' does not say what is measured") != std::string::npos);
    CHECK(read_record(unknown, {.quantity = SampleQuantity::displacement, .sensitivity = 1.0}).components.front().series.quantity() ==
          SampleQuantity::displacement);
}

TEST_CASE("counts without a sensitivity, and options that contradict, are refused") {
    const tests::TemporaryFolder folder;
    const auto path = folder.write("a", make_record("HNE", 0, {1}));
    const auto text = folder.write("b", "1\n2\n3\n");
    const auto message = [&](const ReadOptions& options) { return tests::message_of<ReadError>([&] { read_record(path, options); }); };

    CHECK(message({}).find("a: sensitivity is not given (miniSEED holds counts); give the station's StationXML, or the sensitivity") !=
          std::string::npos);
    CHECK(message({.sensitivity = 0.0}).find("a: sensitivity is 0 counts") != std::string::npos);
    CHECK(message({.sensitivity = 1.0, .station_xml = "x"}).find("a: sensitivity and StationXML are both given") != std::string::npos);
    CHECK(message({.unit = "g", .sensitivity = 1.0}).find("a: unit g is asked for") != std::string::npos);
    CHECK(message({.dt = 0.02 * scaling::si::seconds, .sensitivity = 1.0}).find("a: file states its time step 0.01 s") !=
          std::string::npos);
    CHECK(message({.sensitivity = 1e-320}).find("a: a sample of XX.ABC..HNE overflows") != std::string::npos);
    CHECK(tests::message_of<ReadError>([&] {
              read_record(text, {.dt = 1.0 * scaling::si::seconds, .sensitivity = 2.0});
          }).find("b: sensitivity is given (the file holds no counts)") != std::string::npos);
}

TEST_CASE("every defect of a miniSEED file is reported with its record") {
    struct Case {
        std::string content;
        std::string said;
    };
    const std::string good = make_record("HNE", 0, {1, 2});
    for (const Case& row : {
             Case{good + make_record("HNE", 300, {1}), "a: record 2 (byte 128): gap of 0.01 s in XX.ABC..HNE, 0.020000 s after its first"},
             Case{good + make_record("HNE", 100, {1}), "a: record 2 (byte 128): overlap of 0.01 s in XX.ABC..HNE"},
             Case{good + with(make_record("HNE", 200, {1}), 32, big_endian(50, 2)),
                  "a: record 2 (byte 128): sample rate of XX.ABC..HNE is 50 Hz (before: 100 Hz)"},
             Case{good.substr(0, 127), "a: record 1 (byte 0): 127 of 128 bytes (file is truncated)"},
             Case{good.substr(0, 52), "a: record 1 (byte 0): blockette 1000 at 48 is cut"},
             Case{good + good.substr(0, 20), "a: record 2 (byte 128): 20 bytes (a header has 48; file is truncated)"},
             Case{good + std::string(kRecordBytes, 'x'), "a: record 2 (byte 128): no record header"},
             Case{with(good, 20, big_endian(0, 2)), "a: record 1 (byte 0): no year and day"},
             Case{with(good, 30, big_endian(17, 2)), "a: record 1 (byte 0): 17 samples from byte 64 of 128 (do not fit in the record)"},
             Case{with(good, 30, big_endian(0, 2)), "a: no samples in any record"},
             Case{with(good, 44, big_endian(40, 2)), "a: record 1 (byte 0): 2 samples from byte 40 of 128"},
             Case{with(good, 44, big_endian(65535, 2)), "a: record 1 (byte 0): 2 samples from byte 65535 of 128"},
             Case{with(good, 46, big_endian(0, 2)), "a: record 1 (byte 0): no blockette 1000"},
             Case{with(good, 46, big_endian(126, 2)), "a: record 1 (byte 0): blockette at 126 (outside the header)"},
             Case{with(good, 50, big_endian(48, 2)), "a: record 1 (byte 0): blockette at 48 (outside the header)"},
             Case{with(good, 48, big_endian(2000, 2)), "a: record 1 (byte 0): blockette 2000 (not known)"},
             Case{with(good, 52, std::string(1, '\x10')), "a: record 1 (byte 0): encoding 16 (read:"},
             Case{with(good, 54, std::string(1, '\x3F')), "a: record 1 (byte 0): record length 2^63"},
             Case{with(good, 54, std::string(1, '\x08')), "a: record 1 (byte 0): 128 of 256 bytes (file is truncated)"},
             Case{with(good, 32, big_endian(0, 2)), "a: record 1 (byte 0): sample rate is 0 Hz"},
             // a Steim frame whose samples do not add up to its last one
             Case{with(with(good, 52, std::string(1, '\x0A')), 68, big_endian(7, 4)), "a: record 1 (byte 0): samples cannot be decoded"},
             Case{with(good, 52, std::string(1, '\x04')).replace(64, 4, big_endian(0x7FC00000, 4)),
                  "a: record 1 (byte 0): a sample is nan"},
             Case{good + with(make_record("HNE", 0, {1}), 18, "YY"),
                  "a: record 2 (byte 128): YY.ABC..HNE follows XX.ABC..HNE (one station"},
         }) {
        tests::check_refused(row.content, row.said, {.sensitivity = 1.0});
    }
}

TEST_CASE("StationXML gives sensitivity, quantity and direction of the epoch that covers the record") {
    const tests::TemporaryFolder folder;
    const auto path = folder.write("a", make_record("HNE", 0, {6}));
    const auto xml =
        folder.write("a.xml", station_xml(epoch(R"(startDate="2000-01-01T00:00:00" endDate="2010-01-01T00:00:00Z")", "7", "m") +
                                          epoch(R"(startDate="2010-01-01T00:00:00.5")", "2E0", "CM/S**2")));

    const Component component = read_record(path, {.station_xml = xml}).find_component("HNE");

    CHECK(component.series.quantity() == SampleQuantity::acceleration);
    CHECK(component.series.samples()[0] == relative(0.03, 1e-15));  // 2 counts per cm/s²
    CHECK(component.azimuth_deg == 90.0);
}

TEST_CASE("a comment within a value of a StationXML is left out") {
    const tests::TemporaryFolder folder;
    const auto path = folder.write("a", make_record("HNE", 0, {6}));
    const auto xml = folder.write("a.xml", station_xml(epoch(kAlways, "1<!-- by hand -->2", "m/s<!-- -->**2")));

    CHECK(read_record(path, {.station_xml = xml}).components.front().series.samples()[0] == 6.0 / 12.0);
}

TEST_CASE("StationXML that does not give the sensitivity is refused by its name") {
    struct Case {
        std::string content;
        std::string said;
    };
    const tests::TemporaryFolder folder;
    const auto path = folder.write("a", make_record("HNE", 0, {6}));
    const std::string good = epoch(kAlways, "2", "m/s**2");
    for (const Case& row : {
             Case{"no xml", "a.xml: is no XML (byte 6:"},
             Case{station_xml(good).substr(0, 300), "a.xml: is no XML (byte "},
             Case{"<a/>", "a.xml: is no StationXML"},
             Case{station_xml(""), "a.xml: no response of XX.ABC..HNE (channel is not in the file)"},
             // times without colons or without two digits each are none
             Case{station_xml(epoch(R"(startDate="2000-01-01T000000")", "2", "m/s**2") +
                              epoch(R"(startDate="2000-01-01T0:00:00.0")", "2", "m/s**2")),
                  "a.xml: no response of XX.ABC..HNE (its epochs do not cover the record's time)"},
             Case{station_xml(epoch(R"(startDate="2021-01-01T00:00:00")", "2", "m/s**2")),
                  "a.xml: no response of XX.ABC..HNE (its epochs do not cover the record's time)"},
             Case{station_xml(good + good), "a.xml: two epochs of XX.ABC..HNE cover the record"},
             Case{station_xml(epoch(kAlways, "x", "m/s**2")), "a.xml: sensitivity of XX.ABC..HNE is 'x'"},
             Case{station_xml(epoch(kAlways, "0", "m/s**2")), "a.xml: sensitivity of XX.ABC..HNE is '0'"},
             Case{station_xml(epoch(kAlways, "2", "Pa")), "a.xml: XX.ABC..HNE senses 'Pa'"},
             Case{station_xml(epoch(kAlways, "2", "m/s**2", "V")), "a.xml: XX.ABC..HNE gives out 'V' (must be counts)"},
             Case{station_xml(epoch(kAlways, "2", "m")), "a: XX.ABC..HNE is an accelerometer by its code N (a.xml gives counts per m)"},
             Case{station_xml(epoch(kAlways, "2", "m/s")), "a: XX.ABC..HNE is an accelerometer by its code N (a.xml gives counts per m/s)"},
         }) {
        const auto xml = folder.write("a.xml", row.content);
        const std::string message = tests::message_of<ReadError>([&] { read_record(path, {.station_xml = xml}); });
        CAPTURE(row.said);
        CAPTURE(message);
        CHECK(message.find(row.said) != std::string::npos);
        CHECK(message.find('\n') == std::string::npos);
    }
    CHECK_THROWS_AS(read_record(path, {.station_xml = folder.path() / "none"}), ReadError);
}

TEST_CASE("real miniSEED records have the length, clock, peak and velocity that were measured") {
    if (!tests::have_shared_records()) return;
    struct Case {
        std::string_view file;
        std::string_view xml;
        std::string_view component;
        double sensitivity;
        std::size_t size;
        double peak;  ///< about the level before the motion [m/s²]
        double time;  ///< [s]
        double pgv;   ///< high-passed at 0.05 Hz [cm/s]
        double first_second;
        std::optional<double> azimuth_deg;
    };
    for (const Case& row : {
             Case{"mseed/CI.CLC..HNE.mseed", "mseed/CI.CLC.xml", "HNE", 213945.0, 39001, 3.367, 39.33, 26.0, 23.0383, 90.0},
             Case{"mseed/CI.CLC..HNN.mseed", "mseed/CI.CLC.xml", "HNN", 213808.0, 39001, 4.9959, 40.67, 43.5, 23.0383, 0.0},
             Case{"mseed/CI.CLC..HNZ.mseed", "mseed/CI.CLC.xml", "HNZ", 213740.0, 39001, 3.3955, 39.36, 18.2, 23.0383, {}},
             Case{"mseed/CI.LRL..HNE.mseed", "mseed/CI.LRL.xml", "HNE", 213757.0, 39000, 1.827, 56.41, 12.2, 23.0484, 90.0},
         }) {
        CAPTURE(row.file);
        const auto path = tests::shared_records() / row.file;
        const GroundMotion motion = read_record(path, {.station_xml = tests::shared_records() / row.xml});
        const Component& component = motion.find_component(row.component);
        const TimeSeries& series = component.series;

        CHECK(series.size() == row.size);
        CHECK(series.dt().value() == 0.01);
        CHECK(series.start().value() == 0.0);
        CHECK(component.azimuth_deg == row.azimuth_deg);
        REQUIRE(motion.time_zero);
        const UtcTime minute = *make_utc_time(2019, 7, 6, 3, 19, 0.0);
        // the header counts tenths of a millisecond, blockette 1001 adds up to 99 microseconds
        CHECK(std::abs(std::chrono::duration<double>(*motion.time_zero - minute).count() - row.first_second) < 1e-4);
        // the source took the level before the motion, the instrument's offset, off before it filtered
        const Intensity intensity = compute_intensity(remove_initial_level(series), motion.integration_corner);
        CHECK(std::abs(intensity.pga->value.value()) == relative(row.peak, 2e-4));
        CHECK(intensity.pga->time.value() == relative(row.time, 1e-9));
        CHECK(std::abs(intensity.pgv->value.value()) * 100.0 == relative(row.pgv, 0.01));

        // the same number by hand gives the same samples
        CHECK(read_record(path, {.sensitivity = row.sensitivity}).components.front().series == series);
    }
}

TEST_CASE("a real miniSEED record needs a sensitivity of its own channel, and all its records") {
    if (!tests::have_shared_records()) return;
    const auto path = tests::shared_records() / "mseed/CI.LRL..HNE.mseed";
    const auto other_station = tests::shared_records() / "mseed/CI.CLC.xml";
    CHECK(tests::message_of<ReadError>([&] {
              read_record(path, {.station_xml = other_station});
          }).find("CI.CLC.xml: no response of CI.LRL..HNE (channel is not in the file)") != std::string::npos);

    // without its second record of 512 bytes
    const tests::TemporaryFolder folder;
    const auto holed = folder.write("a", tests::bytes_of(path).erase(512, 512));
    CHECK(tests::message_of<ReadError>([&] { read_record(holed, {.sensitivity = 1.0}); }).find("a: record 2 (byte 512): gap of ") !=
          std::string::npos);
}

}  // namespace
}  // namespace musim::records
