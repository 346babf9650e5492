#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "records/atomic_file.hpp"
#include "records/detail/text.hpp"
#include "records/formats/detail/mseed_record.hpp"
#include "records/formats/detail/streams.hpp"
#include "records/formats/write_record.hpp"
#include "records/headers/own_titles.hpp"

namespace musim::records {
namespace {

constexpr int kRecordBytes = 4096;

// first letter of a channel code: the band of the sampling rate, by the SEED manual
char band_letter(double rate) {
    if (rate >= 1000.0) return 'F';
    if (rate >= 250.0) return 'C';
    if (rate >= 80.0) return 'H';
    if (rate >= 10.0) return 'B';
    return rate > 1.0 ? 'M' : 'L';
}

char instrument_letter(SampleQuantity quantity) {
    if (quantity == SampleQuantity::acceleration) return 'N';
    if (quantity == SampleQuantity::angular_velocity) return 'J';
    return quantity == SampleQuantity::velocity ? 'H' : 'Y';
}

char orientation_letter(const Component& component, std::size_t ordinal) {
    if (component.azimuth_deg == 0.0 || component.azimuth_deg == 360.0) return 'N';
    if (component.azimuth_deg == 90.0) return 'E';
    if (detail::equal_ignoring_case(component.name, "up")) return 'Z';
    return static_cast<char>('0' + ordinal % 10);
}

std::string channel_code(const Component& component, std::size_t ordinal) {
    const std::string& name = component.name;
    const SampleQuantity quantity = component.series.quantity();
    const bool is_code =
        name.size() == 3 && name[1] == instrument_letter(quantity) &&
        std::all_of(name.begin(), name.end(), [](char letter) { return detail::is_digit(letter) || (letter >= 'A' && letter <= 'Z'); });
    if (is_code) return name;
    return {band_letter(1.0 / component.series.dt().value()), instrument_letter(quantity), orientation_letter(component, ordinal)};
}

/// Samples of a stream, and its name in messages.
struct StreamSamples {
    std::span<const double> samples;
    double rate;  ///< [Hz]
    std::string name;
};

void require_rate(const std::filesystem::path& path, const StreamSamples& stream) {
    std::int16_t factor = 0;
    std::int16_t multiplier = 0;
    const bool is_held =
        ms_genfactmult(stream.rate, &factor, &multiplier) == 0 &&
        std::abs(ms_nomsamprate(factor, multiplier) - stream.rate) * static_cast<double>(stream.samples.size()) <= 0.01 * stream.rate;
    if (is_held) return;
    throw WriteError(
        fmt::format("{}: sampling rate {} Hz of '{}' cannot be held (miniSEED 2 has fractions of 16-bit numbers); write CSV or AT2",
                    path.string(), stream.rate, stream.name));
}

/// The first sample's instant; without a clock its start counts from 1970.
UtcTime find_start(const std::filesystem::path& path, const GroundMotion& motion, const Component& component) {
    const std::optional<UtcTime> start = find_instant(motion.time_zero.value_or(UtcTime{}), component.series.start());
    if (start && detail::is_clockless(*start) != motion.time_zero.has_value()) return *start;
    throw WriteError(
        fmt::format("{}: start {} s of '{}' cannot be held (miniSEED has a date, or less than a day of an unknown clock); write CSV",
                    path.string(), component.series.start().value(), component.name));
}

void append_record(char* record, int length, void* bytes) {
    static_cast<std::string*>(bytes)->append(record, static_cast<std::size_t>(length));
}

void copy_code(const std::string& code, std::span<char> field) {
    const std::size_t length = std::min(code.size(), field.size() - 1);
    std::copy_n(code.begin(), length, field.begin());
    field[length] = '\0';
}

/// Title of a stream.
struct StreamTitle {
    std::string network, station, channel;
    UtcTime start;
};

void append_stream(const std::filesystem::path& path, const StreamSamples& stream, const StreamTitle& title, std::string& bytes) {
    require_rate(path, stream);
    detail::catch_mseed_complaints();
    const detail::MseedRecord record(msr_init(nullptr));
    if (!record) throw std::bad_alloc();
    copy_code(title.network, record->network);
    copy_code(title.station, record->station);
    copy_code(title.channel, record->channel);
    record->starttime = title.start.time_since_epoch().count();
    record->samprate = stream.rate;
    record->dataquality = 'D';
    record->reclen = kRecordBytes;
    record->encoding = DE_FLOAT64;
    record->byteorder = 1;  // big-endian, as readers expect
    record->sampletype = 'd';
    record->numsamples = static_cast<std::int64_t>(stream.samples.size());
    record->samplecnt = record->numsamples;

    // microseconds of the start time
    blkt_1001_s timing{};
    const bool is_timed = msr_addblockette(record.get(), reinterpret_cast<char*>(&timing), sizeof timing, 1001, 0) != nullptr;

    // libmseed reads the samples only, but takes them as its own
    std::vector<double> samples(stream.samples.begin(), stream.samples.end());
    record->datasamples = samples.data();
    std::int64_t packed = 0;
    const int records = is_timed ? msr_pack(record.get(), append_record, &bytes, &packed, 1, 0) : -1;
    record->datasamples = nullptr;
    if (records < 0 || packed != static_cast<std::int64_t>(stream.samples.size())) {
        throw WriteError(
            fmt::format("{}: {} cannot be packed ({}); write CSV or AT2", path.string(), title.channel, detail::last_mseed_complaint()));
    }
}

}  // namespace

void write_miniseed(const std::filesystem::path& path, const GroundMotion& motion) {
    if (motion.components.empty()) throw WriteError(fmt::format("{}: record has no components; nothing to write", path.string()));
    std::vector<std::string> codes;
    std::string bytes;
    for (const Component& component : motion.components) {
        if (component.series.quantity() != SampleQuantity::angular_velocity) refuse_rotation(path, component, "miniSEED streams");
        const std::string code = channel_code(component, codes.size() + 1);
        if (std::find(codes.begin(), codes.end(), code) != codes.end()) {
            throw WriteError(fmt::format("{}: component '{}' would be a second {} (channels are distinguished by their codes); rename it",
                                         path.string(), component.name, code));
        }
        codes.push_back(code);
        const auto station = detail::split_station(motion.station, "MUSIM");
        append_stream(path, {component.series.samples(), 1.0 / component.series.dt().value(), component.name},
                      {station.network, station.station, code, find_start(path, motion, component)}, bytes);
    }
    write_file_atomically(path, bytes);
}

void write_miniseed(const std::filesystem::path& path, const std::vector<SeedStream>& streams) {
    if (streams.empty()) throw WriteError(fmt::format("{}: there is no stream; nothing to write", path.string()));
    std::vector<std::string> names;
    std::string bytes;
    for (const SeedStream& stream : streams) {
        const double rate = 1.0 / stream.dt.value();
        const std::string channel = band_letter(rate) + stream.code, name = fmt::format("{}.{}", stream.station, channel);
        if (std::find(names.begin(), names.end(), name) != names.end()) {
            throw WriteError(
                fmt::format("{}: there would be two streams {} (they are distinguished by their codes); rename one", path.string(), name));
        }
        names.push_back(name);
        append_stream(path, {stream.samples, rate, name}, {"XX", stream.station, channel, UtcTime{}}, bytes);
    }
    write_file_atomically(path, bytes);
}

}  // namespace musim::records
