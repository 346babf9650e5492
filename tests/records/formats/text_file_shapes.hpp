#pragma once

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "records/formats/read_record.hpp"
#include "scaling/units.hpp"
#include "tests/support/temporary_folder.hpp"

/// One pulse, written as loggers and programs write their text files.
namespace musim::tests {

inline const double kPulseGravity = scaling::kStandardGravity.value();  // m/s^2
inline constexpr double kPulseStep = 0.005;                             // s
inline constexpr std::size_t kPulseSamples = 400;
inline constexpr double kPulsePeak = 3.0;             // m/s^2
inline constexpr std::size_t kPulsePeakSample = 100;  // a quarter of the period of 2 s after the start

/// Sample i [m/s²] of 3 m/s² · sin(π t), which passes its peak at a sample.
inline double pulse(std::size_t i) { return kPulsePeak * std::sin(std::numbers::pi * static_cast<double>(i) * kPulseStep); }
inline double pulse_time(std::size_t i) { return static_cast<double>(i) * kPulseStep; }

/// A file of a header and one line for each of `count` indices 0, `step`, ...
inline std::string lines(const std::string& header, const std::function<std::string(std::size_t)>& line, std::size_t step = 1) {
    std::string text = header;
    for (std::size_t i = 0; i < kPulseSamples; i += step) text += line(i) + '\n';
    return text;
}

/// The same number with a decimal comma.
inline std::string with_comma(double value) {
    std::string text = fmt::format("{:.6f}", value);
    return text.replace(text.find('.'), 1, ",");
}

/// A table of times and samples, each `factors` times the pulse.
inline std::string table(const std::string& header, const std::vector<double>& factors, char separator = ',') {
    return lines(header, [&](std::size_t i) {
        std::string line = fmt::format("{:.3f}", pulse_time(i));
        for (const double factor : factors) line += fmt::format("{}{:.9g}", separator, factor * pulse(i));
        return line;
    });
}

inline records::GroundMotion read_shape(const std::string& content, const records::ReadOptions& options = {}) {
    const TemporaryFolder folder;
    return records::read_record(folder.write("a", content), options);
}

/// Checks peaks of the components [SI] and the clock of the pulse, as far as six printed digits hold them.
inline void check_shape(const records::GroundMotion& motion, const std::vector<double>& peaks) {
    REQUIRE(motion.components.size() == peaks.size());
    for (std::size_t i = 0; i < peaks.size(); ++i) {
        const records::TimeSeries& series = motion.components[i].series;
        CHECK(series.size() == kPulseSamples);
        CHECK(series.dt().value() == doctest::Approx(kPulseStep).epsilon(1e-9));
        CHECK(records::find_largest(series.samples()) == doctest::Approx(peaks[i]).epsilon(1e-5));
    }
}

}  // namespace musim::tests
