#include <doctest/doctest.h>

#include <cmath>

#include "records/measures/intensity.hpp"
#include "records/processing/scale_record.hpp"
#include "records/synthesis/synthetic.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "scaling/laws/scale_law_catalogue.hpp"
#include "tests/support/relative.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;
using scaling::make_similitude;
using scaling::Similitude;

// [Andrade22] eq. (3) at 1:107 in wood: dt 0.4677716 ms, 40 s become 3.742173 s, PGV 4.235632 cm/s, PGA 0.5456441 g
TEST_CASE("the prototype's record becomes the wood model's by the mu law") {
    const GroundMotion prototype = make_synthetic_record();
    const Similitude wood = make_similitude("mu", {.length = 1.0 / 107.0, .friction = 0.63 / 0.59});

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

    const GroundMotion model = rescale(prototype, make_similitude("froude", {.length = 1.0 / 16.0}));

    CHECK(model.find_component("v").series.samples()[0] == 0.5);
    CHECK(model.find_component("d").series.samples()[0] == 0.125);
    CHECK(model.find_component("d").series.start().value() == 2.0);
    CHECK(model.find_component("d").series.dt().value() == 0.0025);
    CHECK(model.integration_corner->value() == 0.2);
}

TEST_CASE("the intensity of a record scaled by powers of two is the scaled intensity, bit for bit") {
    const TimeSeries prototype = make_synthetic_record().components.front().series;
    const TimeSeries model = rescale(prototype, make_similitude("exact", {.length = 1.0 / 64.0}));

    const Intensity full = compute_intensity(prototype, 0.1 * scaling::si::hertz);
    const Intensity small = compute_intensity(model, 0.8 * scaling::si::hertz);

    CHECK(small.pga->value == full.pga->value);
    CHECK(small.pgv->value.value() == full.pgv->value.value() / 8.0);
    CHECK(small.pgd->value.value() == full.pgd->value.value() / 64.0);
    CHECK(small.arias->value() == full.arias->value() / 8.0);
    CHECK(small.d5_95->value() == full.d5_95->value() / 8.0);
}

/// A record with a horizontal and a vertical component.
GroundMotion make_two_components() {
    GroundMotion motion = make_synthetic_record();
    motion.components.front().name = "360";
    motion.components.push_back(motion.components.front());
    motion.components.back().name = "Up";
    return motion;
}

scaling::ModelScales make_distorted(double length, double friction) {
    const scaling::LawFormulas formulas(
        scaling::solve_law(scaling::load_scale_law("mu_vertical_distortion"), {{"H", length}, {"mu", friction}}));
    return scaling::make_model_scales(formulas, formulas.solved().problem.chosen);
}

double peak_ratio(const GroundMotion& model, const GroundMotion& prototype, const std::string& component) {
    const auto peak = [&](const GroundMotion& motion) {
        return compute_intensity(motion.find_component(component).series).pga->value.value();
    };
    return peak(model) / peak(prototype);
}

// docs/theory/similitude.md, vertical shaking: a_v/g is kept, whatever friction does to the horizontal
TEST_CASE("a vertical component is scaled by gravity, on the clock of the horizontal ones") {
    const GroundMotion prototype = make_two_components();
    const Similitude aluminium = make_similitude("mu", {.length = 1.0 / 107.0, .friction = 0.18 / 0.59, .gravity = 2.0});
    const GroundMotion model = rescale(prototype, aluminium);
    CHECK(peak_ratio(model, prototype, "360") == relative(2.0 * 0.18 / 0.59, 1e-15));
    CHECK(peak_ratio(model, prototype, "Up") == 2.0);
    CHECK(model.find_component("Up").series.dt() == model.find_component("360").series.dt());
    CHECK(model.history.back().find("vertical acceleration 2") != std::string::npos);
    CHECK(rescale(prototype, make_similitude("froude", {.length = 0.04})).history.back().find("vertical") == std::string::npos);
}

TEST_CASE("a record with a vertical component comes back to the bit at powers of two") {
    const GroundMotion prototype = make_two_components();
    for (const char* law : {"mu", "froude", "cauchy"}) {
        const Similitude there = make_similitude(law, {.length = 1.0 / 16.0, .friction = 0.25, .gravity = 4.0});
        const Similitude back = make_similitude(law, {.length = 16.0, .friction = 4.0, .gravity = 0.25});
        const GroundMotion same = rescale(rescale(prototype, there), back);
        for (const Component& component : prototype.components) CHECK(same.find_component(component.name).series == component.series);
    }
    const GroundMotion same = rescale(rescale(prototype, make_distorted(1.0 / 16.0, 0.25)), make_distorted(16.0, 4.0));
    for (const Component& component : prototype.components) CHECK(same.find_component(component.name).series == component.series);
}

// similitude by vertical distortion: t √(V/G), horizontally U G and U V, vertically G and V
TEST_CASE("the mu law with vertical distortion moves the ground horizontally by friction, vertically by height") {
    const double length = 1.0 / 107.0, friction = 0.18 / 0.59;
    GroundMotion prototype = make_two_components();
    const scaling::Time dt = 0.01 * scaling::si::seconds;
    prototype.components.push_back({"d", {}, {SampleQuantity::displacement, 8.0 * scaling::si::seconds, dt, {2.0}}});
    prototype.components.push_back({"Z", {}, {SampleQuantity::displacement, 8.0 * scaling::si::seconds, dt, {2.0}}});
    const GroundMotion model = rescale(prototype, make_distorted(length, friction));
    CHECK(peak_ratio(model, prototype, "360") == relative(friction, 1e-15));
    CHECK(peak_ratio(model, prototype, "Up") == 1.0);
    CHECK(model.find_component("d").series.samples()[0] == relative(2.0 * friction * length, 1e-15));
    CHECK(model.find_component("Z").series.samples()[0] == relative(2.0 * length, 1e-15));
    CHECK(model.find_component("Z").series.dt().value() == relative(0.01 * std::sqrt(length), 1e-15));

    const GroundMotion alike = rescale(prototype, make_distorted(length, 1.0)),
                       exact = rescale(prototype, make_similitude("exact", {.length = length}));
    for (const Component& component : alike.components) CHECK(component.series == exact.find_component(component.name).series);
}

}  // namespace
}  // namespace musim::records
