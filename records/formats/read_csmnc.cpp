#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "records/detail/text.hpp"
#include "records/formats/detail/parsers.hpp"
#include "records/formats/detail/table.hpp"
#include "records/headers/direction.hpp"
#include "records/headers/header_checks.hpp"

namespace musim::records::detail {
namespace {

constexpr std::size_t kLongestCsmncHeader = 30;  // lines; met: 16

constexpr std::string_view kCsmncCount = "NO. OF POINTS:";
constexpr std::string_view kCsmncStep = "EQUALLY SPACED INTERVALS OF:";
constexpr std::string_view kCsmncPeak = "PEAK VALUE:";
constexpr std::string_view kCsmncDuration = "DURATION:";
constexpr std::string_view kCsmncUnit = "UNIT:";

/// A label of the header with the words behind it; labels share lines in some files.
struct Labelled {
    std::size_t line = 0;
    std::string_view text = {};

    std::string_view word() const {
        std::string_view rest = text;
        return take_token(rest);
    }
};

std::optional<Labelled> find_labelled(const TextFile& file, std::string_view label) {
    for (std::size_t index = 0; index < std::min(file.size(), kLongestCsmncHeader); ++index) {
        const std::size_t at = find_ignoring_case(file.line(index), label);
        if (at != std::string_view::npos) return Labelled{index, trim(file.line(index).substr(at + label.size()))};
    }
    return std::nullopt;
}

Labelled require_labelled(const TextFile& file, std::string_view label) {
    if (const std::optional<Labelled> found = find_labelled(file, label)) return *found;
    file.fail(fmt::format("header has no '{}'", label), "fetch the record again");
}

// "UNCORRECTED ACCELERATION          UNIT: CM/SEC/SEC"
SampleUnit read_csmnc_unit(const TextFile& file) {
    const Labelled field = require_labelled(file, kCsmncUnit);
    const std::optional<SampleUnit> unit = find_sample_unit(field.word());
    if (!unit) {
        file.fail(field.line, fmt::format("unit {} is unknown (known: {})", quoted(field.word()), sample_unit_names()),
                  "correct the unit line");
    }
    for (const SampleQuantity quantity : {SampleQuantity::velocity, SampleQuantity::displacement}) {
        if (quantity != unit->quantity && contains_ignoring_case(file.line(field.line), to_string(quantity))) {
            file.fail(field.line,
                      fmt::format("line names {} (its unit {} is of {})", to_string(quantity), unit->name, to_string(unit->quantity)),
                      "correct the unit line");
        }
    }
    return *unit;
}

// behind the labels stand the network's name, an empty line and the samples
std::size_t find_csmnc_samples(const TextFile& file) {
    std::size_t last_label = 0;
    for (const std::string_view label : {kCsmncCount, kCsmncPeak, std::string_view("PRE-EVENT TIME"), std::string_view("SITE CONDITION")})
        if (const std::optional<Labelled> field = find_labelled(file, label)) last_label = std::max(last_label, field->line);
    for (std::size_t index = last_label + 1; index < file.size(); ++index) {
        std::string_view rest = file.line(index);
        if (parse_real(take_token(rest))) return index;
    }
    file.fail(file.size() - 1, "no samples follow the header (file is truncated)", "fetch the record again");
}

// stated of the samples, or of them less their mean, which uncorrected ones still hold
void check_csmnc_peak(const TextFile& file, std::size_t begin, const std::vector<double>& samples, const SampleUnit& unit) {
    const std::optional<Labelled> field = find_labelled(file, kCsmncPeak);
    if (!field) return;
    std::string_view printed = field->word();
    if (printed.starts_with('-') || printed.starts_with('+')) printed.remove_prefix(1);
    const double rounding = half_last_digit(text_of_value(file, begin, find_peak(samples)));
    const double raw = std::abs(signed_peak(samples)) / unit.si;
    const double about_mean = std::abs(signed_peak(samples, find_mean(samples))) / unit.si;
    const double stated = parse_real(printed).value_or(raw);
    const bool is_about_mean = std::abs(about_mean - stated) < std::abs(raw - stated);
    check_stated_peak(file, field->line, kCsmncPeak, printed, {is_about_mean ? about_mean : raw, rounding});
}

// "COMP. EW" → "EW", 90°
Component read_csmnc_component(const TextFile& file, TimeSeries series) {
    const Labelled field = require_labelled(file, "COMP.");
    Direction direction = read_direction(field.word());
    if (direction.name.empty()) file.fail(field.line, "component is not named", "fetch the record again");
    return {.name = std::move(direction.name), .azimuth_deg = direction.azimuth_deg, .series = std::move(series)};
}

}  // namespace

bool looks_like_csmnc(const TextFile& file) {
    return find_labelled(file, kCsmncStep) && find_labelled(file, kCsmncUnit) && find_labelled(file, "COMP.") &&
           find_labelled(file, "STATION:");
}

GroundMotion parse_csmnc(const TextFile& file, const ReadOptions& options) {
    const SampleUnit unit = read_csmnc_unit(file);
    const Labelled count_field = require_labelled(file, kCsmncCount);
    const std::size_t count = checked_count(file, count_field.line, count_field.word());
    const Labelled step_field = require_labelled(file, kCsmncStep);
    const std::optional<double> step = parse_real(step_field.word());
    if (!step) file.fail(step_field.line, fmt::format("time step {} is no number", quoted(step_field.word())), "correct the header");
    const scaling::Time dt = checked_dt(file, step_field.line, *step);
    refuse_contradictions(file, options, unit, dt);

    const std::size_t begin = find_csmnc_samples(file);
    std::vector<double> samples = read_values(file, begin, file.size(), {count, "NO. OF POINTS"}, unit.si);
    check_csmnc_peak(file, begin, samples, unit);
    if (const std::optional<Labelled> field = find_labelled(file, kCsmncDuration))
        check_record_length(file, count_field.line, count, dt, parse_real(field->word()).value_or(0.0), field->line);

    GroundMotion motion{.source = file.path().string(), .format = "CSMNC"};
    constexpr std::size_t kCsmncEventLine = 1;
    motion.event = fmt::format("{}, {}", trim(file.line(kCsmncEventLine)), trim(file.line(kCsmncEventLine + 1)));
    motion.station = require_labelled(file, "STATION:").text;
    motion.components.push_back(read_csmnc_component(file, {unit.quantity, 0.0 * scaling::si::seconds, dt, std::move(samples)}));
    const bool is_uncorrected = contains_ignoring_case(file.line(require_labelled(file, kCsmncUnit).line), "UNCORRECTED");
    if (is_uncorrected) motion.integration_corner = kUncorrectedCornerHz * scaling::si::hertz;
    motion.history.push_back(fmt::format("read {} from {}, unit {}", motion.format, file.path().filename().string(), unit.name));
    return motion;
}

}  // namespace musim::records::detail
