#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "records/measures/intensity.hpp"
#include "records/processing/processing.hpp"

namespace musim::records {
namespace {

using scaling::si::seconds;

// a pulse above an offset, at rest before
TimeSeries make_record(double amplitude = 1.0, double dt = 0.01) {
    std::vector<double> samples;
    for (int i = 0; i <= 2000; ++i) {
        const double phase = 0.01 * (i - 200);
        samples.push_back(amplitude * (0.5 + (i < 200 ? 0.0 : 3.0 * std::sin(5.0 * phase) * std::exp(-0.5 * phase))));
    }
    return {SampleQuantity::acceleration, 0.0 * seconds, dt * seconds, std::move(samples)};
}

void check_equal(const TimeSeries& scaled, const TimeSeries& series, double factor) {
    REQUIRE(scaled.size() == series.size());
    std::size_t different = 0;
    for (std::size_t i = 0; i < series.size(); ++i) different += scaled.samples()[i] != factor * series.samples()[i];
    CHECK(different == 0);
}

}  // namespace

TEST_CASE("histories have the peaks that the intensity measures have") {
    for (const auto& corner : {std::optional<scaling::Frequency>(), std::optional(0.1 / seconds)}) {
        const MotionHistories histories = compute_histories(make_record(), corner);
        const Intensity intensity = compute_intensity(make_record(), corner);
        REQUIRE((histories.acceleration && histories.velocity));
        CHECK(find_peak_acceleration(*histories.acceleration).value == intensity.pga->value);
        CHECK(find_peak_velocity(*histories.velocity).time == intensity.pgv->time);
        CHECK(find_peak_displacement(histories.displacement).value == intensity.pgd->value);
        // the offset is in the samples of a corrected record only
        CHECK(histories.acceleration->samples()[0] == (corner ? 0.0 : 0.5));
    }
}

TEST_CASE("the displacement of an uncorrected record does not drift") {
    const MotionHistories histories = compute_histories(make_record(), 0.1 / seconds);
    // without the mean the samples of the velocity add up to nothing; trapezoids leave half of the first and the last
    double fastest = 0.0;
    for (const double v : histories.velocity->samples()) fastest = std::max(fastest, std::abs(v));
    CHECK(std::abs(histories.displacement.samples().back()) <= 2.0 * fastest * histories.velocity->dt().value());
    // the velocity alone, from zero, would
    CHECK(std::abs(integrate(*histories.velocity).samples().back()) > 2.0 * fastest * histories.velocity->dt().value());
}

TEST_CASE("a history has no derivative") {
    const TimeSeries velocity(SampleQuantity::velocity, 0.0 * seconds, 0.5 * seconds, {1.0, 3.0});
    const MotionHistories of_velocity = compute_histories(velocity);
    CHECK_FALSE(of_velocity.acceleration);
    CHECK(*of_velocity.velocity == velocity);
    CHECK(of_velocity.displacement.samples()[1] == 1.0);
    const TimeSeries displacement(SampleQuantity::displacement, 0.0 * seconds, 0.5 * seconds, {1.0, 3.0});
    const MotionHistories of_displacement = compute_histories(displacement);
    CHECK_FALSE(of_displacement.velocity);
    CHECK(of_displacement.displacement == displacement);
}

TEST_CASE("histories of a record scaled by powers of two are the scaled histories") {
    // time 1/4, acceleration 2: velocity 1/2, displacement 1/8; the corner is a frequency
    const MotionHistories prototype = compute_histories(make_record(), 0.25 / seconds),
                          model = compute_histories(make_record(2.0, 0.0025), 1.0 / seconds);
    check_equal(*model.acceleration, *prototype.acceleration, 2.0);
    check_equal(*model.velocity, *prototype.velocity, 0.5);
    check_equal(model.displacement, prototype.displacement, 0.125);
    CHECK(compute_arias_share(*model.acceleration) == compute_arias_share(*prototype.acceleration));
}

TEST_CASE("the Arias intensity of a constant acceleration builds up evenly") {
    const TimeSeries series(SampleQuantity::acceleration, 0.0 * seconds, 0.25 * seconds, std::vector<double>(5, 2.0));
    CHECK(compute_arias_share(series) == std::vector<double>{0.0, 0.25, 0.5, 0.75, 1.0});
    CHECK(compute_arias_share(series.with_samples({0.0, 0.0})) == std::vector<double>{0.0, 0.0});
    CHECK_THROWS_AS(compute_arias_share(series.with_samples(SampleQuantity::velocity, {1.0, 2.0})), ProcessingError);
}

}  // namespace musim::records
