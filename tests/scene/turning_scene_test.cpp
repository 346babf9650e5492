#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <string>

#include "lsdem/base_motion.hpp"
#include "lsdem/scene/base_components.hpp"
#include "lsdem/scene/build_model.hpp"
#include "lsdem/scene/scale_scene.hpp"
#include "tests/scene/made_scene.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace musim;
using namespace musim::lsdem;
using namespace musim::lsdem::testing;

namespace {

using std::numbers::pi;

Scene parse_turning(const std::string& more, const std::filesystem::path& origin = "scene") {
    return parse_scene(make_scene_text(kColumn, more), origin);
}

/// A text record of a gyroscope and of a wave that runs along x: rates about two axes, and velocities along z and y.
struct TurningRecord {
    musim::tests::TemporaryFolder folder;

    TurningRecord() {
        std::ofstream file(folder.path() / "six.csv");
        file.precision(17);
        file << "time [s],pitch [deg/s],yaw [rad/s],up [m/s],across [m/s]\n";
        for (int k = 0; k <= 400; ++k) {
            const double t = 0.01 * k, shape = std::sin(pi * t / 4.0) * std::sin(pi * t / 4.0);
            file << t << ',' << 3.0 * shape * std::sin(4.0 * pi * t) << ',' << 0.02 * shape << ',' << 0.1 * shape << ',' << 0.2 * shape
                 << '\n';
        }
    }
    Scene read(const std::string& components, const std::string& more = "") const {
        return parse_turning(R"(, "base_motion": {"record": "six.csv", "at_rest": false, "components": )" + components + more + "}",
                             folder.path() / "scene.json");
    }
};

}  // namespace

TEST_CASE("a scene turns its ground by the components that a record names for rx, ry and rz") {
    const TurningRecord record;
    const Scene scene = record.read(R"({"x": "up", "ry": "pitch", "rz": "yaw"})", R"(, "pivot": ["1 m", 0, "-2 m"])");
    const BaseComponents motion = make_base_components(scene.base_motion);
    CHECK(motion.turns());
    CHECK(motion.turn[0].velocity.empty());
    CHECK(motion.pivot == Vector3(1.0, 0.0, -2.0));
    const double degree = pi / 180.0;
    // at t = 2 s the sine is zero, and 2.125 s is a quarter of a period later
    CHECK(motion.turn[1].velocity[212] == doctest::Approx(3.0 * degree * std::pow(std::sin(pi * 0.53), 2) * std::sin(4.0 * pi * 2.12)));
    CHECK(motion.turn[2].velocity[200] == doctest::Approx(0.02));
    CHECK(motion.shift[0].velocity[200] == doctest::Approx(0.1));
    // the angle is the integral of the rate: 0.02 rad/s times half of 4 s
    CHECK(BaseMotion(motion).angle(4.0).z() == doctest::Approx(0.04).epsilon(1e-4));
    CHECK(parse_scene(write_scene(scene), "scene") == scene);
}

// θ_y = u_z'/c and θ_z = −u_y'/(2c) of waves along x.
TEST_CASE("translations turn the ground by an apparent velocity") {
    const TurningRecord record;
    const Scene scene = record.read(R"({"z": "up", "ry": "up", "rz": "across"})", R"(, "apparent_velocity": "500 m/s")");
    const BaseMotion motion(make_base_components(scene.base_motion));
    CHECK(motion.angle(2.0).y() == doctest::Approx(0.1 / 500.0).epsilon(1e-3));
    CHECK(motion.angle(2.0).z() == doctest::Approx(-0.2 / 1000.0).epsilon(1e-3));
    CHECK(motion.velocity(2.0).z() == doctest::Approx(0.1));
}

TEST_CASE("a component that does not suit its axis is refused in one line") {
    const TurningRecord record;
    const auto refusal = [&](const std::string& components, const std::string& more = "") {
        return error_of([&] { make_base_components(record.read(components, more).base_motion, "scene: /base_motion"); });
    };
    check_message(refusal(R"({"x": "pitch"})"), {"/base_motion/components/x", "pitch", "rx, ry or rz"});
    check_message(refusal(R"({"ry": "up"})"), {"/base_motion/components/ry", "apparent_velocity"});
    check_message(refusal(R"({"rx": "up"})", R"(, "apparent_velocity": "500 m/s")"), {"/base_motion/components/rx", "ry or rz"});
}

TEST_CASE("a rocking base swings between its angles and ends where it began") {
    const Scene scene = parse_turning(R"(, "base_motion": {"signal": "rocking", "angle": "2 deg", "frequency": "4 Hz", "cycles": 5})");
    const BaseComponents components = make_base_components(scene.base_motion);
    CHECK(components.turn[0].velocity.empty());
    const BaseMotion motion(components);
    const double amplitude = 2.0 * pi / 180.0;
    // in the middle of the third cycle's first half; the sum of chords is off by 1e-4
    CHECK(motion.angle(0.5625).y() == doctest::Approx(amplitude).epsilon(2e-4));
    CHECK(motion.angle(0.6875).y() == doctest::Approx(-amplitude).epsilon(2e-4));
    CHECK(std::abs(motion.angle(1.25).y()) < 1e-4 * amplitude);
    CHECK(components.turn[1].velocity.front() == 0.0);
    CHECK(std::abs(components.turn[1].velocity.back()) < 1e-12);
    CHECK(parse_scene(write_scene(scene), "scene") == scene);
    const Scene about_z =
        parse_turning(R"(, "base_motion": {"signal": "rocking", "direction": "rz", "angle": "2 deg", "frequency": "4 Hz", "cycles": 2})");
    CHECK_FALSE(make_base_components(about_z.base_motion).turn[2].velocity.empty());
}

TEST_CASE("a tilt turns the ground at its rate until its angle, and gives the scene its duration") {
    const std::string text = R"({"schema": "musim-scene/1", "material": "wood", "structure": )" + kColumn;
    const Scene scene = parse_scene(text + R"(, "tilt": {"about": "x", "rate": "5 deg/s", "until": "30 deg"}})", "scene");
    CHECK(scene.time.duration.value() == doctest::Approx(6.0 * 64.0 / 63.0));
    const BaseMotion motion(make_base_components(scene.base_motion));
    CHECK(motion.turn_rates(3.0).velocity.x() == doctest::Approx(5.0 * pi / 180.0));
    CHECK(motion.angle(scene.time.duration.value()).x() == doctest::Approx(pi / 6.0).epsilon(1e-12));
    CHECK(motion.turn_rates(7.0).velocity == Vector3::Zero());
    CHECK(parse_scene(write_scene(scene), "scene") == scene);
    CHECK(tilts(scene));
}

TEST_CASE("a base turns about the middle of what stands on it, unless a scene says where") {
    const std::string tilt = R"(, "tilt": {"rate": "5 deg/s")";
    const std::string blocks = R"({"kind": "blocks", "blocks": [{"size": ["1 m", "1 m", "1 m"], "position": ["3 m", 0, "0.5 m"]},
        {"size": ["1 m", "1 m", "1 m"], "position": ["6 m", "2 m", "0.5 m"]}]})";
    CHECK(make_model(parse_scene(make_scene_text(blocks, tilt + "}"))).ground.motion.pivot == Vector3(4.5, 1.0, 0.0));
    CHECK(make_model(parse_scene(make_scene_text(blocks, tilt + R"(, "pivot": [1, 2, 3]})"))).ground.motion.pivot ==
          Vector3(1.0, 2.0, 3.0));
}

TEST_CASE("angles keep their size in every law, and rates go with the inverse of time") {
    const Scene scene = parse_turning(
        R"(, "base_motion": {"signal": "rocking", "angle": "2 deg", "frequency": "4 Hz", "cycles": 5, "pivot": ["16 m", 0, 0]})");
    const Model prototype = make_model(scene);
    const Model model = make_model(scale_scene(scene, scaling::make_similitude("mu", {.length = 1.0 / 16.0})));
    const BaseComponent &from = prototype.ground.motion.turn[1], &to = model.ground.motion.turn[1];
    CHECK(to.dt == 0.25 * from.dt);
    REQUIRE(to.velocity.size() == from.velocity.size());
    CHECK(to.velocity[77] == 4.0 * from.velocity[77]);
    CHECK(model.ground.motion.pivot.x() == 1.0);
}

TEST_CASE("a turn that makes no sense is refused in one line") {
    const auto refusal = [&](const std::string& more) { return error_of([&] { parse_turning(more); }); };
    check_message(refusal(R"(, "tilt": {"rate": "5 deg/s", "until": "200 deg"})"), {"/tilt/until", "180 deg"});
    check_message(refusal(R"(, "tilt": {"rate": "0 deg/s"})"), {"/tilt/rate"});
    check_message(refusal(R"(, "tilt": {"rate": "1 m/s"})"), {"/tilt/rate"});
    check_message(refusal(R"(, "tilt": {"about": "z", "rate": "1 deg/s"})"), {"/tilt/about"});
    check_message(refusal(R"(, "tilt": {"rate": "1 deg/s"}, "base_motion": {"signal": "step", "velocity": "1 m/s"})"), {"/tilt"});
    check_message(refusal(R"(, "base_motion": {"signal": "rocking", "angle": "2 deg", "frequency": "4 Hz", "cycles": 1})"),
                  {"/base_motion/cycles", "at least 2"});
    check_message(
        refusal(R"(, "base_motion": {"signal": "rocking", "direction": "x", "angle": "2 deg", "frequency": "4 Hz", "cycles": 3})"),
        {"/base_motion/direction"});
    check_message(
        refusal(R"(, "base_motion": {"signal": "sine", "direction": "ry", "amplitude": "1 g", "frequency": "4 Hz", "cycles": 3})"),
        {"/base_motion/direction"});
}
