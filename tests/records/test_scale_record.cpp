#include <doctest/doctest.h>

#include <cmath>

#include "records/intensity.hpp"
#include "records/scale_record.hpp"
#include "records/synthetic.hpp"
#include "tests/support/relative.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;
using scaling::Law;
using scaling::Similitude;

// [Andrade22] eq. (3) at 1:107 in wood: dt 0.4677716 ms, 40 s become 3.742173 s, PGV 4.235632 cm/s, PGA 0.5456441 g
TEST_CASE("the prototype's record becomes the wood model's by the mu law") {
    const GroundMotion prototype = make_synthetic_record();
    const Similitude wood({.length = 1.0 / 107.0, .friction = 0.63 / 0.59}, Law::mu);

    const GroundMotion model = rescale(prototype, wood);

    const TimeSeries& series = model.components.front().series;
    CHECK(series.dt().value() == relative(0.4677716e-3, 1e-7));
    CHECK(series.duration().value() == relative(3.742173, 1e-6));
    const Intensity intensity = compute_intensity(series);
    CHECK(std::abs(intensity.pgv->value.value()) == relative(4.235632e-2, 1e-6));
    CHECK(std::abs(intensity.pga->value.value()) / 9.80665 == relative(0.5456441, 1e-6));
    CHECK(model.history.size() == prototype.history.size() + 1);
    CHECK(model.history.back().find("mu law") != std::string::npos);
}

TEST_CASE("velocity and displacement records scale with their own factors, and the corner with the frequency") {
    GroundMotion prototype{.format = "test"};
    const scaling::Time dt = 0.01 * scaling::si::seconds;
    prototype.components.push_back({"v", {}, {SampleQuantity::velocity, 8.0 * scaling::si::seconds, dt, {2.0}}});
    prototype.components.push_back({"d", {}, {SampleQuantity::displacement, 8.0 * scaling::si::seconds, dt, {2.0}}});
    prototype.integration_corner = 0.05 * scaling::si::hertz;

    const GroundMotion model = rescale(prototype, Similitude({.length = 1.0 / 16.0}, Law::froude));

    CHECK(model.find_component("v").series.samples()[0] == 0.5);
    CHECK(model.find_component("d").series.samples()[0] == 0.125);
    CHECK(model.find_component("d").series.start().value() == 2.0);
    CHECK(model.find_component("d").series.dt().value() == 0.0025);
    CHECK(model.integration_corner->value() == 0.2);
}

TEST_CASE("the intensity of a record scaled by powers of two is the scaled intensity, bit for bit") {
    const TimeSeries prototype = make_synthetic_record().components.front().series;
    const TimeSeries model = rescale(prototype, Similitude({.length = 1.0 / 64.0}, Law::exact));

    const Intensity full = compute_intensity(prototype, 0.1 * scaling::si::hertz);
    const Intensity small = compute_intensity(model, 0.8 * scaling::si::hertz);

    CHECK(small.pga->value == full.pga->value);
    CHECK(small.pgv->value.value() == full.pgv->value.value() / 8.0);
    CHECK(small.pgd->value.value() == full.pgd->value.value() / 64.0);
    CHECK(small.arias->value() == full.arias->value() / 8.0);
    CHECK(small.d5_95->value() == full.d5_95->value() / 8.0);
}

}  // namespace
}  // namespace musim::records
