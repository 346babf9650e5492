#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "lsdem/scene/detail/absent_features.hpp"
#include "tests/scene/made_scene.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::testing;

namespace {

/// A column of one block of a material.
std::string make_column(const std::string& material, const std::string& block = R"(["0.1 m", "0.2 m", "0.1 m"])",
                        const std::string& more = "") {
    return R"({"schema": "musim-scene/1", "material": {)" + material + R"(, "restitution": 0.5, "normal_stiffness": "1 GN/m",
        "shear_stiffness": "0.4 GN/m"}, "structure": {"kind": "column", "layers": 1, "block": )" +
           block + "}" + more + R"(, "time": {"duration": "1 s"}})";
}

const std::string kSound = R"("density": "2650 kg/m^3", "friction": 0.6)";

bool has_remark(const Scene& scene, const std::string& part) {
    return std::any_of(scene.text.remarks.begin(), scene.text.remarks.end(),
                       [&](const std::string& remark) { return remark.find(part) != std::string::npos; });
}

}  // namespace

TEST_CASE("values of a scene that are hardly meant get a word with their place, and sound ones get none") {
    struct Case {
        std::string text, word;
    };
    const std::string record = R"(, "base_motion": {"record": "a.txt", "components": {"x": "1"}, "scale": {"length": %}})";
    const auto scaled = [&](const std::string& length) { return std::string(record).replace(record.find('%'), 1, length); };
    for (const Case& c :
         {Case{make_column(R"("density": 2.65, "friction": 0.6)"),
               "scene: /material/density: 2.65 kg/m^3 is lighter than any wood or stone"},
          Case{make_column(R"("density": "26.5", "friction": 0.6)"), "write the unit, \"26.5 kN/m^3\""},
          Case{make_column(R"("density": "2650 kg/m^3", "friction": 30)"),
               "scene: /material/friction: 30 is taken as the coefficient of friction; of an angle of 30 degrees write its tangent, 0.577"},
          Case{make_column(kSound, R"(["0.1 m", "0.2 m", "0.1 m"])", R"(, "ground": {"friction": 35})"), "scene: /ground/friction: 35 is"},
          Case{make_column(kSound, R"(["100", "200", "100"])"),
               "scene: /structure/block/0: an edge is 100 m long; of millimetres write \"100 mm\""},
          Case{make_column(kSound, R"(["0.1 m", "0.2 m", "0.1 m"])", R"(, "gravity": "-9.81 m/s^2")"), "scene: /gravity: points upwards"},
          Case{make_column(kSound, R"(["0.1 m", "0.2 m", "0.1 m"])", R"(, "gravity": [0, 0, 9.81])"), "scene: /gravity: points upwards"},
          Case{make_column(kSound, R"(["0.1 m", "0.2 m", "0.1 m"])", scaled("20")),
               "scene: /base_motion/scale/length: 20 makes the model larger than the prototype; a model at 1:20 is 1/20"}}) {
        CAPTURE(c.word);
        const Scene scene = parse_scene(c.text);
        REQUIRE(scene.text.remarks.size() == 1);
        CHECK_MESSAGE(has_remark(scene, c.word), scene.text.remarks.front());
    }
    for (const std::string& sound : {make_column(kSound), make_column(R"("density": "80 kg/m^3", "friction": 1.2)"),
                                     make_column(R"("density": "2650 kg/m^3", "friction": 1e9)"),
                                     make_column(kSound, R"(["1.36 m", "2.82 m", "20.6 m"])", R"(, "gravity": "50 g")"),
                                     make_column(kSound, R"(["0.1 m", "0.2 m", "0.1 m"])", scaled("\"1/20\""))}) {
        CHECK(parse_scene(sound).text.remarks.empty());
    }
}

TEST_CASE("a text without a unit is a plain number like a number") {
    CHECK(parse_scene(make_column(kSound, R"(["100", "0.2 m", "0.1 m"])")).text.plain_number == "/structure/block/0");
    CHECK(parse_scene(make_column(kSound, R"(["1/10", "0.2 m", "0.1 m"])")).text.plain_number == "/structure/block/0");
    CHECK(parse_scene(make_column(kSound)).text.plain_number.empty());
}

// ρ = γ/g, g the standard gravity also where the scene has another: 26/9.80665 = 2.65126
TEST_CASE("a unit weight is taken as a density, and the scene says so") {
    for (const char* const gravity : {"", R"(, "gravity": "50 g")"}) {
        for (const char* const weight : {"26 kN/m^3", "0.026 MN/m3", "26000 N/m^3"}) {
            CAPTURE(weight);
            const Scene scene = parse_scene(
                make_column(R"("density": ")" + std::string(weight) + R"(", "friction": 0.6)", R"(["0.1 m", "0.2 m", "0.1 m"])", gravity));
            CHECK(scene.material.density.value() == doctest::Approx(26000.0 / 9.80665).epsilon(1e-12));
            REQUIRE(scene.text.notes.size() == 1);
            CHECK(scene.text.notes.front() ==
                  "scene: /material/density: a unit weight, taken as 2651.26 kg/m^3 (over standard gravity, 9.80665 m/s^2)");
            CHECK(scene.text.plain_number.empty());
            CHECK(parse_scene(write_scene(scene)) == scene);
        }
    }
    CHECK_THROWS_AS(parse_scene(make_column(R"("density": "26 kN/m^2", "friction": 0.6)")), SceneError);
}

TEST_CASE("a key for what musim has not says so, with where its limits are written, and a mistyped one gets the nearest") {
    struct Case {
        const char *key, *what;
    };
    for (const Case& c :
         {Case{"cohesion", "musim has no contact that bears tension"}, Case{"mortar_strength", "musim has no mortar"},
          Case{"tensileStrength", "musim has no contact that bears tension"}, Case{"springs", "musim has no connection between blocks"},
          Case{"prestress", "musim has no connection between blocks"}, Case{"damper", "musim has no damper"},
          Case{"rolling_friction", "musim has no friction but Coulomb's"}, Case{"friction_angle", "tangent of the friction angle"},
          Case{"youngs_modulus", "\"normal_stiffness\" is E A/H"}, Case{"poissons_ratio", "musim has no block that bends or breaks"}}) {
        CAPTURE(c.key);
        const std::string text = make_column(kSound + ", \"" + c.key + "\": 1");
        check_message(
            error_of([&] { parse_scene(text); }),
            {"scene: /material/" + std::string(c.key) + ": unknown key \"" + c.key + "\": ", c.what, "see Limits, docs/theory/limits.md"});
    }
    for (const char* const key : {"fluid", "water_level", "reinforcement", "soil", "wind", "temperature"}) {
        CAPTURE(key);
        check_message(error_of([&] { parse_scene(make_column(kSound, R"([1, 1, 1])", std::string(", \"") + key + "\": {}")); }),
                      {"scene: /" + std::string(key), "musim has no ", "docs/theory/limits.md"});
    }
    // of the same matter as a known key that is spelled like it
    check_message(error_of([] { parse_scene(make_column(kSound, "[1, 1, 1]", R"(, "preparation": {"damping_rat": 5})")); }),
                  {"/preparation/damping_rat: unknown key", "did you mean \"damping_rate\"?"});
    for (const char* const known : {"densty", "frction", "colour"}) CHECK_FALSE(detail::describe_absent_feature(known));
}

TEST_CASE("a stiffness shared per contact is refused with the reason") {
    for (const char* const sharing : {"per_contact", "per_area"}) {
        check_message(error_of([&] {
                          parse_scene(make_column(kSound, "[1, 1, 1]", R"(, "contact": {"stiffness": ")" + std::string(sharing) + "\"}"));
                      }),
                      {"scene: /contact/stiffness: ", "no potential", "leave it out"});
    }
}
