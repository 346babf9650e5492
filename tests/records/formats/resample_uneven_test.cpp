#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "records/formats/resample_uneven.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/temporary_folder.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;

constexpr SampleQuantity kAcceleration = SampleQuantity::acceleration;

TEST_CASE("a straight line through uneven times is the same line at even ones") {
    const std::vector<double> times{1.0, 1.005, 1.009, 1.014, 1.019, 1.025, 1.0301};
    std::vector<double> samples;
    for (const double time : times) samples.push_back(3.0 - 2.0 * time);

    const ResampledSeries resampled = resample_uneven(kAcceleration, times, samples);

    // steps of 4 to 6 ms, median 5: seven even samples up to 1.030 s
    CHECK(resampled.series.start().value() == 1.0);
    CHECK(resampled.series.dt().value() == 0.005);
    REQUIRE(resampled.series.size() == 7);
    for (std::size_t i = 0; i < 7; ++i) {
        CHECK(resampled.series.samples()[i] == relative(3.0 - 2.0 * resampled.series.time(i).value(), 1e-13));
    }
    CHECK(resampled.note == "resampled from 7 uneven samples (0.004 to 0.006 s) to 0.005 s by straight lines");
}

// the error of linear interpolation is at most h²/8 of the second derivative
TEST_CASE("the error of resampling falls with the square of the step") {
    const auto error_with = [](double step) {
        std::vector<double> times;
        std::vector<double> samples;
        for (int i = 0; static_cast<double>(i) * step < 1.0; ++i) {
            times.push_back(static_cast<double>(i) * step + (i % 3 == 1 ? 0.3 * step : 0.0));
            samples.push_back(std::sin(2.0 * std::numbers::pi * times.back()));
        }
        const ResampledSeries resampled = resample_uneven(kAcceleration, times, samples);
        double error = 0.0;
        for (std::size_t i = 0; i < resampled.series.size(); ++i) {
            const double exact = std::sin(2.0 * std::numbers::pi * resampled.series.time(i).value());
            error = std::max(error, std::abs(resampled.series.samples()[i] - exact));
        }
        return error;
    };

    const double coarse = error_with(0.01);
    const double fine = error_with(0.0025);

    CHECK(coarse < 1.3 * 1.3 * 0.01 * 0.01 / 8.0 * 4.0 * std::numbers::pi * std::numbers::pi);
    CHECK(coarse / fine == relative(16.0, 0.1));
}

TEST_CASE("samples at even times are kept to the last bit, without a note") {
    const std::vector<double> times{0.0, 0.01, 0.02, 0.0301, 0.04};
    const std::vector<double> samples{0.1, -0.2, 0.3, 0.7, 0.4};

    const ResampledSeries resampled = resample_uneven(kAcceleration, times, samples);

    CHECK(resampled.note.empty());
    CHECK(resampled.series.dt().value() == 0.01);
    CHECK(std::vector<double>(resampled.series.samples().begin(), resampled.series.samples().end()) == samples);
}

TEST_CASE("timed samples that make no series are refused with the reason") {
    const auto refusal = [](const std::vector<double>& times, const std::vector<double>& samples) {
        return tests::message_of<ReadError>([&] { resample_uneven(kAcceleration, times, samples); });
    };
    const double infinite = std::numeric_limits<double>::infinity();

    CHECK(refusal({0.0}, {1.0}).find("1 times for 1 samples") == 0);
    CHECK(refusal({0.0, 1.0, 2.0}, {1.0, 2.0}).find("3 times for 2 samples") == 0);
    CHECK(refusal({0.0, 0.01, 0.01}, {1.0, 2.0, 3.0}).find("time 3 is 0.01 s (not after the one before it)") == 0);
    CHECK(refusal({0.0, 0.01, 0.005}, {1.0, 2.0, 3.0}).find("time 3 is 0.005 s") == 0);
    CHECK(refusal({0.0, infinite}, {1.0, 2.0}).find("a time or sample is not finite") == 0);
    CHECK(refusal({0.0, 1e-9, 2e-9, 1e9}, {1.0, 2.0, 3.0, 4.0}).find("times are too uneven to resample (steps of 1e-09 to 1e+09 s)") == 0);
    // the span overflows
    CHECK(refusal({-1.7e308, 0.0, 1.7e308}, {1.0, 2.0, 3.0}).find("times are too uneven") == 0);
}

}  // namespace
}  // namespace musim::records
