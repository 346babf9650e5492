#include "lsdem/scene/material_presets.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "lsdem/scene/scale_scene.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/scene/made_scene.hpp"

using namespace musim;
using namespace musim::lsdem;

namespace {

Triple<scaling::Length> make_block(double b, double w, double height) {
    return {b * scaling::si::meter, w * scaling::si::meter, height * scaling::si::meter};
}

/// Bar wave speed c = H·√(k_n/m) of a stack of blocks [m/s].
double wave_speed(const BlockMaterial& material, const Triple<scaling::Length>& block) {
    const double mass = (material.density * block[0] * block[1] * block[2]).value();
    return block[2].value() * std::sqrt(material.normal_stiffness.value() / mass);
}

}  // namespace

// From Tables 2-4 of [Harmon23]
TEST_CASE("presets carry the wave speeds of the measured materials") {
    struct Case {
        const char* name;
        double divisor, height;  // scale and measured height [m]
        double speed;            // [m/s]
    };
    for (const Case& c : {Case{"wood", 107.0, 0.03978, 2110.3}, Case{"concrete", 25.0, 0.17053, 3546.5},
                          Case{"al_printed", 107.0, 0.03967, 1514.8}, Case{"aluminium", 107.0, 0.03967, 4790.3}}) {
        CAPTURE(std::string(c.name));
        const MaterialPreset& preset = find_material_preset(c.name);
        const auto block = make_block(1.36 / c.divisor, 2.82 / c.divisor, c.height);
        // five digits are printed
        CHECK(wave_speed(preset.material, block) == doctest::Approx(c.speed).epsilon(3e-5));
        CHECK(preset.length_scale == 1.0 / c.divisor);
    }
    CHECK(find_material_preset("aluminium").material == find_material_preset("al_wave").material);
}

TEST_CASE("the same solid in a larger block keeps its wave speed and becomes stiffer in proportion to its size") {
    const MaterialPreset& concrete = find_material_preset("concrete");
    const auto prototype = make_block(1.36, 2.82, 4.25);
    const BlockMaterial fitted = fit_to_block(concrete, prototype);
    // a few roundings
    CHECK(fitted.normal_stiffness.value() == doctest::Approx(25.0 * 1050e6).epsilon(1e-14));
    CHECK(fitted.shear_stiffness.value() == doctest::Approx(25.0 * 1000e6).epsilon(1e-14));
    CHECK(wave_speed(fitted, prototype) == doctest::Approx(wave_speed(concrete.material, concrete.reference_block)).epsilon(1e-14));
    CHECK(fitted.friction == concrete.material.friction);
    CHECK(fit_to_block(concrete, concrete.reference_block) == concrete.material);
}

// k_n = E A/H and k_s = G A/H of the block that the scene has: E by H k_n/A again
TEST_CASE("a stone has its elasticity in whatever block a scene has, and the numbers of its sources") {
    struct Case {
        const char* name;
        double density, youngs_modulus, poisson, angle;  // [kg/m³], [Pa], [-], basic friction angle [degrees]
    };
    for (const Case& c : {Case{"granite", 2650.0, 58.6e9, 0.26, 33.0}, Case{"limestone", 2700.0, 53.9e9, 0.32, 34.0},
                          Case{"marble", 2750.0, 55.8e9, 0.25, 34.0}}) {
        CAPTURE(std::string(c.name));
        for (const char* const material : {R"("%")", R"({"preset": "%", "restitution": 0.5})"}) {
            std::string text = material;
            text.replace(text.find('%'), 1, c.name);
            const Scene scene = parse_scene(R"({"schema": "musim-scene/1", "material": )" + text +
                                            R"(, "structure": {"kind": "column", "layers": 1, "block": ["0.2 m", "0.6 m", "0.3 m"]},
                 "time": {"duration": "1 s"}})");
            const double to_modulus = 0.3 / (0.2 * 0.6);  // H/A [1/m]
            CHECK(scene.material.density.value() == c.density);
            CHECK(scene.material.normal_stiffness.value() * to_modulus == doctest::Approx(c.youngs_modulus).epsilon(1e-12));
            CHECK(scene.material.shear_stiffness.value() * to_modulus ==
                  doctest::Approx(c.youngs_modulus / (2.0 * (1.0 + c.poisson))).epsilon(1e-12));
            // two digits are kept
            CHECK(scene.material.friction == doctest::Approx(std::tan(c.angle * std::acos(-1.0) / 180.0)).epsilon(0.01));
        }
        CHECK(find_material_preset(c.name).bar_wave_speed->value() == doctest::Approx(std::sqrt(c.youngs_modulus / c.density)));
    }
    // of a list the first block's
    const Scene list = parse_scene(R"({"schema": "musim-scene/1", "material": "granite", "structure": {"kind": "blocks", "blocks": [
        {"size": ["0.2 m", "0.6 m", "0.3 m"], "position": [0, 0, "0.15 m"]}, {"size": [1, 1, 1], "position": [3, 0, 0.5]}]},
        "time": {"duration": "1 s"}})");
    CHECK(list.material.normal_stiffness.value() == doctest::Approx(58.6e9 * 0.2 * 0.6 / 0.3).epsilon(1e-12));
    CHECK_THROWS_WITH_AS(
        parse_scene(R"({"schema": "musim-scene/1", "material": "granite", "structure": {"kind": "column", "layers": 1, "block": [1, 2, 3]},
            "time": {"duration": 1, "step": "camera"}})"),
        "scene: /time/step: \"camera\" is the step of the papers' tests, and granite is none of their materials; give a step or \"auto\"",
        SceneError);
}

TEST_CASE("an unknown material is refused with the known ones") {
    musim::lsdem::testing::check_message(musim::lsdem::testing::error_of([] { find_material_preset("basalt"); }),
                                         {"\"basalt\"", "wood", "concrete", "aluminium", "granite"});
}

TEST_CASE("a name that holds control characters is refused in one line") {
    const std::string given = musim::lsdem::testing::error_of([] {
        parse_scene(R"({"schema": "musim-scene/1", "material": "wood\n\u001b[31m",
                 "structure": {"kind": "column", "layers": 1, "block": [1, 2, 3]}, "time": {"duration": 1}})");
    });
    CHECK_MESSAGE(given.find("\"wood  [31m\" is not a known material") != std::string::npos, given);
}

// The papers' steps are a camera's period over a whole number: 1/4800 s over 20 and 80, 1/2000 s over 34.
TEST_CASE("a step \"camera\" is the preset's, scales like a given one, and needs a preset") {
    const auto parse = [](const std::string& material) {
        return parse_scene(
            R"({"schema": "musim-scene/1", "material": )" + material +
            R"(, "structure": {"kind": "column", "layers": 1, "block": [1, 2, 3]}, "time": {"duration": 1, "step": "camera"}})");
    };
    CHECK(parse(R"("wood")").time.step->value() == doctest::Approx(10.4166667e-6).epsilon(1e-8));
    CHECK(parse(R"({"preset": "concrete", "friction": 0.5})").time.step->value() == doctest::Approx(14.7058824e-6).epsilon(1e-8));
    const Scene aluminium = parse(R"("al_printed")");
    CHECK(aluminium.time.step->value() == doctest::Approx(2.60416667e-6).epsilon(1e-8));
    // λ_t = √λ_l
    const Scene twin = scale_scene(aluminium, scaling::make_similitude("mu", {.length = 1.0 / 16.0}));
    CHECK(twin.time.step->value() == aluminium.time.step->value() / 4.0);
    CHECK(parse_scene(write_scene(aluminium)) == aluminium);
    CHECK_THROWS_WITH_AS(
        parse(R"({"density": 1, "normal_stiffness": 1, "shear_stiffness": 1, "friction": 1, "restitution": 1})"),
        "scene: /time/step: \"camera\" is the step of a material preset, and the scene's material is none (presets are wood, concrete, "
        "aluminium, al_wave, al_printed, granite, limestone, marble); name one, or give a step or \"auto\"",
        SceneError);
}
