#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "lsdem/run/run.hpp"
#include "lsdem/scene/scale_scene.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/support/relative.hpp"

using namespace musim;
using namespace musim::lsdem;
using musim::lsdem::tests::relative;

namespace {

/// Density and face stiffness of a stone, and the base of the block that has it.
constexpr double kStoneDensity = 2300.0, kStoneStiffness = 4e6, kStoneBase = 0.2 * 0.1;  // [kg/m³], [N/m], [m²]

const std::string kStoneText =
    R"({"density": 2300, "normal_stiffness": 4e6, "shear_stiffness": 1.6e6, "friction": 0.6, "restitution": 0.4})";

Scene parse_stones(const std::string& blocks, const std::string& more = "") {
    return parse_scene(R"({"schema": "musim-scene/1", "material": )" + kStoneText + R"(, "structure": {"kind": "blocks", "blocks": [)" +
                       blocks + R"(]}, "time": {"duration": 0.002}, "output": {"spine_rate": 1000},
                       "preparation": {"placing": "as_drawn"})" +
                       more + "}");
}

}  // namespace

// A face of pressure ρ g H on springs of K per area sinks by s = ρ g H/K, whatever its area; where a depth is that below a side, half of s
// is lost along every edge: s (1/b + 1/w)/2 of the area, 1.7e-4 at most.
TEST_CASE("blocks of one stone sink alike, whatever their length") {
    const RunResult run = run_scene(parse_stones(R"({"size": [0.2, 0.1, 0.1], "position": [0, 0, 0.05]},
        {"size": [0.1, 0.1, 0.1], "position": [0.3, 0, 0.05]}, {"size": [0.8, 0.1, 0.1], "position": [1, 0, 0.05]})"));
    const double sink = kStoneDensity * scaling::kStandardGravity.value() * 0.1 / (kStoneStiffness / kStoneBase);
    for (const Vector3& position : run.initial.position) {
        CHECK(0.05 - position.z() == relative(sink, 3e-4));
    }
}

// Its half of the interface in series with the ground's, which is of the scene's material: K = 2 K_a K_b/(K_a + K_b).
TEST_CASE("a block of another material sinks by both sides of its contact") {
    const RunResult run = run_scene(parse_stones(
        R"({"size": [0.2, 0.1, 0.1], "position": [0, 0, 0.05]}, {"size": [0.3, 0.1, 0.1], "position": [1, 0, 0.05], "material": "iron"})",
        R"(, "materials": {"iron": {"density": 7800, "normal_stiffness": 12e6, "shear_stiffness": 12e6, "friction": 0.6,
                                    "restitution": 0.4}})"));
    const double stiffness = 2.0 * kStoneStiffness * 3.0 * kStoneStiffness / (4.0 * kStoneStiffness) / kStoneBase;
    const double sink = 7800.0 * scaling::kStandardGravity.value() * 0.1 / stiffness;
    CHECK(0.05 - run.initial.position[1].z() == relative(sink, 3e-4));
}

namespace {

/// A flat block that slides under gravity with a slope of 1: of granite (μ = 0.2) on the ground, on a fixed block of the scene's material
/// (μ = 0.6) or of steel (μ = 0.9).
Scene make_slide(const std::string& below, const std::string& more) {
    const std::string slider = R"({"size": [0.4, 0.2, 0.1], "material": "granite", "position": [0, 0, )";
    const std::string bed = R"({"size": [4, 1, 0.1], "position": [0, 0, 0.05], "fixed": true)";
    std::string blocks = slider + "0.05]}";
    if (!below.empty()) blocks = bed + (below == "material" ? "" : R"(, "material": ")" + below + "\"") + "}, " + slider + "0.15]}";
    return parse_scene(R"({"schema": "musim-scene/1", "gravity": [9.81, 0, -9.81],
        "material": {"density": 2300, "normal_stiffness_per_area": "0.3 GPa/m", "shear_stiffness_per_area": "0.2 GPa/m",
                     "friction": 0.6, "restitution": 0.4},
        "materials": {"granite": {"density": 2600, "normal_stiffness_per_area": "0.3 GPa/m", "shear_stiffness_per_area": "0.2 GPa/m",
                                  "friction": 0.2, "restitution": 0.1},
                      "steel": {"density": 7800, "normal_stiffness_per_area": "1 GPa/m", "shear_stiffness_per_area": "1 GPa/m",
                                "friction": 0.9, "restitution": 0.1}},
        "structure": {"kind": "blocks", "blocks": [)" +
                       blocks + R"(]}, "time": {"duration": 0.25}, "output": {"spine_rate": 100}, "preparation": "none")" + more + "}");
}

}  // namespace

// Elementary dynamics: a = g_x − μ g_z, x = a t²/2.
TEST_CASE("a block slides with the friction of its pair") {
    struct Case {
        std::string below, more;
        double friction;
    };
    const std::string ground = R"(, "ground": {"friction": 0.7})", steel = R"({"of": ["steel", "granite"], "friction": 0.5})",
                      on_ground = R"({"of": ["granite", "ground"], "friction": 0.4})";
    for (const Case& c : {Case{"", "", 0.2}, Case{"", ground, 0.7}, Case{"", ground + R"(, "pairs": [)" + on_ground + "]", 0.4},
                          Case{"material", "", 0.2}, Case{"steel", "", 0.2}, Case{"steel", R"(, "pairs": [)" + steel + "]", 0.5}}) {
        CAPTURE(c.below);
        CAPTURE(c.more);
        const RunResult run = run_scene(make_slide(c.below, c.more));
        const double time = run.history.time.back(), slid = run.final.position.back().x() - run.initial.position.back().x();
        // until springs of K_s hold all of the friction the block gains up to μ g/ω_s, ω_s² = K_s/(ρ H)
        const double gained = c.friction * 9.81 * std::sqrt(2600.0 * 0.1 / 0.2e9);
        CHECK(std::abs(slid - 0.5 * (1.0 - c.friction) * 9.81 * time * time) < gained * time);
    }
}

TEST_CASE("a scene with pairs and stiffnesses per area is its twin at 1:16, bit for bit") {
    const Scene scene = make_slide("steel", R"(, "pairs": [{"of": ["steel", "granite"], "friction": 0.5, "restitution": 0.3,
                                                             "normal_stiffness_per_area": "0.7 GPa/m"}])");
    const RunResult run = run_scene(scene), twin = run_scene(scale_scene(scene, scaling::make_similitude("exact", {.length = 1.0 / 16.0})));
    CHECK(Vector3(16.0 * twin.final.position.back()) == run.final.position.back());
    CHECK(4.0 * twin.history.time.back() == run.history.time.back());
}
