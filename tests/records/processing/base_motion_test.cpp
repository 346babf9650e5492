#include "records/processing/base_motion.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "records/formats/read_record.hpp"
#include "records/processing/base_window.hpp"
#include "records/processing/motion_change.hpp"
#include "tests/records/processing/made_series.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/shared_records.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;
using scaling::si::hertz;
using scaling::si::seconds;
using std::numbers::pi;

TEST_CASE("a base motion starts and ends at rest whatever the record") {
    for (const SampleQuantity quantity : {SampleQuantity::acceleration, SampleQuantity::velocity, SampleQuantity::displacement}) {
        CAPTURE(to_string(quantity));
        std::vector<double> samples = random_samples(3000, 4);
        for (double& sample : samples) sample += 0.3;  // a bad offset
        const BaseMotion base = make_base_motion(make_series(std::move(samples), 0.01, quantity));

        CHECK(base.velocity.quantity() == SampleQuantity::velocity);
        CHECK(base.velocity.samples().front() == 0.0);
        CHECK(base.velocity.samples().back() == 0.0);
        CHECK(base.displacement.samples().front() == 0.0);
        CHECK(std::abs(base.displacement.samples().back()) < 1e-11 * largest(base.displacement.samples()));
        CHECK(base.displacement == integrate(base.velocity));
        CHECK_FALSE(base.steps.empty());
    }
    CHECK_THROWS_AS(make_base_motion(make_series({1.0, 2.0, 3.0})), ProcessingError);
}

TEST_CASE("a motion that already ends at rest is left as it is") {
    // v = sin² over the record: at rest at both ends; its displacement is not, so take the full period of an odd velocity
    std::vector<double> velocity;
    for (int i = 0; i <= 1000; ++i) velocity.push_back(std::sin(2.0 * pi * i / 1000.0) * std::sin(pi * i / 1000.0));
    const TimeSeries series = make_series(velocity, 0.01, SampleQuantity::velocity);

    const BaseMotion base = make_base_motion(series);

    double difference = 0.0;
    for (std::size_t i = 0; i < velocity.size(); ++i) difference = std::max(difference, std::abs(base.velocity.samples()[i] - velocity[i]));
    CHECK(difference < 1e-12);
}

TEST_CASE("a motion as given keeps its accelerations and its last velocity") {
    // a = s t, v = s t²/2: trapezoids of a straight line are exact
    std::vector<double> ramp;
    for (int i = 0; i <= 1000; ++i) ramp.push_back(0.04 * i);
    const BaseMotion base = make_base_motion(make_series(ramp), {.at_rest = AtRest::as_given});
    for (const std::size_t i : {std::size_t{100}, std::size_t{500}, std::size_t{1000}}) {
        const double t = 0.01 * static_cast<double>(i);
        CHECK(base.velocity.samples()[i] == relative(4.0 * t * t / 2.0, 1e-12));
        CHECK(base.displacement.samples()[i] == relative(4.0 * t * t * t / 6.0, 1e-4));  // of straight lines
    }
    CHECK(base.velocity.samples().back() == relative(200.0, 1e-12));
    const MotionChange change = compare_motions(base.velocity, base.record);
    CHECK(change.difference.pgv.value() == 0.0);
    CHECK(change.difference.pgd.value() == 0.0);
    CHECK_FALSE(change.is_changed());
}

TEST_CASE("a part as given is seen from the base as it begins") {
    std::vector<double> samples;
    for (int i = 0; i <= 400; ++i) samples.push_back(std::sin(2.0 * pi * i / 100.0));
    const TimeSeries record = make_series(samples);
    const TimeSeries velocity = integrate(record);
    const BaseMotion base = make_base_motion(record, {.window = TimeWindow{0.3 * seconds, 2.9 * seconds}, .at_rest = AtRest::as_given});
    REQUIRE(base.velocity.size() == 261);
    for (std::size_t i = 0; i < base.velocity.size(); ++i) {
        CHECK(base.velocity.samples()[i] == velocity.samples()[i + 30] - velocity.samples()[30]);
    }
    CHECK(compare_motions(base.velocity, base.record).difference.pgv.value() == 0.0);
}

TEST_CASE("a pulse that ends displaced is left as it is where the base may end elsewhere") {
    // v = sin² has the displacement T/2 at its end; straight lines between samples of whole periods have it exactly
    std::vector<double> velocity;
    for (int i = 0; i <= 200; ++i) velocity.push_back(std::pow(std::sin(pi * i / 200.0), 2));
    const TimeSeries series = make_series(velocity, 0.01, SampleQuantity::velocity);

    const BaseMotion displaced = make_base_motion(series, {.at_rest = AtRest::displaced});
    CHECK(displaced.displacement.samples().back() == relative(1.0, 1e-12));
    const MotionChange change = compare_motions(displaced.velocity, displaced.record);
    CHECK(change.difference.pgv.value() < 1e-15);
    CHECK(change.difference.pgd.value() < 1e-14);

    const BaseMotion home = make_base_motion(series);
    CHECK(std::abs(home.displacement.samples().back()) < 1e-12);
    CHECK(compare_motions(home.velocity, home.record).is_changed());
}

TEST_CASE("what brings a part of a record to rest is the least acceleration that does") {
    // of a part the acceleration taken out is a straight line: the velocity's a parabola, from the record's own first velocity to its last
    std::vector<double> samples;
    for (int i = 0; i <= 800; ++i) samples.push_back(std::sin(0.031 * i) + 0.4 * std::cos(0.173 * i));
    const TimeSeries record = make_series(samples);
    const BaseMotion base = make_base_motion(record, {.window = TimeWindow{1.0 * seconds, 6.0 * seconds}});
    std::vector<double> taken;
    for (std::size_t i = 0; i < base.velocity.size(); ++i) taken.push_back(base.record.velocity.samples()[i] - base.velocity.samples()[i]);
    const TimeSeries whole = integrate(record);
    CHECK(taken.front() == whole.samples()[100]);
    CHECK(taken.back() == whole.samples()[600]);
    double third = 0.0;
    for (std::size_t i = 3; i < taken.size(); ++i) {
        third = std::max(third, std::abs(taken[i] - 3.0 * taken[i - 1] + 3.0 * taken[i - 2] - taken[i - 3]));
    }
    CHECK(third < 1e-14 * largest(whole.samples()));
    CHECK(std::abs(base.displacement.samples().back()) < 1e-12 * largest(base.displacement.samples()));
    // displaced: a constant acceleration, a line of velocity
    const BaseMotion displaced =
        make_base_motion(record, {.window = TimeWindow{1.0 * seconds, 6.0 * seconds}, .at_rest = AtRest::displaced});
    const auto at = [&](std::size_t i) { return displaced.record.velocity.samples()[i] - displaced.velocity.samples()[i]; };
    CHECK(at(250) == relative(0.5 * (at(0) + at(500)), 1e-12));
}

TEST_CASE("a part of a near-fault record keeps its peaks") {
    if (!tests::have_shared_records()) return;
    const GroundMotion record = read_record(tests::shared_records() / "peer" / "TCU052-N.AT2");
    const auto change_of = [&](double from, double to) {
        const BaseMotion base = make_base_motion(record, record.components[0].name, {.window = TimeWindow{from * seconds, to * seconds}});
        return compare_motions(base.velocity, base.record);
    };
    // its own velocity at 43 s is 0.52 of its peak, which a taper and shapes that are zero at the ends made PGV +14 %
    const MotionChange change = change_of(27.0, 43.0);
    CHECK_FALSE(change.is_changed());
    CHECK((change.base.pgv / change.record.pgv).value() == relative(1.0, 0.01));
    CHECK(change.difference.pgv.value() > 0.4 * change.record.pgv.value());
    CHECK(change.difference.pga.value() < 0.05 * change.record.pga.value());
    // the base that comes home cannot have a displacement of 1.4 m at the end, and says so
    CHECK(change_of(20.0, 50.0).is_changed());
    CHECK(describe_changed_peaks(change_of(20.0, 50.0)).find("makes PGV 124 cm/s where its record has 118 cm/s (+4.3 %)") == 0);
}

TEST_CASE("the base motion of a record scaled by powers of two is the scaled base motion, bit for bit") {
    // λ_l = 1/16: times by 1/4, accelerations by 1, velocities by 1/4, lengths by 1/16
    const std::vector<double> samples = random_samples(2000, 5);
    const TimeSeries prototype = make_series(samples, 0.005);
    const TimeSeries model = make_series(samples, 0.005 / 4.0);

    for (const AtRest at_rest : {AtRest::home, AtRest::displaced, AtRest::as_given}) {
        const BaseMotion full = make_base_motion(
            prototype,
            {.window = TimeWindow{1.0 * seconds, 9.0 * seconds}, .take_out_mean = true, .high_pass = 0.3 * hertz, .at_rest = at_rest});
        const BaseMotion small = make_base_motion(
            model,
            {.window = TimeWindow{0.25 * seconds, 2.25 * seconds}, .take_out_mean = true, .high_pass = 1.2 * hertz, .at_rest = at_rest});

        REQUIRE(full.velocity.size() == small.velocity.size());
        std::size_t different = 0;
        for (std::size_t i = 0; i < full.velocity.size(); ++i) {
            different += full.velocity.samples()[i] != 4.0 * small.velocity.samples()[i] ? 1U : 0U;
            different += full.displacement.samples()[i] != 16.0 * small.displacement.samples()[i] ? 1U : 0U;
            different += full.record.velocity.samples()[i] != 4.0 * small.record.velocity.samples()[i] ? 1U : 0U;
        }
        const MotionChange of_full = compare_motions(full.velocity, full.record), of_small = compare_motions(small.velocity, small.record);
        CHECK(of_full.difference.pga.value() == of_small.difference.pga.value());
        CHECK(of_full.record.pgd.value() == 16.0 * of_small.record.pgd.value());
        CHECK(different == 0);
        CHECK(largest(full.velocity.samples()) > 0.0);
    }
}

TEST_CASE("differences of a motion from its record are those in time") {
    // straight lines of v = 0, 1, 1, 0 m/s at 1 s against a record of 0, 1, 1.5, 0.5 m/s and 0, 2, 1, -3 m/s²
    const std::vector<double> velocity{0.0, 1.0, 1.0, 0.0}, own{0.0, 1.0, 1.5, 0.5}, acceleration{0.0, 2.0, 1.0, -3.0};
    const MotionChange change = compare_motions(velocity, own, acceleration, 1.0);
    CHECK(change.base.pga.value() == 1.0);
    CHECK(change.record.pga.value() == 3.0);
    CHECK(change.difference.pga.value() == 1.5);  // slopes 1, 0, -1 against means 1, 1.5, -1
    CHECK(change.base.pgv.value() == 1.0);
    CHECK(change.record.pgv.value() == 1.5);
    CHECK(change.difference.pgv.value() == 0.5);
    CHECK(change.base.pgd.value() == 2.0);
    CHECK(change.record.pgd.value() == 2.75);
    CHECK(change.difference.pgd.value() == 0.75);
    CHECK(describe_changed_peaks(change) ==
          "makes PGA 0.102 g where its record has 0.3059 g (-66.7 %) and PGV 100 cm/s where its record has 150 cm/s (-33.3 %)");
    CHECK(describe(change) ==
          "PGA 0.102 g (record 0.3059 g, -66.7 %), PGV 100 cm/s (record 150 cm/s, -33.3 %), PGD 2 m (record 2.75 m, -27.3 %); largest "
          "difference at any time 0.153 g (of means over a step), 50 cm/s, 750 mm");
    // without accelerations, those of the record's own straight lines
    CHECK(compare_motions(velocity, own, {}, 1.0).record.pga.value() == 1.0);
}

TEST_CASE("a chosen window holds the strong motion and opens where the record is at rest and at its zero") {
    // strong from 10 s to 20 s; before and after, a slow wave whose velocity and displacement are zero together at 8 s and at 22 s alone
    std::vector<double> samples;
    for (int i = 0; i <= 3000; ++i) {
        const double t = 0.01 * i, tau = (t - 8.0) / 14.0;
        const bool inside = tau > 0.0 && tau < 1.0;
        const double envelope = t > 10.0 && t < 20.0 ? std::pow(std::sin(pi * (t - 10.0) / 10.0), 2) : 0.0;
        const double strong = 5.0 * envelope * std::cos(2.0 * pi * 4.0 * t);
        samples.push_back(strong + (inside ? 0.3 * std::cos(2.0 * pi * tau) : 0.0));
    }
    GroundMotion motion;
    motion.components.push_back({.name = "1", .series = make_series(std::move(samples))});
    const TimeWindow window = find_base_window(motion, {"1"});
    CHECK(window.start.value() <= 12.0);
    CHECK(window.end.value() >= 18.0);
    const BaseMotion base = make_base_motion(motion, "1", {.window = window});
    const MotionChange change = compare_motions(base.velocity, base.record);
    CHECK(change.difference.pgv.value() < kCheapWindow * change.record.pgv.value());
    CHECK(change.difference.pgd.value() < kCheapWindow * change.record.pgd.value());
    CHECK_THROWS_AS(find_base_window(motion, {"2"}), ReadError);
}

TEST_CASE("chosen windows of real records change PGV and PGD by less than two percent") {
    if (!tests::have_shared_records()) return;
    for (const char* const name : {"TCU052-N.AT2", "IELC180.AT2", "RSN753_LOMAP_CLS000.AT2", "RSN763_LOMAP_GIL067.AT2", "TAK000.AT2"}) {
        CAPTURE(name);
        const GroundMotion record = read_record(tests::shared_records() / "peer" / name);
        const std::string component = record.components[0].name;
        const TimeWindow window = find_base_window(record, {component});
        const BaseMotion base = make_base_motion(record, component, {.window = window});
        const BaseMotion whole = make_base_motion(record, component);
        const MotionChange change = compare_motions(base.velocity, base.record);
        CHECK((change.base.pgv / change.record.pgv).value() == relative(1.0, 0.02));
        CHECK((change.base.pgd / change.record.pgd).value() == relative(1.0, 0.02));
        // those of the whole record, too: it opens where the record is at its zero
        CHECK(change.base.pgv.value() == relative(largest(whole.record.velocity.samples()), 0.02));
        CHECK(change.base.pgd.value() == relative(largest(integrate(whole.record.velocity).samples()), 0.03));
    }
}

}  // namespace
}  // namespace musim::records
