#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>

#include "lsdem/scene/scale_scene.hpp"
#include "lsdem/scene/scene_error.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "lsdem/study/tilt.hpp"
#include "scaling/laws/law_similitude.hpp"

using namespace musim::lsdem;
using musim::scaling::kDegree;

namespace {

constexpr double kDensity = 2000.0;  // [kg/m³]
constexpr double kStiffness = 2e9;   // K [Pa/m]

/// A scene of a structure without a base motion; lengths in metres, joints as stiff as kStiffness.
Scene make_tilted(const std::string& structure, double friction = 0.8, const std::string& more = {}) {
    return parse_scene(fmt::format(R"({{"schema": "musim-scene/1", "name": "tilted", "structure": {}, {}
        "material": {{"density": "{} kg/m^3", "normal_stiffness_per_area": "{} Pa/m", "shear_stiffness_per_area": "{} Pa/m",
                     "friction": {}, "restitution": 0.3}},
        "time": {{"duration": "1 s"}}, "output": {{"spine_rate": "100 Hz"}}}})",
                                   structure, more, kDensity, kStiffness, kStiffness, friction),
                       "tilt_test");
}

/// A column along z of boxes b × w × h.
std::string make_tilted_column(int layers, double b, double w, double h) {
    return fmt::format(R"({{"kind": "column", "layers": {}, "block": ["{} m", "{} m", "{} m"]}})", layers, b, w, h);
}

TiltSettings settings_of(double step, double tolerance, const Vector3& axis = Vector3::UnitY()) {
    return {.axis = axis, .step = step * kDegree, .until = 60.0 * kDegree, .tolerance = tolerance * kDegree};
}

/// tan of the angle at which a rigid body of height H and base b × w overturns on the springs of its base: (b − a)/H, where the length a on
/// which it bears at last follows from a³ = 6 H N/(K w), see calibration/tilt_test.hpp. Exact to a/(3H) of a/b.
double find_overturning_on_springs(double b, double w, double height) {
    double tangent = b / height;
    for (int i = 0; i < 10; ++i) {
        const double load = kDensity * 9.80665 * b * w * height * std::cos(std::atan(tangent));
        tangent = (b - std::cbrt(6.0 * height * load / (kStiffness * w))) / height;
    }
    return tangent;
}

}  // namespace

TEST_CASE("a slender block on a tilting table overturns at atan b/h, less what its springs give way") {
    const TiltCollapse result = find_tilt_of_collapse(make_tilted(make_tilted_column(1, 0.2, 0.3, 0.8)), settings_of(4.0, 0.125));
    REQUIRE(result.high.has_value());
    const double expected = std::atan(find_overturning_on_springs(0.2, 0.3, 0.8));
    CHECK(std::abs(result.angle() - expected) < result.error() + 0.01 * expected);
    CHECK(result.angle() < std::atan(0.2 / 0.8));
    CHECK(result.statics.value_or(0.0) == doctest::Approx(std::atan(0.25)).epsilon(1e-4));
    REQUIRE(result.fall.has_value());
    CHECK(result.fall->sentence == "block 0 overturns about the downhill edge on the ground");
}

TEST_CASE("a squat block on a tilting table slides at atan mu, whichever way the table turns") {
    for (const Vector3& axis : {Vector3(-Vector3::UnitX()), Vector3(0.6, 0.8, 0.0)}) {
        const TiltCollapse result =
            find_tilt_of_collapse(make_tilted(make_tilted_column(1, 0.5, 0.5, 0.2), 0.3), settings_of(8.0, 0.25, axis));
        REQUIRE(result.high.has_value());
        // nothing of a rigid block that slides gives way
        CHECK(result.low < std::atan(0.3) + 1e-3);
        CHECK(std::abs(result.angle() - std::atan(0.3)) < result.error() + 2e-4);
        REQUIRE(result.fall.has_value());
        CHECK(result.fall->sentence == "block 0 slides on the ground");
    }
}

TEST_CASE("a wall tilted out of its plane overturns at atan t/H, less what its springs give way") {
    const std::string wall = R"({"kind": "wall", "layers": 2, "blocks_per_layer": 1, "block": ["0.2 m", "0.4 m", "0.4 m"]})";
    const TiltCollapse result = find_tilt_of_collapse(make_tilted(wall), settings_of(8.0, 0.25, Vector3::UnitX()));
    REQUIRE(result.high.has_value());
    const double expected = std::atan(find_overturning_on_springs(0.2, 0.4, 0.8));
    // it stands on one face of 0.2 x 0.4 m; its head joints bear nothing
    CHECK(std::abs(result.angle() - expected) < result.error() + 0.02 * expected);
    REQUIRE(result.fall.has_value());
    CHECK(result.fall->sentence == "blocks 0 to 2, as one body, overturn about the downhill edge on the ground");
}

TEST_CASE("what slides on a block that stays is named") {
    // the upper block slides on the lower one at atan 0.2, before that slides on the ground at atan 0.5
    const std::string blocks = R"({"kind": "blocks", "blocks": [
        {"name": "plinth", "size": ["0.6 m", "0.6 m", "0.2 m"], "position": ["0 m", "0 m", "0.1 m"]},
        {"name": "capstone", "size": ["0.4 m", "0.4 m", "0.1 m"], "position": ["0 m", "0 m", "0.25 m"]}]})";
    const TiltCollapse result = find_tilt_of_collapse(make_tilted(blocks, 0.2, R"("ground": {"friction": 0.5},)"), settings_of(4.0, 0.25));
    REQUIRE(result.high.has_value());
    CHECK(std::abs(result.angle() - std::atan(0.2)) < result.error() + 2e-4);
    REQUIRE(result.fall.has_value());
    CHECK(result.fall->sentence == "capstone slides on plinth");
    const nlohmann::json object = to_json(result);
    CHECK(object["mechanism"]["bodies"] == 1);
    CHECK(object["mechanism"]["body_of_block"] == nlohmann::json({0, 1}));
    CHECK(object["collapses"] == true);
    CHECK(make_fall_svg(result, "blocks").starts_with("<svg"));
}

TEST_CASE("a model falls at the angle of its prototype, every try the same to the bit at 1:16") {
    const Scene prototype = make_tilted(make_tilted_column(2, 0.2, 0.3, 0.3));
    const TiltSettings settings = settings_of(8.0, 1.0);
    const TiltCollapse large = find_tilt_of_collapse(prototype, settings);
    const TiltCollapse small =
        find_tilt_of_collapse(scale_scene(prototype, musim::scaling::make_similitude("exact", {.length = 1.0 / 16.0})), settings);
    REQUIRE(large.high.has_value());
    CHECK(small.high == large.high);
    CHECK(small.steps == large.steps);
    REQUIRE(small.tries.size() == large.tries.size());
    for (std::size_t i = 0; i < large.tries.size(); ++i) {
        CHECK(small.tries[i].angle == large.tries[i].angle);
        CHECK(small.tries[i].speed == large.tries[i].speed);
    }
    REQUIRE((small.fall.has_value() && large.fall.has_value()));
    CHECK(small.fall->sentence == large.fall->sentence);
    CHECK(16.0 * small.fall->place[1].position.x() == large.fall->place[1].position.x());
}

TEST_CASE("a structure that stands up to the largest angle has none of collapse") {
    TiltSettings settings = settings_of(5.0, 1.0);
    settings.until = 8.0 * kDegree;
    const TiltCollapse result = find_tilt_of_collapse(make_tilted(make_tilted_column(1, 0.5, 0.5, 0.2)), settings);
    CHECK_FALSE(result.high.has_value());
    CHECK(result.low == settings.until);
    CHECK_FALSE(result.fall.has_value());
    CHECK(to_json(result)["angle_deg"].is_null());
}

TEST_CASE("scenes and settings that cannot be tilted are refused in one line") {
    const std::string block = make_tilted_column(1, 0.5, 0.5, 0.2);
    const auto refused = [](const Scene& scene) {
        try {
            find_tilt_of_collapse(scene);
        } catch (const SceneError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK(refused(make_tilted(block, 0.8, R"("base_motion": {"signal": "step", "direction": "x", "velocity": "1 m/s"},)"))
              .find("the scene shakes its structure") != std::string::npos);
    CHECK(refused(make_tilted(block, 0.8, R"("gravity": ["1 m/s^2", "0 m/s^2", "-9.8 m/s^2"],)")).find("/gravity") != std::string::npos);
    CHECK(refused(make_tilted(block, 0.8, R"("ground": {"present": false},)")).find("there is nothing to tilt") != std::string::npos);
    const auto listed = [](const std::string& more, const std::string& x) {
        return make_tilted(R"({"kind": "blocks", "blocks": [{"size": ["0.2 m", "0.2 m", "0.2 m"], "position": ["0 m", "0 m", "0.1 m"]},
            {"size": ["0.2 m", "0.2 m", "0.2 m"], "position": [")" +
                           x + R"( m", "0 m", "0.3 m"])" + more + "}]}");
    };
    CHECK(refused(listed(R"(, "fixed": true)", "0")).find("held in place") != std::string::npos);
    CHECK(refused(listed("", "0.15")).find("does not stand on level ground") != std::string::npos);

    TiltSettings settings;
    settings.step = 0.0;
    CHECK(check_tilt(settings).starts_with("the step is 0 degrees"));
    settings = {.axis = Vector3::UnitY(), .step = 0.01, .until = 1.6};
    CHECK(check_tilt(settings).find("at most 90") != std::string::npos);
    settings = {.axis = Vector3::UnitY(), .step = 0.01, .until = 1.0, .tolerance = 1e-12};
    CHECK(check_tilt(settings).find("rounding") != std::string::npos);
    CHECK_THROWS_AS(find_tilt_of_collapse(make_tilted(block), settings), std::invalid_argument);
}

TEST_SUITE("slow") {
    TEST_CASE("a column of ten blocks overturns as one body about its lowest edge") {
        const TiltCollapse result = find_tilt_of_collapse(make_tilted(make_tilted_column(10, 0.4, 0.4, 0.15)), settings_of(8.0, 0.25));
        REQUIRE(result.high.has_value());
        const double expected = std::atan(find_overturning_on_springs(0.4, 0.4, 1.5));
        // joints above give way as well: those of the lowest blocks, whose load and moment are nearly the same, by a part of the base's
        CHECK(result.low < expected);
        CHECK(std::abs(result.angle() - expected) < result.error() + 0.02 * expected);
        REQUIRE(result.fall.has_value());
        CHECK(result.fall->sentence == "blocks 0 to 9, as one body, overturn about the downhill edge on the ground");
    }
}
