#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <utility>

#include "tests/cli/program.hpp"

using musim::cli::Outcome;
using musim::cli::Workplace;

namespace {

/// A column of six blocks under a pulse, with pictures.
constexpr const char* kScene = R"({"schema": "musim-scene/1", "name": "column", "material": "wood",
    "structure": {"kind": "column", "layers": 6, "block": ["12.710 mm", "26.355 mm", "39.720 mm"]},
    "base_motion": {"signal": "ricker", "direction": "x", "amplitude": "0.2 g", "frequency": "200 Hz"},
    "time": {"duration": "10 ms"}, "output": {"spine_rate": "20 kHz", "frame_rate": "500 Hz"}})";

}  // namespace

TEST_CASE("calibrate stiffness finds the stiffness of a target speed and writes its curves") {
    const Workplace place;
    const Outcome found = place.run("calibrate stiffness --material wood --layers 20 --speed-normal 2110 --json -o out");
    REQUIRE(found.exit_code == 0);
    const auto normal = found.json()["directions"][0];
    const double closed_form = normal["search"]["closed_form_stiffness_n_m"];
    // the effective speed is H·√(k/m) to 5e-5
    CHECK(normal["search"]["stiffness_n_m"].get<double>() == doctest::Approx(closed_form).epsilon(1e-4));
    CHECK_FALSE(found.json()["directions"][1].contains("search"));
    CHECK(place.has("out/wave_normal.svg"));
    CHECK(place.has("out/wave_shear.csv"));

    const Outcome aluminium = place.run("calibrate stiffness --material al_printed --layers 20 --json");
    CHECK(aluminium.json()["bar_speed_verdict"].get<std::string>().ends_with("does not fit it"));

    // E and nu stand for sqrt(E/rho) and sqrt(G/rho)
    const Outcome solid = place.run("calibrate stiffness --material wood --layers 20 --youngs-modulus 3.2e9 --poisson 0.25 --json");
    CHECK(solid.json()["directions"][0]["search"]["target_m_s"].get<double>() == doctest::Approx(2000.0));
    CHECK(solid.json()["directions"][1]["search"]["target_m_s"].get<double>() == doctest::Approx(std::sqrt(1.28e9 / 800.0)));
}

TEST_CASE("calibrate presets lists every preset with its source, and the camera step of those of the papers") {
    const Workplace place;
    const Outcome listed = place.run("calibrate presets --json");
    REQUIRE(listed.exit_code == 0);
    const auto presets = listed.json()["presets"];
    REQUIRE(presets.size() == 8);
    CHECK(presets[0]["name"] == "wood");
    CHECK(presets[5]["name"] == "granite");
    // 1/4800 s over 20
    CHECK(presets[0]["camera_step_s"].get<double>() == doctest::Approx(10.416667e-6).epsilon(1e-7));
    CHECK(presets[1]["camera_step_s"].get<double>() == doctest::Approx(14.705882e-6).epsilon(1e-7));
    for (std::size_t i = 0; i < presets.size(); ++i) {
        CHECK(presets[i]["camera_step_s"].is_null() == (i >= 5));
        CHECK(presets[i]["length_scale"].is_null() == (i >= 5));
        CHECK(presets[i]["source"].get<std::string>().size() > 20);
    }
    const std::string text = place.run("calibrate presets").out;
    CHECK(text.find("Table 3") != std::string::npos);
    CHECK(text.find("Barton and Choubey 1977") != std::string::npos);
}

TEST_CASE("calibrate refuses what cannot be, in one line") {
    const Workplace place;
    // what the command line alone shows to be wrong, and what does not fit the material
    for (const auto& [code, bad] : {std::pair{2, "calibrate stiffness --material cheese"},
                                    {2, "calibrate friction --material wood --friction -1"},
                                    {3, "calibrate restitution --material wood --angles 80"},
                                    {2, "calibrate restitution --material wood --restitutions 2"}}) {
        const Outcome outcome = place.run(bad);
        CHECK_MESSAGE(outcome.exit_code == code, outcome.err);
        CHECK(outcome.has_one_error_line());
    }
    CHECK(place.run("calibrate").exit_code == 2);
    CHECK(place.run("calibrate stiffness").exit_code == 2);
    CHECK(place.run("calibrate stiffness --material wood --layers 3").exit_code == 2);
}

TEST_CASE("response reports a run and draws what a camera saw") {
    const Workplace place;
    place.write("scene.json", kScene);
    REQUIRE(place.run("run scene.json -o out").exit_code == 0);
    const Outcome outcome = place.run("response out --field 0.004 0.006 -o pictures --json");
    REQUIRE(outcome.exit_code == 0);
    const auto json = outcome.json();
    CHECK(json["axis"] == "x");
    CHECK(json["speeds"].size() == 4);
    CHECK(json["spine"].size() == 4);
    CHECK(json["levels"].size() == 6);
    CHECK(json["fields"].size() == 2);
    CHECK(place.has("pictures/residual.svg"));
    CHECK(place.has("pictures/" + json["fields"][1]["picture"].get<std::string>()));
    CHECK_FALSE(json["fields"][1].contains("grid"));
    CHECK(place.run("response out").out.find("damage index") != std::string::npos);
}

TEST_CASE("response refuses what is no run, and leaves nothing half-written") {
    const Workplace place;
    Outcome outcome = place.run("response nowhere");
    CHECK(outcome.exit_code == 3);
    CHECK(outcome.has_one_error_line());
    place.write("scene.json", kScene);
    std::string without(kScene);
    without.erase(without.find(", \"frame_rate\": \"500 Hz\""), std::string(", \"frame_rate\": \"500 Hz\"").size());
    place.write("plain.json", without);
    REQUIRE(place.run("run plain.json -o out").exit_code == 0);
    outcome = place.run("response out --field 0.001 -o pictures");
    CHECK(outcome.exit_code == 3);
    CHECK(outcome.has_one_error_line());
    CHECK_FALSE(place.has("pictures"));
}
