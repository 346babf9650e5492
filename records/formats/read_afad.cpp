#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "records/detail/text.hpp"
#include "records/formats/detail/parsers.hpp"
#include "records/formats/detail/table.hpp"
#include "records/headers/direction.hpp"
#include "records/headers/header_checks.hpp"
#include "records/headers/header_fields.hpp"

namespace musim::records::detail {
namespace {

constexpr std::string_view kPeaks = "RAW PGA VALUES (gal)";

// ISO-8859-9 is Latin-1 with six Turkish letters
std::string utf8_from_turkish(std::string_view text) {
    struct Letter {
        unsigned char byte;
        std::string_view utf8;
    };
    constexpr std::array<Letter, 6> kTurkish{{{0xD0, "\u011E"},
                                              {0xDD, "\u0130"},
                                              {0xDE, "\u015E"},  //
                                              {0xF0, "\u011F"},
                                              {0xFD, "\u0131"},
                                              {0xFE, "\u015F"}}};
    std::string utf8;
    for (const char letter : text) {
        const auto byte = static_cast<unsigned char>(letter);
        const auto* const turkish = std::find_if(kTurkish.begin(), kTurkish.end(), [&](const Letter& known) { return known.byte == byte; });
        if (turkish != kTurkish.end()) {
            utf8 += turkish->utf8;
        } else if (byte < 0x80U) {
            utf8 += letter;
        } else {
            utf8 += static_cast<char>(0xC0U | (byte >> 6U));
            utf8 += static_cast<char>(0x80U | (byte & 0x3FU));
        }
    }
    return utf8;
}

// the three names above the samples, "N-S          E-W          U-D", on line `index`
std::array<std::string_view, 3> find_titles(const TextFile& file, std::size_t& index) {
    constexpr std::size_t kLongestHeader = 40;  // lines; those met have 17
    for (index = 0; index < kLongestHeader; ++index) {
        std::string_view rest = file.line(index);
        std::array<std::string_view, 3> titles;
        for (std::string_view& title : titles) title = take_token(rest);
        if (is_axis(titles[0]) && is_axis(titles[1]) && is_axis(titles[2]) && trim(rest).empty()) return titles;
    }
    file.fail("no line names the columns (N-S, E-W, U-D)", "fetch the record again");
}

// "(N-S) 37.847707 (E-W) 39.771316 (U-D) 32.130932"
void check_peak(const TextFile& file, const HeaderField& peaks, std::string_view component, const MeasuredPeak& measured) {
    const std::string name = fmt::format("({})", component);
    const std::size_t found = peaks.text.find(name);
    std::string_view rest = peaks.text.substr(found == std::string_view::npos ? peaks.text.size() : found + name.size());
    check_stated_peak(file, peaks.line, fmt::format("raw PGA {}", name), take_token(rest), measured);
}

}  // namespace

GroundMotion parse_afad(const TextFile& file, const ReadOptions& options) {
    std::size_t titles_line = 0;
    const std::array<std::string_view, 3> titles = find_titles(file, titles_line);
    const HeaderFields header(file, titles_line);
    const HeaderField peaks = header.require(kPeaks);
    const SampleUnit gal = *find_sample_unit("gal");
    constexpr std::string_view kInterval = "SAMPLING INTERVAL (sec)";
    const scaling::Time dt = checked_dt(file, header.require(kInterval).line, header.require_positive(kInterval));
    refuse_contradictions(file, options, gal, dt);

    NumberTable table = read_table(file, titles_line + 1, std::array{gal.si, gal.si, gal.si});
    check_rows(file, table, {header.require_count("NUMBER OF DATA"), "NUMBER OF DATA"});

    GroundMotion motion{.source = file.path().string(), .format = "AFAD"};
    for (std::size_t i = 0; i < titles.size(); ++i) {
        std::vector<double>& samples = table.columns[i];
        const std::string_view largest = text_in_table(file, table, find_peak(samples), i);
        check_peak(file, peaks, titles.at(i), {std::abs(signed_peak(samples)) / gal.si, half_last_digit(largest)});
        motion.components.push_back({.name = std::string(titles.at(i)),
                                     .azimuth_deg = azimuth_of_axis(titles.at(i)),
                                     .series = {gal.quantity, 0.0 * scaling::si::seconds, dt, std::move(samples)}});
    }
    motion.event = fmt::format("{}, magnitude {}", header.text("EARTHQUAKE DATE"), header.text("EARTHQUAKE MAGNITUDE"));
    motion.station = fmt::format("{}, {}", header.require("STATION ID").text, utf8_from_turkish(header.text("PLACE")));
    // a clock of another zone would be named there
    if (header.text("RECORD TIME").find("(GMT)") != std::string_view::npos) motion.time_zero = header.find_time("RECORD TIME");
    motion.integration_corner = kUncorrectedCornerHz * scaling::si::hertz;
    motion.history.push_back(fmt::format("read {} from {}, unit {}", motion.format, file.path().filename().string(), gal.name));
    return motion;
}

}  // namespace musim::records::detail
