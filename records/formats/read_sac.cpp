#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "records/detail/text.hpp"
#include "records/formats/detail/parsers.hpp"

namespace musim::records::detail {
namespace {

/// Places in a SAC header, version 6 [bytes]: 70 floats, 40 integers, 192 letters; then the samples, four bytes each.
enum Place : std::size_t {
    kDelta = 0,
    kDepMin = 4,
    kDepMax = 8,
    kBegin = 20,
    kEnd = 24,
    kMagnitude = 156,
    kSacAzimuth = 228,
    kInclination = 232,
    kYear = 280,  // then day of the year, hour, minute, second, millisecond
    kVersion = 304,
    kCount = 316,
    kFileType = 340,
    kDependent = 344,
    kIsEven = 420,
    kStation = 440,
    kEvent = 448,
    kChannel = 600,
    kNetwork = 608,
    kSamples = 632
};

constexpr int kUndefined = -12345;
constexpr std::size_t kSampleBytes = 4;

struct SacFile {
    const BinaryFile& file;
    std::endian order;

    int integer(std::size_t place) const { return number_at<std::int32_t>(file.bytes(), place, order); }
    float real(std::size_t place) const { return number_at<float>(file.bytes(), place, order); }
    bool has_real(std::size_t place) const { return std::isfinite(real(place)) && real(place) != static_cast<float>(kUndefined); }

    // eight or sixteen letters, ended by a NUL or blanks; nothing when undefined
    std::string text(std::size_t place, std::size_t width = 8) const {
        std::string_view letters = file.bytes().substr(place, width);
        letters = trim(letters.substr(0, letters.find('\0')));
        if (letters.starts_with("-12345")) return {};
        return printable(letters);
    }
};

// the short decimal that a float stands for: 0.02 for the float nearest to it
double decimal_of(float value) {
    std::array<char, 64> letters{};
    const auto end = std::to_chars(letters.data(), letters.data() + letters.size(), value).ptr;
    double result = 0.0;
    std::from_chars(letters.data(), end, result);
    return result;
}

void require_evenly_spaced_series(const SacFile& sac) {
    constexpr int kTimeSeries = 1;
    if (const int type = sac.integer(kFileType); type != kTimeSeries) {
        sac.file.fail(fmt::format("SAC file type is {} (only time series, type 1, are read)", type), "convert it to a time series");
    }
    // true is any number but 0: some programs write -1, Fortran's true. An uneven file that leaves it undefined has times behind its
    // samples, twice as many bytes as read_count() takes
    if (sac.integer(kIsEven) == 0) sac.file.fail("LEVEN is 0 (only evenly spaced samples are read)", "resample the record");
}

scaling::Time read_dt(const SacFile& sac) {
    const float delta = sac.real(kDelta);
    if (!sac.has_real(kDelta) || !(delta > 0.0F)) {
        sac.file.fail(fmt::format("DELTA is {} s (time step must be positive)", delta), "correct the header");
    }
    return decimal_of(delta) * scaling::si::seconds;
}

std::size_t read_count(const SacFile& sac) {
    const int count = sac.integer(kCount);
    if (count <= 0) sac.file.fail(fmt::format("NPTS is {} (must be positive)", count), "correct the header");
    const std::size_t held = sac.file.bytes().size() - kSamples;
    const std::size_t announced = static_cast<std::size_t>(count) * kSampleBytes;
    if (held != announced) {
        sac.file.fail(fmt::format("{} bytes of samples for NPTS = {} ({}, {} bytes expected)", held, count,
                                  held < announced ? "file is truncated" : "more samples than announced", announced),
                      "fetch the record again or correct NPTS");
    }
    return static_cast<std::size_t>(count);
}

scaling::Time read_start(const SacFile& sac, scaling::Time dt, std::size_t count) {
    if (!sac.has_real(kBegin)) sac.file.fail("B is undefined (time of the first sample)", "correct the header");
    const double begin = decimal_of(sac.real(kBegin));
    if (sac.has_real(kEnd)) {
        const double end = begin + static_cast<double>(count - 1) * dt.value();
        // half a step, and the rounding of E and B to floats
        const double rounding = 1e-6 * (std::abs(end) + std::abs(begin));
        if (!(std::abs(end - static_cast<double>(sac.real(kEnd))) <= 0.5 * dt.value() + rounding)) {
            sac.file.fail(fmt::format("E is {} s (B, NPTS and DELTA make {} s)", sac.real(kEnd), end), "correct the header");
        }
    }
    return begin * scaling::si::seconds;
}

std::optional<UtcTime> read_time_zero(const SacFile& sac) {
    std::array<int, 6> fields{};
    for (std::size_t i = 0; i < fields.size(); ++i) fields[i] = sac.integer(kYear + 4 * i);
    const auto [year, day, hour, minute, second, millisecond] = fields;
    if (year == kUndefined) return std::nullopt;
    const auto midnight = make_utc_time(year, 1, 1, 0, 0, 0.0);
    const auto clock = make_utc_time(2000, 1, 1, hour, minute, second + 1e-3 * millisecond);
    const bool is_in_year = day >= 1 && day <= (std::chrono::year(year).is_leap() ? 366 : 365);
    if (!midnight || !clock || !is_in_year || millisecond < 0 || millisecond > 999) {
        sac.file.fail(
            fmt::format("reference time is year {}, day {}, {}:{}:{}, {} ms (no such time)", year, day, hour, minute, second, millisecond),
            "correct the header");
    }
    const UtcTime day_2000 = *make_utc_time(2000, 1, 1, 0, 0, 0.0);
    return *midnight + std::chrono::days(day - 1) + (*clock - day_2000);
}

// IDEP gives the quantity at best; its unit is nominally nm, nm/s or nm/s², which files in g, cm/s² or counts do not keep to
SampleUnit read_unit(const SacFile& sac, const ReadOptions& options) {
    constexpr int kDisplacement = 6;
    constexpr int kAcceleration = 8;
    constexpr std::array kQuantities{SampleQuantity::displacement, SampleQuantity::velocity, SampleQuantity::acceleration};
    const int idep = sac.integer(kDependent);
    std::optional<SampleQuantity> given;
    if (idep >= kDisplacement && idep <= kAcceleration) given = kQuantities.at(static_cast<std::size_t>(idep - kDisplacement));

    if (!options.unit) {
        sac.file.fail(fmt::format("unit of the samples is not given (SAC means {} with IDEP = {}, but files in g or counts say the same)",
                                  given ? fmt::format("n{}", si_unit_name(*given)) : "nothing", idep),
                      Remedy{"give ", Setting::unit, ", e.g. g, cm/s^2, nm/s^2"});
    }
    const SampleUnit unit = requested_unit(sac.file, options);
    if (given && *given != unit.quantity) {
        sac.file.fail(fmt::format("file holds {} (IDEP = {}; asked for: {})", to_string(*given), idep, unit.name),
                      Remedy{"correct ", Setting::unit});
    }
    return unit;
}

std::vector<double> read_samples(const SacFile& sac, std::size_t count, double si) {
    std::vector<double> samples;
    samples.reserve(count);
    float least = sac.real(kSamples);
    float greatest = least;
    for (std::size_t i = 0; i < count; ++i) {
        const float value = sac.real(kSamples + kSampleBytes * i);
        if (!std::isfinite(value)) {
            sac.file.fail(fmt::format("sample {} is {} (no finite number)", i + 1, value), "repair the value or fetch the file again");
        }
        least = std::min(least, value);
        greatest = std::max(greatest, value);
        samples.push_back(static_cast<double>(value) * si);
    }

    // both are floats of the file; a few roundings when another program wrote one of them
    const float slack = 1e-5F * std::max(std::abs(least), std::abs(greatest));
    if (sac.has_real(kDepMin) && !(std::abs(sac.real(kDepMin) - least) <= slack)) {
        sac.file.fail(fmt::format("least sample is {} (DEPMIN says {})", least, sac.real(kDepMin)), "fetch the record again");
    }
    if (sac.has_real(kDepMax) && !(std::abs(sac.real(kDepMax) - greatest) <= slack)) {
        sac.file.fail(fmt::format("greatest sample is {} (DEPMAX says {})", greatest, sac.real(kDepMax)), "fetch the record again");
    }
    return samples;
}

// horizontal components only: CMPINC is 90° from the vertical
std::optional<double> read_azimuth(const SacFile& sac) {
    constexpr float kHorizontal = 90.0F;
    if (!sac.has_real(kSacAzimuth) || sac.real(kInclination) != kHorizontal) return std::nullopt;
    return decimal_of(sac.real(kSacAzimuth));
}

std::string read_event(const SacFile& sac) {
    std::string event = sac.text(kEvent, 16);
    if (sac.has_real(kMagnitude)) event += fmt::format("{}M{:.1f}", event.empty() ? "" : ", ", sac.real(kMagnitude));
    return event;
}

}  // namespace

GroundMotion parse_sac(const BinaryFile& file, const ReadOptions& options) {
    if (file.bytes().size() <= kSamples) {
        file.fail(fmt::format("{} bytes (a SAC header has {}, then come the samples; file is truncated)", file.bytes().size(),
                              std::size_t{kSamples}),
                  "fetch the record again");
    }
    constexpr int kReadVersion = 6;
    const bool is_little = number_at<std::int32_t>(file.bytes(), kVersion, std::endian::little) == kReadVersion;
    const SacFile sac{file, is_little ? std::endian::little : std::endian::big};

    require_evenly_spaced_series(sac);
    const scaling::Time dt = read_dt(sac);
    const std::size_t count = read_count(sac);
    const scaling::Time start = read_start(sac, dt, count);
    const SampleUnit unit = read_unit(sac, options);
    refuse_contradictions(file, options, unit, dt);

    GroundMotion motion{.source = file.path().string(), .format = "SAC"};
    motion.event = read_event(sac);
    motion.station = sac.text(kStation);
    if (const std::string network = sac.text(kNetwork); !network.empty()) motion.station = network + '.' + motion.station;
    motion.time_zero = read_time_zero(sac);
    std::string channel = sac.text(kChannel);
    motion.components.push_back({.name = channel.empty() ? "1" : std::move(channel),
                                 .azimuth_deg = read_azimuth(sac),
                                 .series = {unit.quantity, start, dt, read_samples(sac, count, unit.si)}});
    // SAC cannot say that a record was corrected; files with the static 1 g left in are common
    motion.integration_corner = kUncorrectedCornerHz * scaling::si::hertz;
    motion.history.push_back(fmt::format("read SAC from {}, unit {}", file.path().filename().string(), unit.name));
    return motion;
}

}  // namespace musim::records::detail
