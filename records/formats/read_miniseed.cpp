#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>

#include "records/detail/text.hpp"
#include "records/formats/detail/mseed_record.hpp"
#include "records/formats/detail/parsers.hpp"
#include "records/formats/detail/streams.hpp"

namespace musim::records::detail {
namespace {

/// Layout of a record by its own header, every offset checked to lie within the record.
struct RecordLayout {
    std::size_t length = 0;
    std::size_t count = 0;  ///< samples
};

// bytes of a blockette; 0 for types without a fixed length
std::size_t blockette_length(unsigned type) {
    static const std::map<unsigned, std::size_t> kLengths{{100, 12}, {200, 52}, {201, 60}, {300, 60},  {310, 60}, {320, 64},
                                                          {390, 28}, {395, 16}, {400, 16}, {500, 200}, {1000, 8}, {1001, 8}};
    const auto length = kLengths.find(type);
    return length == kLengths.end() ? 0 : length->second;
}

// bytes of a sample; 1 bit and more for the Steim encodings, whose decoder counts frames itself; nothing for encodings not read
std::optional<std::size_t> sample_bytes(unsigned encoding) {
    static const std::map<unsigned, std::size_t> kBytes{{DE_INT16, 2},   {DE_INT32, 4},  {DE_FLOAT32, 4},
                                                        {DE_FLOAT64, 8}, {DE_STEIM1, 0}, {DE_STEIM2, 0}};
    const auto bytes = kBytes.find(encoding);
    return bytes == kBytes.end() ? std::nullopt : std::optional(bytes->second);
}

// the order in which year and day of the header make sense, as libmseed decides it
std::endian header_order(const RecordPlace& place, std::string_view bytes) {
    for (const std::endian order :
         {std::endian::native, std::endian::native == std::endian::little ? std::endian::big : std::endian::little}) {
        const unsigned year = number_at<std::uint16_t>(bytes, 20, order);
        const unsigned day = number_at<std::uint16_t>(bytes, 22, order);
        if (year >= 1900 && year <= 2100 && day >= 1 && day <= 366) return order;
    }
    place.fail("no year and day in the header (header is damaged)", "fetch the record again");
}

// libmseed trusts these offsets; they are checked before it sees the record
RecordLayout check_layout(const RecordPlace& place) {
    const std::string_view bytes = place.file.bytes().substr(place.at);
    if (bytes.size() < kMiniseedHeaderBytes)
        place.fail(fmt::format("{} bytes (a header has {}; file is truncated)", bytes.size(), kMiniseedHeaderBytes),
                   "fetch the record again");
    if (!is_miniseed_header(bytes)) place.fail("no record header (no sequence number and quality letter)", "fetch the record again");
    const std::endian order = header_order(place, bytes);
    const auto half_word = [&](std::size_t at) { return std::size_t{number_at<std::uint16_t>(bytes, at, order)}; };

    std::size_t blockette_end = kMiniseedHeaderBytes;
    std::size_t length = 0;
    unsigned encoding = 0;
    for (std::size_t at = half_word(46); at != 0;) {
        constexpr unsigned kDataOnlySeed = 1000;
        if (at < blockette_end || at + 4 > bytes.size())
            place.fail(fmt::format("blockette at {} (outside the header)", at), "fetch the record again");
        const auto type = static_cast<unsigned>(half_word(at));
        const std::size_t size = blockette_length(type);
        if (size == 0) place.fail(fmt::format("blockette {} (not known)", type), "convert the record without it");
        if (at + size > bytes.size())
            place.fail(fmt::format("blockette {} at {} is cut (file is truncated)", type, at), "fetch the record again");
        if (type == kDataOnlySeed) {
            const auto exponent = static_cast<unsigned char>(bytes[at + 6]);
            if (length != 0 || exponent < 7 || exponent > 20)
                place.fail(fmt::format("record length 2^{} (must be given once, 2^7 to 2^20)", exponent), "fetch the record again");
            length = std::size_t{1} << exponent;
            encoding = static_cast<unsigned char>(bytes[at + 4]);
        }
        blockette_end = at + size;
        at = half_word(at + 2);
    }

    if (length == 0) place.fail("no blockette 1000 (record length is not given)", "convert it to miniSEED 2");
    if (length > bytes.size())
        place.fail(fmt::format("{} of {} bytes (file is truncated)", bytes.size(), length), "fetch the record again");
    const RecordLayout layout{length, half_word(30)};
    const std::optional<std::size_t> width = sample_bytes(encoding);
    if (!width)
        place.fail(fmt::format("encoding {} (read: 16 and 32 bit integers, floats, Steim-1 and Steim-2)", encoding),
                   "convert it to Steim-2");
    const std::size_t data = half_word(44);
    if (blockette_end > length ||
        (layout.count > 0 && (data < kMiniseedHeaderBytes || data >= length || layout.count * *width > length - data))) {
        place.fail(fmt::format("{} samples from byte {} of {} (do not fit in the record)", layout.count, data, length),
                   "fetch the record again");
    }
    return layout;
}

MseedRecord unpack(const RecordPlace& place, const RecordLayout& layout) {
    std::string bytes(place.file.bytes().substr(place.at, layout.length));
    catch_mseed_complaints();
    MSRecord* record = nullptr;
    const int status = msr_unpack(bytes.data(), static_cast<int>(bytes.size()), &record, 1, 0);
    MseedRecord unpacked(record);
    const std::string complaint = last_mseed_complaint();
    if (status != MS_NOERROR || !complaint.empty()) {
        place.fail(
            fmt::format("samples cannot be decoded ({})", quoted(complaint.empty() ? ms_errorstr(status) : std::string_view(complaint))),
            "fetch the record again");
    }
    unpacked->record = nullptr;  // points into `bytes`
    if (unpacked->numsamples != static_cast<std::int64_t>(layout.count)) {
        place.fail(fmt::format("{} samples decoded (header says {})", unpacked->numsamples, layout.count), "fetch the record again");
    }
    return unpacked;
}

template <class Number>
void append(const RecordPlace& place, const MSRecord& record, std::vector<double>& counts) {
    for (const Number value : std::span(static_cast<const Number*>(record.datasamples), static_cast<std::size_t>(record.numsamples))) {
        const auto count = static_cast<double>(value);
        if (!std::isfinite(count)) place.fail(fmt::format("a sample is {} (no finite number)", count), "fetch the record again");
        counts.push_back(count);
    }
}

void add_record(const RecordPlace& place, const MSRecord& record, std::vector<Stream>& streams) {
    const Stream piece{
        .codes = {printable(record.network), printable(record.station), printable(record.location), printable(record.channel)},
        .first = UtcTime(std::chrono::microseconds(record.starttime)),
        .rate = record.samprate};
    Stream& stream = continue_stream(streams, piece, place.fails());
    if (record.sampletype == 'i') append<std::int32_t>(place, record, stream.samples);
    if (record.sampletype == 'f') append<float>(place, record, stream.samples);
    if (record.sampletype == 'd') append<double>(place, record, stream.samples);
}

std::vector<Stream> read_streams(const BinaryFile& file) {
    std::vector<Stream> streams;
    std::size_t ordinal = 1;
    for (std::size_t at = 0; at < file.bytes().size(); ++ordinal) {
        const RecordPlace place{file, ordinal, at};
        const RecordLayout layout = check_layout(place);
        if (layout.count > 0) add_record(place, *unpack(place, layout), streams);
        at += layout.length;
    }
    if (streams.empty()) file.fail("no samples in any record (logs or detections only)", "fetch the record again");
    return streams;
}

}  // namespace

GroundMotion parse_miniseed(const BinaryFile& file, const ReadOptions& options) {
    check_count_options(file, options, "miniSEED", true);
    return make_motion(file, "miniSEED", read_streams(file), options);
}

}  // namespace musim::records::detail
