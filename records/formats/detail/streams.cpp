#include "records/formats/detail/streams.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <span>

#include "records/detail/text.hpp"
#include "records/formats/detail/parsers.hpp"
#include "records/formats/detail/station_xml.hpp"

namespace musim::records::detail {
namespace {

constexpr std::string_view kAccelerometer = "N";

// N is an accelerometer, J a rotational sensor; H and L, high and low gain seismometers, are velocity unless somebody says otherwise
std::optional<SampleQuantity> suggested_quantity(std::string_view channel) {
    const std::string_view instrument = instrument_of(channel);
    if (instrument == kAccelerometer) return SampleQuantity::acceleration;
    if (instrument == "H" || instrument == "L") return SampleQuantity::velocity;
    if (instrument == "J") return SampleQuantity::angular_velocity;
    return std::nullopt;
}

StreamResponse response_from_number(const InputFile& file, const ReadOptions& options, const StreamCodes& codes) {
    const double sensitivity = *options.sensitivity;
    if (sensitivity == 0.0 || !std::isfinite(sensitivity)) {
        file.fail(fmt::format("sensitivity is {} counts per SI unit (must be a number, not 0)", sensitivity),
                  Remedy{"correct ", Setting::sensitivity});
    }
    const std::optional<SampleQuantity> suggested = suggested_quantity(codes.channel);
    if (!suggested && !options.quantity) {
        file.fail(
            fmt::format("channel code {} does not say what is measured (known from N, H, L or J)", quoted(std::string_view(codes.channel))),
            Remedy{"give ", Setting::quantity});
    }
    // once a response was removed (sensitivity 1), the code says where samples come from, not what they are
    const bool is_accelerometer = instrument_of(codes.channel) == kAccelerometer && sensitivity != 1.0;
    if (is_accelerometer && options.quantity.value_or(*suggested) != *suggested) {
        file.fail(fmt::format("channel {} is an accelerometer's (asked for: {} in counts)", codes.channel, to_string(*options.quantity)),
                  Remedy{"drop ", Setting::quantity});
    }
    return {.quantity = options.quantity ? *options.quantity : *suggested, .sensitivity = sensitivity};
}

StreamResponse response_from_station_xml(const InputFile& file, const ReadOptions& options, const Stream& stream) {
    const std::chrono::duration<double> length(static_cast<double>(stream.samples.size() - 1) / stream.rate);
    if (!(length < std::chrono::years(1000)))
        file.fail(fmt::format("{} lasts {} s (sample rate is damaged)", to_string(stream.codes), length.count()), "fetch the record again");
    const UtcTime last = stream.first + std::chrono::duration_cast<std::chrono::microseconds>(length);
    StreamResponse response = read_stream_response(*options.station_xml, stream.codes, stream.first, last);
    if (instrument_of(stream.codes.channel) == kAccelerometer && response.quantity != SampleQuantity::acceleration) {
        file.fail(fmt::format("{} is an accelerometer by its code N ({} gives counts per {})", to_string(stream.codes),
                              options.station_xml->filename().string(), si_unit_name(response.quantity)),
                  Remedy{"correct the unit in the StationXML file, or give ", Setting::sensitivity, " in its place"});
    }
    return response;
}

StreamResponse find_response(const InputFile& file, const ReadOptions& options, const Stream& stream) {
    if (stream.unit) return {.quantity = stream.unit->quantity, .sensitivity = 1.0 / stream.unit->si, .azimuth_deg = stream.azimuth_deg};
    return options.sensitivity ? response_from_number(file, options, stream.codes) : response_from_station_xml(file, options, stream);
}

// channel codes, with the location where a code occurs twice
std::string component_name(const Stream& stream, std::span<const Stream> streams) {
    const auto same =
        std::count_if(streams.begin(), streams.end(), [&](const Stream& other) { return other.codes.channel == stream.codes.channel; });
    return same > 1 ? stream.codes.location + '.' + stream.codes.channel : stream.codes.channel;
}

}  // namespace

std::string to_string(const StreamCodes& codes) {
    return fmt::format("{}.{}.{}.{}", codes.network, codes.station, codes.location, codes.channel);
}

std::optional<StreamCodes> parse_source_identifier(std::string_view text) {
    constexpr std::string_view kScheme = "FDSN:";
    if (text.starts_with(kScheme)) text.remove_prefix(kScheme.size());
    std::vector<std::string> parts(1);
    for (const char letter : text) {
        if (letter == '_') {
            parts.emplace_back();
        } else {
            parts.back() += letter;
        }
    }
    if (parts.size() != 6) return std::nullopt;
    const bool is_short = parts[3].size() == 1 && parts[4].size() == 1 && parts[5].size() == 1;
    return StreamCodes{parts[0], parts[1], parts[2],
                       is_short ? parts[3] + parts[4] + parts[5] : fmt::format("{}_{}_{}", parts[3], parts[4], parts[5])};
}

std::string_view instrument_of(std::string_view channel) {
    const std::size_t gap = channel.find('_');
    if (gap == std::string_view::npos) return channel.size() < 2 ? std::string_view{} : channel.substr(1, 1);
    channel.remove_prefix(gap + 1);
    return channel.substr(0, channel.find('_'));
}

void RecordPlace::fail(std::string_view what_why, const Remedy& what_to_do) const {
    file.fail(fmt::format("record {} (byte {}): {}", ordinal, at, what_why), what_to_do);
}

Stream& continue_stream(std::vector<Stream>& streams, const Stream& piece, const FailPiece& fail) {
    if (!(piece.rate > 0.0) || !std::isfinite(piece.rate)) {
        fail(fmt::format("sample rate is {} Hz (must be positive)", piece.rate), "fetch the record again");
    }
    const auto stream = std::find_if(streams.begin(), streams.end(), [&](const Stream& other) { return other.codes == piece.codes; });
    if (stream == streams.end()) {
        streams.push_back(piece);
        const StreamCodes& first = streams.front().codes;
        if (piece.codes.network != first.network || piece.codes.station != first.station) {
            fail(fmt::format("{} follows {} (one station a file)", to_string(piece.codes), to_string(first)), "split the file by stations");
        }
        return streams.back();
    }

    if (piece.rate != stream->rate) {
        fail(fmt::format("sample rate of {} is {} Hz (before: {} Hz)", to_string(stream->codes), piece.rate, stream->rate),
             "split the file there");
    }
    if (piece.unit.has_value() != stream->unit.has_value() ||
        (piece.unit && (piece.unit->name != stream->unit->name || piece.unit->si != stream->unit->si))) {
        fail(fmt::format("unit of {} differs from that of its samples before", to_string(stream->codes)), "split the file there");
    }
    const double expected = static_cast<double>(stream->samples.size()) / stream->rate;
    const double elapsed = std::chrono::duration<double>(piece.first - stream->first).count();
    const double excess = elapsed - expected;
    if (!(std::abs(excess) * stream->rate <= 0.5)) {
        fail(fmt::format("{} of {:.6g} s in {}, {:.6f} s after its first sample (samples must follow one another)",
                         excess > 0.0 ? "gap" : "overlap", std::abs(excess), to_string(stream->codes), expected),
             "cut the record there");
    }
    return *stream;
}

void check_count_options(const InputFile& file, const ReadOptions& options, std::string_view format, bool counts) {
    if (!counts) {
        if (options.sensitivity || options.station_xml) {
            file.fail("sensitivity is given (the file names the unit of its samples)",
                      Remedy{"drop ", Setting::sensitivity, " or ", Setting::station_response});
        }
        return;
    }
    if (options.sensitivity && options.station_xml) {
        file.fail("sensitivity and StationXML are both given (they may differ)",
                  Remedy{"drop ", Setting::sensitivity, " or ", Setting::station_response});
    }
    if (!options.sensitivity && !options.station_xml) {
        file.fail(
            fmt::format("sensitivity is not given ({} holds counts)", format),
            Remedy{"give ", Setting::station_response, ", or ", Setting::sensitivity, " in counts per m/s^2 (1 if the samples are SI)"});
    }
    if (options.unit) {
        file.fail(fmt::format("unit {} is asked for ({} holds counts)", *options.unit, format),
                  Remedy{"drop ", Setting::unit, " (the sensitivity gives it)"});
    }
}

GroundMotion make_motion(const InputFile& file, std::string_view format, std::vector<Stream> streams, const ReadOptions& options) {
    GroundMotion motion{.source = file.path().string(), .format = std::string(format)};
    const auto earliest =
        std::min_element(streams.begin(), streams.end(), [](const Stream& a, const Stream& b) { return a.first < b.first; });
    // what has no clock counts from 1970, as the writer does
    const UtcTime zero = is_clockless(earliest->first) ? UtcTime{} : earliest->first;
    if (zero != UtcTime{}) motion.time_zero = zero;
    motion.station = streams.front().codes.network + '.' + streams.front().codes.station;
    std::string worth;
    for (Stream& stream : streams) {
        const StreamResponse response = find_response(file, options, stream);
        const scaling::Time dt = 1.0 / stream.rate * scaling::si::seconds;
        const SampleUnit unit = stream.unit ? *stream.unit : *find_sample_unit(si_unit_name(response.quantity));
        refuse_contradictions(file, {.dt = options.dt, .unit = options.unit, .quantity = options.quantity}, unit, dt);

        for (double& sample : stream.samples) {
            sample = stream.unit ? sample * stream.unit->si : sample / response.sensitivity;
            if (!std::isfinite(sample))
                file.fail(fmt::format("a sample of {} overflows (sensitivity {})", to_string(stream.codes), response.sensitivity),
                          "correct the sensitivity");
        }
        const double start = std::chrono::duration<double>(stream.first - zero).count();
        worth += stream.unit ? fmt::format(", {} in {}", stream.codes.channel, stream.unit->name)
                             : fmt::format(", {} {} counts per {}", stream.codes.channel, response.sensitivity, unit.name);
        motion.components.push_back({.name = component_name(stream, streams),
                                     .azimuth_deg = response.azimuth_deg,
                                     .series = {response.quantity, start * scaling::si::seconds, dt, std::move(stream.samples)}});
    }
    motion.integration_corner = kUncorrectedCornerHz * scaling::si::hertz;
    motion.history.push_back(fmt::format("read {} from {}{}", format, file.path().filename().string(), worth));
    return motion;
}

}  // namespace musim::records::detail
