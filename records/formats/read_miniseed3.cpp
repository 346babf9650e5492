#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>

#include "records/detail/text.hpp"
#include "records/formats/detail/parsers.hpp"
#include "records/formats/detail/steim.hpp"
#include "records/formats/detail/streams.hpp"

namespace musim::records::detail {
namespace {

/// Places in the fixed header of a record [bytes], little-endian [FDSN miniSEED 3.0, section "Description of record fields"].
enum Miniseed3Place : std::size_t {
    kMs3Nanosecond = 4,
    kMs3Year = 8,
    kMs3DayOfYear = 10,
    kMs3Hour = 12,
    kMs3Minute = 13,
    kMs3Second = 14,
    kMs3Encoding = 15,
    kMs3Rate = 16,
    kMs3Count = 24,
    kMs3Checksum = 28,
    kMs3IdentifierLength = 33,
    kMs3ExtraLength = 34,
    kMs3DataLength = 36,
    kMs3HeaderBytes = 40
};

/// Encodings of the samples; text is for logs.
enum Miniseed3Encoding : unsigned {
    kMs3Text = 0,
    kMs3Int16 = 1,
    kMs3Int32 = 3,
    kMs3Float32 = 4,
    kMs3Float64 = 5,
    kMs3Steim1 = 10,
    kMs3Steim2 = 11
};

// CRC-32C [RFC 3720, appendix B.4] of one byte, its bits reflected
constexpr std::array<std::uint32_t, 256> make_checksum_table() {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t byte = 0; byte < table.size(); ++byte) {
        std::uint32_t value = byte;
        for (int bit = 0; bit < 8; ++bit) value = (value >> 1U) ^ ((value & 1U) != 0 ? 0x82F63B78U : 0U);
        table[byte] = value;
    }
    return table;
}

/// One record of the file, its lengths checked against the bytes that there are.
struct Miniseed3Record {
    RecordPlace place;
    std::string_view bytes;

    template <class Number>
    Number at(std::size_t where) const {
        return number_at<Number>(bytes, where, std::endian::little);
    }
    unsigned encoding() const { return at<std::uint8_t>(kMs3Encoding); }
    std::size_t count() const { return at<std::uint32_t>(kMs3Count); }
    std::string_view identifier() const { return bytes.substr(kMs3HeaderBytes, at<std::uint8_t>(kMs3IdentifierLength)); }
    std::string_view data() const { return bytes.substr(bytes.size() - at<std::uint32_t>(kMs3DataLength)); }
};

// of all bytes, those of the checksum itself taken as zero
std::uint32_t checksum_of(std::string_view bytes) {
    static constexpr std::array<std::uint32_t, 256> kTable = make_checksum_table();
    std::uint32_t sum = ~0U;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const bool is_checksum = i >= kMs3Checksum && i < kMs3Checksum + 4;
        const auto byte = is_checksum ? 0U : static_cast<unsigned char>(bytes[i]);
        sum = kTable[(sum ^ byte) & 0xFFU] ^ (sum >> 8U);
    }
    return ~sum;
}

Miniseed3Record read_miniseed3_record(const RecordPlace& place) {
    Miniseed3Record record{place, place.file.bytes().substr(place.at)};
    if (!is_miniseed3_header(record.bytes)) place.fail("no record header (no 'MS' and version 3)", "fetch the record again");
    if (record.bytes.size() < kMs3HeaderBytes) {
        place.fail(fmt::format("{} bytes (a header has {}; file is truncated)", record.bytes.size(), std::size_t{kMs3HeaderBytes}),
                   "fetch the record again");
    }
    const std::size_t length = std::size_t{kMs3HeaderBytes} + record.at<std::uint8_t>(kMs3IdentifierLength) +
                               record.at<std::uint16_t>(kMs3ExtraLength) + record.at<std::uint32_t>(kMs3DataLength);
    if (length > record.bytes.size())
        place.fail(fmt::format("{} of {} bytes (file is truncated)", record.bytes.size(), length), "fetch the record again");
    record.bytes = record.bytes.substr(0, length);
    const auto stated = record.at<std::uint32_t>(kMs3Checksum);
    if (const std::uint32_t found = checksum_of(record.bytes); found != stated) {
        place.fail(fmt::format("checksum is {:08x} (header says {:08x}; record is damaged)", found, stated), "fetch the record again");
    }
    return record;
}

UtcTime read_miniseed3_start(const Miniseed3Record& record) {
    const int year = record.at<std::uint16_t>(kMs3Year);
    const int day = record.at<std::uint16_t>(kMs3DayOfYear);
    const int hour = record.at<std::uint8_t>(kMs3Hour);
    const int minute = record.at<std::uint8_t>(kMs3Minute);
    const int second = record.at<std::uint8_t>(kMs3Second);
    const auto nanosecond = record.at<std::uint32_t>(kMs3Nanosecond);
    const std::optional<UtcTime> first_day = make_utc_time(year, 1, 1, hour, minute, second + 1e-9 * nanosecond);
    const bool is_in_year = day >= 1 && day <= (std::chrono::year(year).is_leap() ? 366 : 365);
    if (!first_day || !is_in_year || nanosecond >= 1'000'000'000) {
        record.place.fail(
            fmt::format("starts in year {}, day {}, {}:{}:{}, {} ns (no such time)", year, day, hour, minute, second, nanosecond),
            "fetch the record again");
    }
    return *first_day + std::chrono::days(day - 1);
}

// a rate [1/s], or a negative period [s]
double read_miniseed3_rate(const Miniseed3Record& record) {
    const auto rate = record.at<double>(kMs3Rate);
    return rate < 0.0 ? -1.0 / rate : rate;
}

template <class Number>
void append_numbers(const Miniseed3Record& record, std::vector<double>& samples) {
    const std::string_view data = record.data();
    if (record.count() > data.size() / sizeof(Number)) {
        record.place.fail(fmt::format("{} samples in {} bytes of data (do not fit)", record.count(), data.size()),
                          "fetch the record again");
    }
    for (std::size_t i = 0; i < record.count(); ++i) {
        const auto sample = static_cast<double>(number_at<Number>(data, i * sizeof(Number), std::endian::little));
        if (!std::isfinite(sample)) record.place.fail(fmt::format("a sample is {} (no finite number)", sample), "fetch the record again");
        samples.push_back(sample);
    }
}

void append_samples(const Miniseed3Record& record, std::vector<double>& samples) {
    const auto steim = [&](SteimCoding coding) {
        for (const std::int32_t count : decode_steim(record.data(), record.count(), coding, record.place.fails()))
            samples.push_back(static_cast<double>(count));
    };
    switch (record.encoding()) {
        case kMs3Int16:
            return append_numbers<std::int16_t>(record, samples);
        case kMs3Int32:
            return append_numbers<std::int32_t>(record, samples);
        case kMs3Float32:
            return append_numbers<float>(record, samples);
        case kMs3Float64:
            return append_numbers<double>(record, samples);
        case kMs3Steim1:
            return steim(SteimCoding::steim1);
        case kMs3Steim2:
            return steim(SteimCoding::steim2);
        default:
            record.place.fail(fmt::format("encoding {} (read: 16 and 32 bit integers, floats, Steim-1 and Steim-2)", record.encoding()),
                              "convert it to Steim-2");
    }
}

void add_miniseed3_record(const Miniseed3Record& record, std::vector<Stream>& streams) {
    const std::optional<StreamCodes> codes = parse_source_identifier(printable(record.identifier()));
    if (!codes) {
        record.place.fail(fmt::format("source identifier is {} (not FDSN:NET_STA_LOC_BAND_SOURCE_POSITION)", quoted(record.identifier())),
                          "correct it");
    }
    const Stream piece{.codes = *codes, .first = read_miniseed3_start(record), .rate = read_miniseed3_rate(record)};
    append_samples(record, continue_stream(streams, piece, record.place.fails()).samples);
}

}  // namespace

bool is_miniseed3_header(std::string_view bytes) { return bytes.starts_with("MS\3"); }

GroundMotion parse_miniseed3(const BinaryFile& file, const ReadOptions& options) {
    check_count_options(file, options, "miniSEED 3", true);
    std::vector<Stream> streams;
    std::size_t ordinal = 1;
    for (std::size_t at = 0; at < file.bytes().size(); ++ordinal) {
        const Miniseed3Record record = read_miniseed3_record({file, ordinal, at});
        if (record.count() > 0 && record.encoding() != kMs3Text) add_miniseed3_record(record, streams);
        at += record.bytes.size();
    }
    if (streams.empty()) file.fail("no samples in any record (logs or detections only)", "fetch the record again");
    return make_motion(file, "miniSEED 3", std::move(streams), options);
}

}  // namespace musim::records::detail
