#include <fmt/format.h>

#include <algorithm>

#include "records/detail/text.hpp"
#include "records/formats/detail/parsers.hpp"
#include "records/formats/detail/timed_samples.hpp"
#include "records/headers/fixed_columns.hpp"
#include "records/headers/header_checks.hpp"

namespace musim::records::detail {
namespace {

/// Lines of a channel's header, counted from its first.
enum HeaderLine : std::size_t { kOriginLine = 2, kNameLine = 4, kStationLine = 7, kCountsLine = 10, kUnitLine = 11, kRateLine = 21 };

/// Ten values of 13 letters a line, 0.1E-01.
constexpr FixedColumns kBhrcColumns{.per_line = 10, .width = 13};

// "...  Azimuth L 50    T 140": the number behind the channel's letter
std::optional<double> find_azimuth(std::string_view line, std::string_view name) {
    const std::size_t found = find_ignoring_case(line, "AZIMUTH");
    std::string_view rest = found == std::string_view::npos ? std::string_view{} : line.substr(found);
    take_token(rest);
    for (std::string_view letter = take_token(rest); !letter.empty(); letter = take_token(rest)) {
        const std::optional<double> degrees = parse_real(take_token(rest));
        if (letter == name && degrees && *degrees >= 0.0 && *degrees <= 360.0) return degrees;
    }
    return std::nullopt;
}

// one channel from line `index`; leaves `index` behind its end mark
Component read_channel(const TextFile& file, const ReadOptions& options, std::size_t& index) {
    const std::size_t start = index;
    if (!contains_ignoring_case(file.line(start), "* VOL1DS FILE")) {
        file.fail(start, "channel header is missing (no '* VOL1DS FILE')", "fetch the record again");
    }
    if (!contains_ignoring_case(file.line(start + kUnitLine), "SECONDS AND G/10")) {
        file.fail(std::min(start + kUnitLine, file.size() - 1), "unit is missing (no 'UNITS ARE SECONDS AND G/10')",
                  "fetch the record again");
    }
    const std::string_view counts = file.line(start + kCountsLine);
    const std::size_t count = checked_count(file, start + kCountsLine, value_of(counts, "NO. OF POINTS"));
    std::string_view rate_line = file.line(start + kRateLine);
    const double rate = parse_real(take_token(rate_line)).value_or(0.0);
    const scaling::Time dt = checked_dt(file, std::min(start + kRateLine, file.size() - 1), 1.0 / rate);
    check_record_length(file, start + kCountsLine, count, dt, parse_real(value_of(counts, "DURATION")).value_or(0.0), start + kCountsLine);
    refuse_contradictions(file, options, kTenthOfG, dt);

    std::vector<double> samples = read_block(file, {start + kVolume1HeaderLines, count, kBhrcColumns}, kTenthOfG.si);
    index = start + kVolume1HeaderLines + lines_of(count, kBhrcColumns);
    if (!file.line(index).starts_with("/&")) {
        file.fail(std::min(index, file.size() - 1), "end mark '/&' of the channel is missing (truncated, or more samples than announced)",
                  "fetch the record again");
    }
    ++index;
    const std::string name(trim(file.line(start + kNameLine)));
    return {name,
            find_azimuth(file.line(start + kStationLine), name),
            {SampleQuantity::acceleration, 0.0 * scaling::si::seconds, dt, std::move(samples)}};
}

}  // namespace

GroundMotion parse_bhrc(const TextFile& file, const ReadOptions& options) {
    GroundMotion motion{.source = file.path().string(), .format = "BHRC"};
    motion.event = trim(file.line(kOriginLine));
    motion.station = first_field(file.line(kStationLine));
    motion.integration_corner = kUncorrectedCornerHz * scaling::si::hertz;
    motion.history.push_back(fmt::format("read BHRC from {}", file.path().filename().string()));
    for (std::size_t index = 0; index < file.size();) {
        if (file.line(index).empty()) {
            ++index;
        } else {
            motion.components.push_back(read_channel(file, options, index));
        }
    }
    if (motion.components.empty()) file.fail("file has no channel (no header)", "fetch the record again");
    return motion;
}

}  // namespace musim::records::detail
