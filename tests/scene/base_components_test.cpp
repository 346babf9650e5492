#include "lsdem/scene/base_components.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "lsdem/base_motion.hpp"
#include "records/error.hpp"
#include "tests/scene/made_scene.hpp"
#include "tests/support/shared_records.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace musim;
using namespace musim::lsdem;
using namespace musim::lsdem::testing;
using musim::lsdem::BaseComponent;

namespace {

using std::numbers::pi;

SceneMotion parse_motion(const std::string& text, const std::filesystem::path& origin = "scene") {
    return parse_scene(make_scene_text(kColumn, R"(, "base_motion": )" + text), origin).base_motion;
}

/// Six counts of an accelerometer, 50 a second.
constexpr const char* kCounts =
    "TIMESERIES XX_ABC__HNE_D, 6 samples, 50 sps, 2020-02-29T12:00:00.000000, SLIST, INTEGER, Counts\n0 2 -4 4 -2 0\n";

double largest(const std::vector<double>& values) {
    double peak = 0.0;
    for (const double value : values) peak = std::max(peak, std::abs(value));
    return peak;
}

/// A text record of two columns, 2 Hz sine of 1 m/s² windowed to rest, in a folder of its own.
struct TextRecord {
    tests::TemporaryFolder folder;

    TextRecord() {
        std::ofstream file(folder.path() / "motion.txt");
        file.precision(17);
        for (int k = 0; k <= 400; ++k) {
            const double t = 0.01 * k;
            const double envelope = std::sin(pi * t / 4.0);
            file << t << ' ' << envelope * envelope * std::sin(4.0 * pi * t) << ' ' << 0.5 * envelope << '\n';
        }
    }
    std::filesystem::path scene() const { return folder.path() / "scene.json"; }
};

}  // namespace

TEST_CASE("without a base motion no axis moves") {
    for (const BaseComponent& component : make_base_components({}).all()) CHECK(component.velocity.empty());
}

TEST_CASE("what a record lacks is asked for by the scene's keys, not by options of commands") {
    const tests::TemporaryFolder folder;
    std::ofstream(folder.path() / "a--dt.txt") << "1\n2\n3\n2\n1\n";
    const std::string file = (folder.path() / "a--dt.txt").string();
    const auto refuse = [&](const std::string& record, const std::string& more) -> std::string {
        const std::string text = R"({"record": ")" + record + R"(", "components": {"x": "1"})" + more + "}";
        try {
            make_base_components(parse_motion(text, folder.path() / "scene.json"));
        } catch (const records::ReadError& error) {
            return error.what();
        }
        return "";
    };
    CHECK(refuse(file, R"(, "unit": "furlong")").ends_with("give one of these as \"unit\""));
    CHECK(refuse(file, R"(, "unit": "g")").starts_with(file));
    CHECK(refuse(file, R"(, "unit": "g")").ends_with("give \"dt\""));
    const std::string counts = refuse(folder.write("counts.txt", kCounts).string(), "");
    CHECK(counts.find("(SLIST holds counts); give \"station_xml\", or \"sensitivity\" in counts per m/s^2") != std::string::npos);
}

TEST_CASE("a scene says what counts of its record are worth") {
    const tests::TemporaryFolder folder;
    folder.write("counts.txt", kCounts);
    const SceneMotion motion =
        parse_motion(R"({"record": "counts.txt", "components": {"x": "HNE"}, "sensitivity": 8})", folder.path() / "a.json");
    const SceneMotion twice =
        parse_motion(R"({"record": "counts.txt", "components": {"x": "HNE"}, "sensitivity": 16})", folder.path() / "a.json");
    const double peak = largest(make_base_components(motion).shift[0].velocity);
    CHECK(peak > 0.0);
    CHECK(largest(make_base_components(twice).shift[0].velocity) == doctest::Approx(0.5 * peak).epsilon(1e-12));

    // the StationXML file lies beside the scene
    const SceneMotion named =
        parse_motion(R"({"record": "counts.txt", "components": {"x": "HNE"}, "station_xml": "no.xml"})", folder.path() / "a.json");
    CHECK(std::get<RecordMotion>(named.source).station_xml == folder.path() / "no.xml");
    CHECK_THROWS_WITH_AS(make_base_components(named), doctest::Contains("no.xml"), records::ReadError);
}

TEST_CASE("a step is one sample that holds from its start") {
    const auto components =
        make_base_components(parse_motion(R"({"signal": "step", "velocity": "32 mm/s", "direction": "z", "start": "0.1 s"})"));
    CHECK(components.shift[0].velocity.empty());
    CHECK(components.shift[2].velocity == std::vector<double>{0.032});
    CHECK(components.shift[2].start == 0.1);
    const lsdem::BaseMotion base(components);
    CHECK(base.velocity(0.05).z() == 0.0);
    CHECK(base.velocity(5.0).z() == 0.032);
}

TEST_CASE("a sine starts and ends at rest and follows its formula") {
    const auto components =
        make_base_components(parse_motion(R"({"signal": "sine", "amplitude": "2 m/s^2", "frequency": "5 Hz", "cycles": 3})"));
    const BaseComponent& x = components.shift[0];
    const double amplitude = 2.0 / (10.0 * pi);
    CHECK(x.velocity.size() == 601);  // 200 a period
    CHECK(x.dt == doctest::Approx(0.001).epsilon(1e-12));
    for (std::size_t k = 0; k < x.velocity.size(); ++k) {
        const double t = static_cast<double>(k) * x.dt;
        // rounding of the phase, 6π
        CHECK(x.velocity[k] == doctest::Approx(amplitude * (1.0 - std::cos(10.0 * pi * t))).epsilon(1e-12));
    }
    CHECK(std::abs(x.velocity.back()) < 1e-12 * amplitude);
    CHECK(lsdem::BaseMotion(components).acceleration(0.05).x() == doctest::Approx(2.0).epsilon(2e-4));  // A·sinc(π/200)
}

TEST_CASE("a half sine leaves the velocity 2AT/pi") {
    const BaseComponent x =
        make_base_components(parse_motion(R"({"signal": "half_sine", "amplitude": "1 g", "duration": "50 ms"})")).shift[0];
    CHECK(x.velocity.front() == 0.0);
    CHECK(x.velocity.back() == doctest::Approx(2.0 * 9.80665 * 0.05 / pi).epsilon(1e-14));
    CHECK(static_cast<double>(x.velocity.size() - 1) * x.dt == doctest::Approx(0.05).epsilon(1e-14));
}

TEST_CASE("a Ricker wavelet peaks 1.5 periods after its start and moves the ground neither in the end") {
    const auto components =
        make_base_components(parse_motion(R"({"signal": "ricker", "direction": "y", "amplitude": "0.3 g", "frequency": "7 Hz"})"));
    const BaseComponent& y = components.shift[1];
    CHECK(y.velocity.front() == 0.0);
    CHECK(y.velocity.back() == 0.0);
    const lsdem::BaseMotion base(components);
    const double period = 1.0 / 7.0;
    // the piecewise constant acceleration over 1/200 of a period around the peak: 1 − (π f dt)²/2 at most below it
    CHECK(base.acceleration(1.5 * period).y() == doctest::Approx(0.3 * 9.80665).epsilon(2e-4));
    // its displacement −A/(2π²f²)·exp(−π²f²τ²) is over at both ends
    const double peak_displacement = 0.3 * 9.80665 / (2.0 * pi * pi * 49.0);
    CHECK(std::abs(base.displacement(1.5 * period).y()) == doctest::Approx(peak_displacement).epsilon(2e-4));
    CHECK(std::abs(base.displacement(10.0).y()) < 1e-6 * peak_displacement);
}

TEST_CASE("a synthetic motion has its peak velocity and ends at rest") {
    const BaseComponent x =
        make_base_components(
            parse_motion(
                R"({"signal": "synthetic", "pga": "0.511 g", "pgv": "42.4 cm/s", "duration": "10 s", "dt": "0.005 s", "seed": 3})"))
            .shift[0];
    // the record itself meets both peaks to 1e-9; the last correction to rest moves them by less than 0.1 %
    CHECK(largest(x.velocity) == doctest::Approx(0.424).epsilon(1e-3));
    CHECK(x.velocity.front() == 0.0);
    CHECK(x.velocity.back() == 0.0);
    CHECK(x.start == 0.0);
}

TEST_CASE("a component knows its record, or the peak of its formula, at its own scale") {
    const auto component_of = [](const char* motion, const std::filesystem::path& place = "scene") {
        return make_base_components(parse_motion(motion, place)).shift[0];
    };
    const BaseComponent pulse = component_of(R"({"signal": "half_sine", "amplitude": "-0.4 g", "duration": "50 ms"})");
    CHECK(pulse.source.peak_acceleration == doctest::Approx(0.4 * 9.80665));
    CHECK(pulse.source.velocity.empty());
    CHECK(component_of(R"({"signal": "step", "velocity": "32 mm/s"})").source.peak_acceleration == 0.0);
    const TextRecord record;
    const BaseComponent whole = component_of(R"({"record": "motion.txt", "components": {"x": "1"}})", record.scene());
    CHECK(whole.source.peak_acceleration == 0.0);
    REQUIRE(whole.source.velocity.size() == whole.velocity.size());
    REQUIRE(whole.source.acceleration.size() == whole.velocity.size());
    const BaseComponent part =
        component_of(R"({"record": "motion.txt", "components": {"x": "1"}, "window": ["1 s", "3 s"]})", record.scene());
    REQUIRE(part.source.velocity.size() == 201);
    for (const std::size_t k : {std::size_t{0}, std::size_t{77}, std::size_t{200}}) {
        CHECK(part.source.velocity[k] == whole.source.velocity[k + 100]);
        CHECK(part.source.acceleration[k] == whole.source.acceleration[k + 100]);
    }
    // Froude: half the friction, half the acceleration; velocities by a quarter of the root of lengths
    const BaseComponent model = component_of(
        R"({"record": "motion.txt", "components": {"x": "1"}, "scale": {"law": "mu", "length": 0.25, "friction": 0.5}})", record.scene());
    const double time = model.dt / whole.dt;
    CHECK(model.source.acceleration[150] == doctest::Approx(0.5 * whole.source.acceleration[150]));
    CHECK(model.source.velocity[150] == doctest::Approx(0.5 * time * whole.source.velocity[150]));
}

TEST_CASE("a base ends at rest, displaced or as its record leaves it") {
    const tests::TemporaryFolder folder;
    std::ofstream file(folder.path() / "ramp.txt");
    for (int k = 0; k <= 400; ++k) file << 0.01 * k << ' ' << 0.02 * k << '\n';  // 2 m/s³
    file.close();
    const auto end_of = [&](const std::string& at_rest) {
        const BaseComponent x =
            make_base_components(parse_motion(R"({"record": "ramp.txt", "components": {"x": "1"}, "unit": "m/s^2")" + at_rest + "}",
                                              folder.path() / "scene.json"))
                .shift[0];
        const lsdem::BaseMotion base({.shift = {x, {}, {}}});
        return std::pair(base.velocity(5.0).x(), base.displacement(4.0).x());
    };
    CHECK(end_of(R"(, "at_rest": false)").first == doctest::Approx(2.0 * 16.0 / 2.0).epsilon(1e-12));
    CHECK(end_of(R"(, "at_rest": false)").second == doctest::Approx(2.0 * 64.0 / 6.0).epsilon(1e-4));
    CHECK(end_of(R"(, "at_rest": "displaced")").first == 0.0);
    // the half of v that τ²(3 − 2τ) takes leaves ∫ (τ² − τ²(3 − 2τ)) v T dτ = (1/3 − 1/2) v T
    CHECK(end_of(R"(, "at_rest": "displaced")").second == doctest::Approx(16.0 * 4.0 * (1.0 / 3.0 - 0.5)).epsilon(1e-3));
    CHECK(end_of("").first == 0.0);
    CHECK(std::abs(end_of("").second) < 1e-12);
    CHECK(end_of(R"(, "at_rest": true)") == end_of(""));
}

TEST_CASE("a record moves the axes it is asked to, and a window starts at time zero") {
    const TextRecord record;
    const auto whole =
        make_base_components(parse_motion(R"({"record": "motion.txt", "components": {"x": "2", "z": "1"}})", record.scene()));
    CHECK(whole.shift[0].velocity.size() == 401);
    CHECK(whole.shift[1].velocity.empty());
    CHECK(whole.shift[2].velocity.size() == 401);
    CHECK(whole.shift[2].start == 0.0);
    CHECK(whole.shift[2].dt == doctest::Approx(0.01).epsilon(1e-9));
    CHECK(whole.shift[0].velocity != whole.shift[2].velocity);

    const auto part = make_base_components(
        parse_motion(R"({"record": "motion.txt", "components": {"x": "1"}, "window": ["1 s", "3 s"]})", record.scene()));
    CHECK(part.shift[0].velocity.size() == 201);
    CHECK(std::abs(part.shift[0].start) < 1e-9);
}

TEST_CASE("a record's own scale multiplies its times and velocities") {
    const TextRecord record;
    const BaseComponent plain =
        make_base_components(parse_motion(R"({"record": "motion.txt", "components": {"x": "1"}})", record.scene())).shift[0];
    const BaseComponent scaled =
        make_base_components(
            parse_motion(
                R"({"record": "motion.txt", "components": {"x": "1"}, "scale": {"law": "mu", "length": "1/107", "friction": "0.63/0.59"}})",
                record.scene()))
            .shift[0];
    REQUIRE(scaled.velocity.size() == plain.velocity.size());
    // [Andrade22] eq. (3)
    CHECK(scaled.dt / plain.dt == doctest::Approx(0.09355432).epsilon(1e-7));
    CHECK(largest(scaled.velocity) / largest(plain.velocity) == doctest::Approx(0.09989698).epsilon(1e-7));
}

TEST_CASE("a record's own scale may follow a law in a file beside the scene") {
    const TextRecord record;
    std::ofstream(record.scene().parent_path() / "spring.json")
        << R"-({"schema": "musim-law/1", "name": "spring", "title": "t", "extends": "mechanics", "quantities": [{"name": "k_0", "unit": "N/m"}],
                "chosen": [{"name": "l"}, {"name": "rho", "default": 1}, {"name": "mu", "default": 1}, {"name": "g", "default": 1}],
                "held": ["k_0*t^2/m"]})-";
    const BaseComponent plain =
        make_base_components(parse_motion(R"({"record": "motion.txt", "components": {"x": "1"}})", record.scene())).shift[0];
    const BaseComponent scaled =
        make_base_components(
            parse_motion(
                R"({"record": "motion.txt", "components": {"x": "1"}, "scale": {"law": "spring.json", "length": "1/4", "set": {"k_0": "1/16"}}})",
                record.scene()))
            .shift[0];
    // λ_t = √(λ_m/λ_k) = √(16/64), λ_v = λ_l/λ_t
    CHECK(scaled.dt == 0.5 * plain.dt);
    CHECK(largest(scaled.velocity) == 0.5 * largest(plain.velocity));
}

TEST_CASE("a record that is not there or lacks the component is refused") {
    const TextRecord record;
    CHECK_THROWS_AS(make_base_components(parse_motion(R"({"record": "none.txt", "components": {"x": "1"}})", record.scene())),
                    records::ReadError);
    CHECK_THROWS_AS(make_base_components(parse_motion(R"({"record": "motion.txt", "components": {"x": "7"}})", record.scene())),
                    records::ReadError);
    const SceneMotion beyond =
        parse_motion(R"({"record": "motion.txt", "components": {"x": "1"}, "window": ["50 s", "60 s"]})", record.scene());
    check_message(error_of([&] { make_base_components(beyond); }), {"/base_motion"});
}

TEST_CASE("the papers' Ridgecrest record drives a base at rest before and after") {
    if (!tests::have_shared_records()) return;
    const auto file = (tests::shared_records() / "csmip" / "CICLC.v1").string();
    const SceneMotion motion =
        parse_motion(R"({"record": ")" + file + R"(", "components": {"x": "360", "y": "90", "z": "Up"}, "window": ["225 s", "265 s"]})");
    for (const BaseComponent& component : make_base_components(motion).shift) {
        CHECK(component.velocity.front() == 0.0);
        CHECK(component.velocity.back() == 0.0);
        CHECK(largest(component.velocity) > 0.05);
        CHECK(largest(component.velocity) < 1.0);
    }
}
