#include <fmt/format.h>

#include <cmath>

#include "records/detail/text.hpp"
#include "records/formats/detail/parsers.hpp"
#include "records/formats/detail/table.hpp"
#include "records/headers/header_checks.hpp"
#include "records/headers/header_fields.hpp"

namespace musim::records::detail {
namespace {

constexpr std::size_t kKnetHeaderLines = 17;

/// Japan's standard time [h ahead of UTC].
constexpr double kJapanHoursAhead = 9.0;

/// The recorders' delay line: the samples begin this long before the header's "Record Time".
constexpr std::chrono::seconds kRecorderDelay{15};

struct SensorAxis {
    std::string_view name;     ///< as the file writes it
    std::string_view meaning;  ///< positive north, east or up
    std::optional<double> azimuth_deg;
};

constexpr SensorAxis kAxes[] = {
    {"N-S", "north", 0.0},         {"E-W", "east", 90.0},         {"U-D", "up", std::nullopt},
    {"1", "borehole, north", 0.0}, {"2", "borehole, east", 90.0}, {"3", "borehole, up", std::nullopt},
    {"4", "surface, north", 0.0},  {"5", "surface, east", 90.0},  {"6", "surface, up", std::nullopt},
};

const SensorAxis& read_axis(const TextFile& file, const HeaderFields& header) {
    const HeaderField field = header.require("Dir.");
    for (const SensorAxis& direction : kAxes) {
        if (equal_ignoring_case(direction.name, field.text)) return direction;
    }
    file.fail(field.line, fmt::format("Dir. is {} (known: N-S, E-W, U-D, 1 to 6)", quoted(field.text)), "correct the header");
}

// "100Hz" → 0.01 s
scaling::Time read_time_step(const TextFile& file, const HeaderFields& header) {
    const HeaderField field = header.require("Sampling Freq(Hz)");
    const std::optional<double> rate = parse_real(trim(field.text.substr(0, find_ignoring_case(field.text, "Hz"))));
    if (!rate || !(*rate > 0.0)) {
        file.fail(field.line, fmt::format("Sampling Freq(Hz) is {} (must be positive)", quoted(field.text)), "correct the header");
    }
    return checked_dt(file, field.line, 1.0 / *rate);
}

// "3920(gal)/6182761" → value of one count [gal]
double read_scale_factor(const TextFile& file, const HeaderFields& header) {
    const HeaderField field = header.require("Scale Factor");
    constexpr std::string_view kUnit = "(gal)/";
    const std::size_t unit = find_ignoring_case(field.text, kUnit);
    if (unit != std::string_view::npos) {
        const std::optional<double> gal = parse_real(trim(field.text.substr(0, unit)));
        const std::optional<double> counts = parse_real(trim(field.text.substr(unit + kUnit.size())));
        if (gal && counts && *gal > 0.0 && *counts > 0.0 && std::isfinite(*gal / *counts)) return *gal / *counts;
    }
    file.fail(field.line, fmt::format("Scale Factor is {} (must be 'a(gal)/b', both positive)", quoted(field.text)), "correct the header");
}

// the header counts whole seconds, not samples
AnnouncedCount announced_count(const TextFile& file, const HeaderFields& header, scaling::Time dt) {
    const double duration = header.require_positive("Duration Time(s)");
    const double count = std::round(duration / dt.value());
    constexpr double kMost = 1e9;  // samples; more no text file holds
    if (!(count >= 1.0 && count <= kMost)) {
        file.fail(header.require("Duration Time(s)").line, fmt::format("{} s of {} s steps are no usable length", duration, dt.value()),
                  "correct the header");
    }
    return {static_cast<std::size_t>(count), "Duration Time x Sampling Freq"};
}

}  // namespace

GroundMotion parse_knet(const TextFile& file, const ReadOptions& options) {
    const HeaderFields header(file, kKnetHeaderLines);
    const SensorAxis& direction = read_axis(file, header);
    const scaling::Time dt = read_time_step(file, header);
    const SampleUnit gal = *find_sample_unit("gal");
    refuse_contradictions(file, options, gal, dt);

    // the header's peak is that about the mean of the record
    const double gal_per_count = read_scale_factor(file, header);
    std::vector<double> samples =
        read_values(file, kKnetHeaderLines, file.size(), announced_count(file, header, dt), gal_per_count * gal.si);
    const HeaderField peak = header.require("Max. Acc. (gal)");
    check_stated_peak(file, peak.line, "Max. Acc. (gal)", peak.text,
                      {std::abs(signed_peak(samples, find_mean(samples))) / gal.si, 0.5 * gal_per_count});

    GroundMotion motion{.source = file.path().string(), .format = "K-NET/KiK-net"};
    motion.event = fmt::format("{} JST, magnitude {}", header.text("Origin Time"), header.text("Mag."));
    motion.station = header.require("Station Code").text;
    motion.components.push_back({.name = std::string(direction.name),
                                 .azimuth_deg = direction.azimuth_deg,
                                 .series = {gal.quantity, 0.0 * scaling::si::seconds, dt, std::move(samples)},
                                 .up = !direction.azimuth_deg});
    if (const std::optional<UtcTime> time = header.find_time("Record Time", kJapanHoursAhead)) motion.time_zero = *time - kRecorderDelay;
    motion.integration_corner = kUncorrectedCornerHz * scaling::si::hertz;
    motion.history.push_back(fmt::format("read {} from {}, {} ({}), {} gal a count, clock 15 s before Record Time", motion.format,
                                         file.path().filename().string(), direction.name, direction.meaning, gal_per_count));
    return motion;
}

}  // namespace musim::records::detail
