#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "records/measures/sliding_block.hpp"
#include "records/processing/scale_record.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/support/relative.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;
using scaling::si::meters_per_second_squared;
using scaling::si::seconds;

TimeSeries make_ground_acceleration(std::vector<double> samples, double dt) {
    return {SampleQuantity::acceleration, 0.0 * seconds, dt * seconds, std::move(samples)};
}

TEST_CASE("a block slides under a triangular pulse as integrals say, whatever the sampling") {
    // a rises from 0 to A at T and falls to 0 at 2T; with the limit A/2 the block slides from T/2 on
    constexpr double kA = 8.0, kT = 1.0, kYield = 4.0;
    // relative acceleration A t/T for T/2, then A/2 − A t/T for T/2: the relative velocity grows to A T/4
    const double up = kA * kT * kT / 48.0, over = kA * kT * kT / 16.0 + kA * kT * kT / 16.0 - (kA * kT * kT / 48.0);
    const double velocity = kA * kT / 4.0;
    // then −A t/T for T/2, and −A/2 until it stops
    const double falling = 0.5 * kT, left = velocity - kA * falling * falling / (2.0 * kT);
    const double during = velocity * falling - kA * falling * falling * falling / (6.0 * kT);
    const double after = left * left / (2.0 * kYield);
    const double expected = up + over + during + after;
    for (const int per_side : {1, 2, 5, 64}) {
        CAPTURE(per_side);
        std::vector<double> pulse;
        for (int i = 0; i <= 2 * per_side; ++i) pulse.push_back(kA * (1.0 - std::abs(i - per_side) / static_cast<double>(per_side)));
        pulse.resize(pulse.size() + static_cast<std::size_t>(4 * per_side), 0.0);
        const Sliding sliding = compute_sliding(make_ground_acceleration(pulse, kT / per_side), kYield * meters_per_second_squared);
        CHECK(sliding.residual.value() == relative(expected, 1e-12));
        CHECK(sliding.largest == sliding.residual);
    }
}

TEST_CASE("nothing slides below the limit, and a motion and its opposite undo each other") {
    const std::vector<double> shake{0.0, 3.0, -3.0, 2.0, 0.0};
    CHECK(compute_sliding(make_ground_acceleration(shake, 0.1), 3.0 * meters_per_second_squared).largest.value() == 0.0);
    std::vector<double> opposite = shake;
    for (double& a : opposite) a = -a;
    const Sliding one = compute_sliding(make_ground_acceleration(shake, 0.1), 1.0 * meters_per_second_squared);
    const Sliding other = compute_sliding(make_ground_acceleration(opposite, 0.1), 1.0 * meters_per_second_squared);
    CHECK(one.largest.value() > 0.0);
    CHECK(one.largest == other.largest);
    CHECK(one.residual == -other.residual);
    CHECK_THROWS_AS(compute_sliding(make_ground_acceleration(shake, 0.1), 0.0 * meters_per_second_squared), ProcessingError);
}

TEST_CASE("sliding is that of ten thousand small steps under any motion") {
    std::vector<double> motion;
    for (int i = 0; i < 200; ++i) motion.push_back(5.0 * std::sin(0.37 * i) + 3.0 * std::cos(0.11 * i * i));
    constexpr double kDt = 0.02, kYield = 1.7;
    constexpr int kParts = 20000;
    double u = 0.0, x = 0.0, largest = 0.0;
    for (std::size_t i = 1; i < motion.size(); ++i) {
        for (int k = 0; k < kParts; ++k) {
            const double a = motion[i - 1] + (motion[i] - motion[i - 1]) * (k + 0.5) / kParts, h = kDt / kParts;
            if (u == 0.0 && std::abs(a) <= kYield) continue;
            const double way = u != 0.0 ? u : a;
            const double next = u + h * (a - std::copysign(kYield, way));
            const double kept = u != 0.0 && next * u <= 0.0 ? 0.0 : next;
            x += 0.5 * h * (u + kept);
            u = kept;
            largest = std::max(largest, std::abs(x));
        }
    }
    const Sliding sliding = compute_sliding(make_ground_acceleration(motion, kDt), kYield * meters_per_second_squared);
    // the small steps are off by at most one of them at each of some hundred stops
    CHECK(sliding.largest.value() == relative(largest, 1e-3));
    CHECK(sliding.residual.value() == relative(x, 1e-3 * largest / std::abs(x)));
}

TEST_CASE("sliding scales with the law that holds its groups, to the last bit for powers of two") {
    std::vector<double> motion;
    for (int i = 0; i < 300; ++i) motion.push_back(6.0 * std::sin(0.21 * i));
    const TimeSeries prototype = make_ground_acceleration(motion, 0.01);
    const scaling::Similitude law = scaling::make_similitude("froude", {.length = 1.0 / 16.0});
    const Sliding one = compute_sliding(prototype, 2.0 * meters_per_second_squared);
    const Sliding model = compute_sliding(rescale(prototype, law), 2.0 * meters_per_second_squared);
    CHECK(model.largest.value() == one.largest.value() / 16.0);
    CHECK(model.residual.value() == one.residual.value() / 16.0);
}

}  // namespace
}  // namespace musim::records
