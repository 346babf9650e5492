#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "records/formats/read_record.hpp"
#include "records/processing/processing.hpp"
#include "tests/records/reference_table.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/shared_records.hpp"

/// Velocity and displacement against the files that PEER and eqsig made of the same acceleration.
namespace musim::records {
namespace {

using lsdem::tests::relative;

TimeSeries load(const std::string& file) { return read_record(tests::shared_records() / file).components.at(0).series; }

double peak_of(std::span<const double> samples) {
    double peak = 0.0;
    for (const double sample : samples) peak = std::max(peak, std::abs(sample));
    return peak;
}

/// theirs − factor·ours
TimeSeries difference(const TimeSeries& theirs, const TimeSeries& ours, double factor) {
    REQUIRE(theirs.size() == ours.size());
    std::vector<double> samples;
    for (std::size_t i = 0; i < theirs.size(); ++i) samples.push_back(theirs.samples()[i] - factor * ours.samples()[i]);
    return theirs.with_samples(std::move(samples));
}

// what rounding to seven digits leaves of a trapezoid integral: each sample is wrong by up to 5e-7 of itself, 2.9e-7 in the mean square,
// and the errors add up as a random walk, of which four standard deviations; the integral itself is printed with seven digits too
double rounding_of_integral(const TimeSeries& integrand, const TimeSeries& integral) {
    double squares = 0.0;
    for (const double sample : integrand.samples()) squares += sample * sample;
    return 4.0 * 2.9e-7 * std::sqrt(squares) * integrand.dt().value() + 5e-7 * peak_of(integral.samples());
}

TEST_CASE("PEER's velocity and displacement files are the trapezoid integrals of its acceleration, with its own g") {
    if (!tests::have_shared_records()) return;
    // AT2 is in g and VT2 in cm/s: with 9.80665 all three are off by 1.68e-4 of themselves, with 9.805 by rounding
    constexpr double kPeerGravity = 9.805 / 9.80665;
    for (const std::string_view name : {"RSN1633_MANJIL_ABBAR--L", "RSN164_IMPVALL.H_H-CPE147", "RSN88_SFERN_FSD172"}) {
        CAPTURE(name);
        const std::string stem = "peer/" + std::string(name);
        const TimeSeries acceleration = load(stem + ".AT2"), velocity = load(stem + ".VT2"), displacement = load(stem + ".DT2");
        CHECK(peak_of(difference(velocity, integrate(acceleration), kPeerGravity).samples()) <=
              rounding_of_integral(acceleration, velocity));
        CHECK(peak_of(difference(displacement, integrate(velocity), 1.0).samples()) <= rounding_of_integral(velocity, displacement));
        // both steps: what rounding leaves of the velocity drifts, 3e-6 to 6e-5 of the peak
        const TimeSeries twice = integrate(integrate(acceleration));
        CHECK(peak_of(difference(displacement, twice, kPeerGravity).samples()) <= 1e-4 * peak_of(displacement.samples()));
    }
}

TEST_CASE("PEER's older displacement files start and drift as an unseen start of the record did") {
    if (!tests::have_shared_records()) return;
    struct Case {
        std::string_view name;
        double first;     ///< the file's first displacement [m]
        double drift;     ///< largest difference from the integral from rest [share of the peak], two digits
        double residual;  ///< what is left of it beyond a cubic [share of the peak]
    };
    // 9.81 m/s² for g fits; the file has displacement and velocity at its first sample, from the padded record that was filtered, and the
    // acceleration between was tapered: in the displacement a curve as slow as a cubic, which goes, and what a cubic is too stiff for,
    // which stays
    for (const Case& row : {Case{"IELC180", 3.2996e-3, 0.025, 5e-4}, Case{"H-E12140", 5.5785e-4, 0.0077, 1e-4}}) {
        CAPTURE(row.name);
        const std::string stem = "peer/" + std::string(row.name);
        const TimeSeries theirs = load(stem + ".DT2");
        const double peak = peak_of(theirs.samples());
        const TimeSeries left = difference(theirs, integrate(integrate(load(stem + ".AT2"))), 9.81 / 9.80665);
        CHECK(theirs.samples().front() == relative(row.first, 1e-4));
        CHECK(peak_of(left.samples()) / peak == relative(row.drift, 0.02));
        CHECK(peak_of(remove_baseline(left, 3).samples()) <= row.residual * peak);
    }
}

TEST_CASE("eqsig's velocity and displacement are ours but for one factor") {
    if (!tests::have_shared_records()) return;
    const auto rows = tests::read_reference("reference/test_motion_avd.csv");
    const TimeSeries acceleration = load("text/test_motion_dt0p01.txt"), velocity = integrate(acceleration),
                     displacement = integrate(velocity);
    REQUIRE(rows.size() == acceleration.size());
    // its accelerations are ours in 9.81 m/s²; its integrals are those of 9.80846 m/s², for a cause that the file does not state
    constexpr double kFactor = 0.9998434;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        CAPTURE(i);
        CHECK(std::abs(rows[i][1] * 9.81 - acceleration.samples()[i]) <= tests::half_unit(rows[i][1], 6) * 9.81 + 1e-8);
        CHECK(std::abs(rows[i][2] - kFactor * velocity.samples()[i]) <= 1e-7 * 0.26);
        CHECK(std::abs(rows[i][3] - kFactor * displacement.samples()[i]) <= 1e-7 * 0.073);
    }
}

}  // namespace
}  // namespace musim::records
