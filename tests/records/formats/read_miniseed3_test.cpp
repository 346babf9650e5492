#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "records/formats/read_record.hpp"
#include "records/headers/text_file.hpp"
#include "tests/records/refusal.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/shared_records.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;

/// Values of a miniSEED 3 record made for a test; the rest is the same for all.
struct Ms3Record {
    std::string identifier = "FDSN:XX_ABC__H_N_E";
    std::uint16_t day = 60;  ///< of 2020: 29 February
    std::uint8_t hour = 12;
    std::uint8_t minute = 34;
    std::uint8_t second = 56;
    std::uint32_t nanosecond = 250'000'000;
    std::uint8_t encoding = 3;
    double rate = 100.0;
    std::uint32_t count = 0;
    std::string extra = {};
    std::string data = {};
};

template <class Number>
std::string little_endian(Number value) {
    std::string raw(sizeof value, '\0');
    std::memcpy(raw.data(), &value, sizeof value);
    static_assert(std::endian::native == std::endian::little);
    return raw;
}

// CRC-32C bit by bit, by the definition in RFC 3720
std::uint32_t checksum_by_bits(const std::string& bytes) {
    std::uint32_t sum = ~0U;
    for (const char letter : bytes) {
        sum ^= static_cast<unsigned char>(letter);
        for (int bit = 0; bit < 8; ++bit) sum = (sum >> 1U) ^ (0x82F63B78U & (0U - (sum & 1U)));
    }
    return ~sum;
}

std::string bytes_of_ms3(const Ms3Record& record) {
    std::string bytes = std::string("MS\3\0", 4) + little_endian(record.nanosecond) + little_endian(std::uint16_t{2020}) +
                        little_endian(record.day) + little_endian(record.hour) + little_endian(record.minute) +
                        little_endian(record.second) + little_endian(record.encoding) + little_endian(record.rate) +
                        little_endian(record.count) + std::string(4, '\0') + little_endian(std::uint8_t{1}) +
                        little_endian(static_cast<std::uint8_t>(record.identifier.size())) +
                        little_endian(static_cast<std::uint16_t>(record.extra.size())) +
                        little_endian(static_cast<std::uint32_t>(record.data.size())) + record.identifier + record.extra + record.data;
    return bytes.replace(28, 4, little_endian(checksum_by_bits(bytes)));
}

template <class Number>
Ms3Record record_of(std::uint8_t encoding, const std::vector<Number>& samples) {
    Ms3Record record{.encoding = encoding, .count = static_cast<std::uint32_t>(samples.size())};
    for (const Number sample : samples) record.data += little_endian(sample);
    return record;
}

std::string big_endian_words(const std::vector<std::uint32_t>& words) {
    std::string raw;
    for (const std::uint32_t word : words)
        for (int shift = 24; shift >= 0; shift -= 8) raw += static_cast<char>(word >> shift & 0xFFU);
    raw.resize((raw.size() + 63) / 64 * 64, '\0');
    return raw;
}

std::vector<double> samples_of(const std::string& bytes) {
    const tests::TemporaryFolder folder;
    const GroundMotion motion = read_record(folder.write("a", bytes), {.sensitivity = 1.0});
    const auto samples = motion.components.front().series.samples();
    return {samples.begin(), samples.end()};
}

TEST_CASE("the checksum of miniSEED 3 is CRC-32C") {
    CHECK(checksum_by_bits("123456789") == 0xE3069283U);  // the check value of its definition
}

TEST_CASE("numbers of every kind are read from miniSEED 3") {
    const std::vector<double> expected{1.0, -2.0, 3.0};
    CHECK(samples_of(bytes_of_ms3(record_of<std::int16_t>(1, {1, -2, 3}))) == expected);
    CHECK(samples_of(bytes_of_ms3(record_of<std::int32_t>(3, {1, -2, 3}))) == expected);
    CHECK(samples_of(bytes_of_ms3(record_of<float>(4, {1.0F, -2.0F, 3.0F}))) == expected);
    CHECK(samples_of(bytes_of_ms3(record_of<double>(5, {1.0, -2.0, 3.0}))) == expected);
}

TEST_CASE("differences of every length are read from Steim frames") {
    // Steim-1: 4 of 8 bits, 2 of 16, 1 of 32; the first leads from the record before
    const std::string first =
        big_endian_words({0b00'00'00'01'10'11U << 20U, 10, 10 - 2 + 3 - 1 + 300 - 300 + 70000, 0x63FE03FF, 0x012CFED4, 70000});
    const std::vector<double> of_first{10, 8, 11, 10, 310, 10, 70010};
    CHECK(samples_of(bytes_of_ms3({.encoding = 10, .count = 7, .data = first})) == of_first);

    // Steim-2: 4 of 8 bits; 1 of 30, 2 of 15, 3 of 10; 5 of 6, 6 of 5, 7 of 4, each all -1
    const std::uint32_t ones30 = 0x3FFFFFFF;
    const std::string second =
        big_endian_words({0b00'00'00'01'10'10'10'11'11'11U << 12U, 100, 100 - 27, 0xFFFFFFFF, 1U << 30U | ones30, 2U << 30U | ones30,
                          3U << 30U | ones30, 0U << 30U | ones30, 1U << 30U | ones30, 2U << 30U | (ones30 >> 2U)});
    std::vector<double> of_second;
    for (int i = 0; i < 28; ++i) of_second.push_back(100 - i);
    CHECK(samples_of(bytes_of_ms3({.encoding = 11, .count = 28, .data = second})) == of_second);
}

TEST_CASE("records of miniSEED 3 become components with their own starts") {
    const tests::TemporaryFolder folder;
    const Ms3Record east = record_of<std::int32_t>(3, {4, -8});
    Ms3Record later = east;
    later.nanosecond += 20'000'000;
    later.extra = R"({"FDSN":{"Time":{"Quality":100}}})";
    Ms3Record up = record_of<std::int32_t>(3, {2});
    up.identifier = "FDSN:XX_ABC__H_N_Z";
    up.rate = -0.01;  // a period
    up.nanosecond -= 50'000'000;
    const Ms3Record log{.encoding = 0, .rate = 0.0, .count = 4, .data = "text"};

    const GroundMotion motion = read_record(
        folder.write("a", bytes_of_ms3(east) + bytes_of_ms3(log) + bytes_of_ms3(up) + bytes_of_ms3(later)), {.sensitivity = 4.0});

    CHECK(motion.format == "miniSEED 3");
    CHECK(motion.station == "XX.ABC");
    CHECK(motion.component_names() == "HNE, HNZ");
    CHECK(motion.time_zero == make_utc_time(2020, 2, 29, 12, 34, 56.2));
    const TimeSeries& series = motion.components[0].series;
    CHECK(series.start().value() == relative(0.05, 1e-12));
    CHECK(series.dt().value() == 0.01);
    CHECK(std::vector<double>(series.samples().begin(), series.samples().end()) == std::vector<double>{1.0, -2.0, 1.0, -2.0});
    CHECK(motion.components[1].series.dt().value() == 0.01);
}

TEST_CASE("every defect of a miniSEED 3 file is reported with its record") {
    struct Case {
        std::string content;
        std::string said;
    };
    const Ms3Record good = record_of<std::int32_t>(3, {4, -8});
    const std::string bytes = bytes_of_ms3(good);
    const auto changed = [&](auto change) {
        Ms3Record record = good;
        change(record);
        return bytes_of_ms3(record);
    };
    std::string flipped = bytes;
    flipped.back() = static_cast<char>(flipped.back() ^ 1);
    const std::string frames = big_endian_words({0b00'00'00'01U << 24U, 10, 13, 0x00010101});
    for (const Case& row : {
             Case{bytes.substr(0, 20), "a: record 1 (byte 0): 20 bytes (a header has 40; file is truncated)"},
             Case{bytes.substr(0, bytes.size() - 1), "a: record 1 (byte 0): 65 of 66 bytes (file is truncated)"},
             Case{flipped, "a: record 1 (byte 0): checksum is "},
             Case{bytes + "abc", "a: record 2 (byte 66): no record header"},
             Case{changed([](Ms3Record& r) { r.count = 3; }), "a: record 1 (byte 0): 3 samples in 8 bytes of data (do not fit)"},
             Case{changed([](Ms3Record& r) { r.count = 4'000'000'000; }), "4000000000 samples in 8 bytes of data (do not fit)"},
             Case{changed([](Ms3Record& r) { r.encoding = 19; }), "a: record 1 (byte 0): encoding 19 (read:"},
             Case{changed([](Ms3Record& r) { r.day = 367; }), "starts in year 2020, day 367"},
             Case{changed([](Ms3Record& r) { r.hour = 24; }), "starts in year 2020, day 60, 24:34:56"},
             Case{changed([](Ms3Record& r) { r.nanosecond = 1'000'000'000; }), "1000000000 ns (no such time)"},
             Case{changed([](Ms3Record& r) { r.rate = 0.0; }), "a: record 1 (byte 0): sample rate is 0 Hz (must be positive)"},
             Case{changed([](Ms3Record& r) { r.rate = std::numeric_limits<double>::quiet_NaN(); }), "sample rate is nan Hz"},
             Case{changed([](Ms3Record& r) { r.identifier = "XX_ABC"; }), "source identifier is 'XX_ABC'"},
             Case{bytes_of_ms3({.encoding = 0, .count = 4, .data = "text"}), "a: no samples in any record"},
             Case{bytes + bytes, "a: record 2 (byte 66): overlap of 0.02 s in XX.ABC..HNE"},
             Case{bytes + changed([](Ms3Record& r) { r.nanosecond += 30'000'000; }), "a: record 2 (byte 66): gap of 0.01 s in XX.ABC..HNE"},
             Case{bytes + changed([](Ms3Record& r) { r.identifier = "FDSN:XX_DEF__H_N_E"; }), "XX.DEF..HNE follows XX.ABC..HNE"},
             Case{bytes_of_ms3({.encoding = 4, .count = 1, .data = little_endian(std::numeric_limits<float>::infinity())}),
                  "a sample is inf"},
             Case{bytes_of_ms3({.encoding = 10, .count = 4, .data = frames.substr(0, 60)}), "0 samples decoded (header says 4)"},
             Case{bytes_of_ms3({.encoding = 10, .count = 5, .data = frames}), "4 samples decoded (header says 5)"},
             Case{bytes_of_ms3({.encoding = 10, .count = 3, .data = frames}), "last sample is 12 (its frames announce 13; damaged)"},
             Case{bytes_of_ms3({.encoding = 11, .count = 4, .data = big_endian_words({0b00'00'00'10U << 24U, 10, 13, 0x00010101})}),
                  "word 4 of frame 1 has no valid code (damaged)"},
         }) {
        tests::check_refused(row.content, row.said, {.sensitivity = 1.0});
    }
    tests::check_refused(bytes, "a: sensitivity is not given (miniSEED 3 holds counts)");
}

TEST_CASE("Steim-2 frames of a real record are decoded as libmseed decodes them") {
    const std::filesystem::path real = tests::shared_records() / ".." / "cases" / "records" / "UU.HRU.01.ENE.mseed";
    if (!std::filesystem::exists(real)) {
        MESSAGE("skipped: there are no cases in ../shared/cases");
        return;
    }
    // the frames of each record of 512 bytes, 64 of them header, behind a header of miniSEED 3
    const std::string old = tests::bytes_of(real);
    std::string bytes;
    std::size_t samples = 0;
    for (std::size_t at = 0; at + 512 <= old.size(); at += 512) {
        const auto count = records::detail::number_at<std::uint16_t>(old, at + 30, std::endian::big);
        const std::size_t elapsed = samples / 100;  // [s]
        bytes += bytes_of_ms3({.hour = static_cast<std::uint8_t>(elapsed / 3600),
                               .minute = static_cast<std::uint8_t>(elapsed / 60 % 60),
                               .second = static_cast<std::uint8_t>(elapsed % 60),
                               .nanosecond = static_cast<std::uint32_t>(samples % 100 * 10'000'000),
                               .encoding = 11,
                               .count = count,
                               .data = old.substr(at + 64, 448)});
        samples += count;
    }
    const tests::TemporaryFolder folder;
    const GroundMotion expected = read_record(real, {.sensitivity = 1.0});
    const std::vector<double> found = samples_of(bytes);
    REQUIRE(found.size() == samples);
    CHECK(std::ranges::equal(found, expected.components.front().series.samples()));
}

}  // namespace
}  // namespace musim::records
