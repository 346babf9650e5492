#include <doctest/doctest.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lsdem/contact_law.hpp"
#include "lsdem/scene/build_model.hpp"
#include "lsdem/scene/scale_scene.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/scene/made_scene.hpp"

using namespace musim;
using namespace musim::lsdem;
using namespace musim::lsdem::testing;

namespace {

/// Blocks of granite and steel on a ground of the scene's material; `pairs` is the list.
std::string make_paired_text(const std::string& pairs, const std::string& more = "") {
    return R"({"schema": "musim-scene/1",
        "material": {"density": 2000, "normal_stiffness_per_area": "2 GPa/m", "shear_stiffness_per_area": "1 GPa/m", "friction": 0.5,
                     "restitution": 0.4},
        "materials": {
            "granite": {"density": 2600, "normal_stiffness": 6e7, "shear_stiffness": 3e7, "friction": 0.7, "restitution": 0.5},
            "steel": {"density": 7800, "normal_stiffness": 2e8, "shear_stiffness": 8e7, "friction": 0.4, "restitution": 0.6,
                      "shear_damping_ratio": 0.1},
            "oak": {"density": 700, "normal_stiffness": 1e7, "shear_stiffness": 8e6, "friction": 0.6, "restitution": 0.3}},
        "structure": {"kind": "blocks", "blocks": [{"size": [0.2, 0.1, 0.1], "position": [0, 0, 0.05], "material": "granite"},
                                                   {"size": [0.4, 0.1, 0.1], "position": [0, 0, 0.15], "material": "steel"},
                                                   {"size": [0.1, 0.1, 0.1], "position": [1, 0, 0.05]}]},
        "pairs": )" +
           pairs + more + R"(, "time": {"duration": 1}})";
}

const std::string kPairs = R"([{"of": ["granite", "steel"], "friction": 0.3, "restitution": 0.2, "normal_stiffness_per_area": "7 GPa/m"},
                               {"of": ["ground", "material"], "friction": 0.9, "shear_damping_ratio": 0.2}])";

std::string refusal_of(const std::string& text) {
    return error_of([&] { parse_scene(text); });
}

std::string preset_text(const std::string& sizes) { return make_scene_text(R"({"kind": "blocks", "blocks": [)" + sizes + "]}"); }

}  // namespace

TEST_CASE("a stiffness per area is that of a whole face over the base of the first block, to the bit where it is a number") {
    const auto parse = [](const std::string& stiffness) {
        return parse_scene(R"({"schema": "musim-scene/1", "material": {"density": 2000, "friction": 0.5, "restitution": 0.4, )" +
                           stiffness +
                           R"(}, "structure": {"kind": "column", "layers": 2, "block": [0.5, 0.25, 1]}, "time": {"duration": 1}})");
    };
    const Scene of_face = parse(R"("normal_stiffness": 4194304, "shear_stiffness": "1 MN/m")");
    CHECK(parse(R"("normal_stiffness_per_area": 33554432, "shear_stiffness_per_area": "8 MPa/m")") == of_face);
    CHECK(make_model(of_face).materials[0].normal_stiffness == 33554432.0);

    for (const auto& [stiffness, words] : std::vector<std::pair<std::string, std::vector<std::string>>>{
             {R"("normal_stiffness": 1, "normal_stiffness_per_area": 1, "shear_stiffness": 1)",
              {"/material/normal_stiffness_per_area: \"normal_stiffness\" is given as well", "leave one of the two out"}},
             {R"("normal_stiffness": 1)", {"/material", "shear_stiffness"}},
             {R"("normal_stiffness_per_area": "0 Pa/m", "shear_stiffness": 1)", {"/material/normal_stiffness_per_area: 0 Pa/m (must be"}},
             {R"("normal_stiffness_per_area": "1 MN/m", "shear_stiffness": 1)", {"/material/normal_stiffness_per_area", "GPa/m"}}}) {
        check_message(error_of([&, &given = stiffness] { parse(given); }), words);
    }
}

TEST_CASE("a preset keeps the stiffness per area of its own block where listed blocks have several bases") {
    const double measured = 30e6 / (1.36 * 2.82 / (107.0 * 107.0)), of_first = 30e6 / 0.02;
    const std::string block = R"({"size": [0.2, 0.1, 0.1], "position": [0, 0, 0.05]})",
                      longer = R"(, {"size": [0.8, 0.1, 0.1], "position": [1, 0, 0.05]})",
                      like = R"(, {"size": ["20 cm", "100 mm", 0.2], "position": [1, 0, 0.1]})";
    const auto stiffness = [&](const std::string& blocks) {
        return make_model(parse_scene(preset_text(blocks))).materials[0].normal_stiffness;
    };
    // a few roundings
    CHECK(stiffness(block + longer) == doctest::Approx(measured).epsilon(1e-14));
    // one base has the preset's stiffness, as columns, walls and towers have
    CHECK(stiffness(block) == doctest::Approx(of_first).epsilon(1e-14));
    CHECK(stiffness(block + like) == stiffness(block));

    Scene scene = parse_scene(preset_text(block + longer));
    CHECK(parse_scene(write_scene(scene)) == scene);
}

TEST_CASE("the table of pairs decides how two materials meet, and the ground's friction on it") {
    const Model model = make_model(parse_scene(make_paired_text(kPairs, R"(, "ground": {"friction": 0.8})")));
    REQUIRE(model.materials.size() == 3);
    const std::size_t granite = model.blocks[0].material, steel = model.blocks[1].material, own = model.blocks[2].material;
    const Material stacked = find_joint(model, steel, granite);
    CHECK(stacked.friction == 0.3);
    CHECK(stacked.restitution == 0.2);
    CHECK(stacked.normal_stiffness == doctest::Approx(7e9).epsilon(1e-15));
    // what the pair does not give follows from the two: half a block of each in series, the larger damping
    CHECK(stacked.shear_stiffness == doctest::Approx(2.0 * 3e7 * 8e7 / 11e7 / 0.02).epsilon(1e-14));
    CHECK(stacked.shear_damping_ratio == 0.1);
    CHECK(find_joint(model, own, std::nullopt).friction == 0.9);
    CHECK(find_joint(model, own, std::nullopt).shear_damping_ratio == 0.2);
    CHECK(find_joint(model, granite, std::nullopt).friction == 0.8);
    CHECK(find_joint(model, steel, own).friction == 0.4);

    // without a friction of its own the ground is of the scene's material
    const Model plain = make_model(parse_scene(make_paired_text("[]")));
    CHECK(plain.pairs.empty());
    CHECK(find_joint(plain, plain.blocks[0].material, std::nullopt).friction == 0.5);
    CHECK(find_joint(plain, plain.blocks[1].material, std::nullopt).friction == 0.4);
}

TEST_CASE("pairs are written and read back, and scale as materials do") {
    const Scene scene = parse_scene(make_paired_text(kPairs));
    CHECK(parse_scene(write_scene(scene)) == scene);
    for (const auto& similitude : {scaling::make_similitude("exact", {.length = 1.0 / 16.0, .density = 0.5}),
                                   scaling::make_similitude("mu", {.length = 1.0 / 16.0, .friction = 0.25})}) {
        const Model model = make_model(scene), twin = make_model(scale_scene(scene, similitude));
        REQUIRE(twin.pairs.size() == 2);
        for (std::size_t k = 0; k < 2; ++k) {
            const double factor = similitude.factor<scaling::StiffnessPerArea>();
            CHECK(twin.pairs[k].joint.normal_stiffness == model.pairs[k].joint.normal_stiffness * factor);
            CHECK(twin.pairs[k].joint.shear_stiffness == model.pairs[k].joint.shear_stiffness * factor);
            CHECK(twin.pairs[k].joint.friction == model.pairs[k].joint.friction * similitude.friction());
            CHECK(twin.pairs[k].joint.restitution == model.pairs[k].joint.restitution);
        }
    }
}

TEST_CASE("a pair that means nothing is refused in one line") {
    for (const auto& [pairs, words] : std::vector<std::pair<std::string, std::vector<std::string>>>{
             {R"([{"of": ["granite", "stel"], "friction": 1}])", {"/pairs/0/of/1: \"stel\" is not among", "did you mean \"steel\"?"}},
             {R"([{"of": ["granite", "steel"], "friction": 1}, {"of": ["granite", "steel"], "friction": 1}])",
              {"/pairs/1/of", "are a pair already", "/pairs/0", "keep one"}},
             {R"([{"of": ["granite", "steel"], "friction": 1}, {"of": ["steel", "granite"], "friction": 0.2}])",
              {"/pairs/1/of: \"steel\" and \"granite\" are a pair already", "/pairs/0"}},
             {R"([{"of": ["steel", "steel"], "friction": 1}])", {"/pairs/0/of: \"steel\" twice", "name two"}},
             {R"([{"of": ["steel", "ground"]}])", {"/pairs/0: no property"}},
             {R"([{"of": ["steel"], "friction": 1}])", {"/pairs/0/of: two names"}},
             {R"([{"of": ["steel", "ground"], "friction": -1}])", {"/pairs/0/friction: -1 (must not be negative)"}},
             {R"([{"of": ["steel", "ground"], "restitution": 2}])", {"/pairs/0/restitution: 2"}},
             {R"([{"of": ["steel", "ground"], "normal_stiffness": 1, "normal_stiffness_per_area": 1}])",
              {"/pairs/0/normal_stiffness_per_area"}},
             {R"([{"of": ["steel", "ground"], "fricton": 1}])", {"/pairs/0/fricton: unknown key"}},
             {R"({"of": ["steel", "ground"]})", {"/pairs: a list"}}}) {
        check_message(refusal_of(make_paired_text(pairs)), words);
    }
    check_message(refusal_of(make_paired_text(R"([{"of": ["steel", "ground"], "friction": 1}])", R"(, "ground": {"present": false})")),
                  {"/pairs/0/of/1: there is no ground"});
    std::string named = make_paired_text(R"([{"of": ["granite", "ground"], "friction": 1}])");
    named.replace(named.find("\"oak\""), 5, "\"ground\"");
    check_message(refusal_of(named), {"\"ground\" is the plane, and a key of /materials as well"});
}

TEST_CASE("what changes nothing about pairs and the ground is remarked") {
    const Scene idle = parse_scene(make_paired_text(R"([{"of": ["granite", "oak"], "friction": 0.3}])"));
    REQUIRE(idle.text.remarks.size() == 1);
    CHECK(idle.text.remarks[0].find("/pairs/0: nothing is of \"oak\"") != std::string::npos);
    const Scene floating = parse_scene(make_scene_text(kColumn, R"(, "ground": {"present": false, "friction": 0.6})"));
    REQUIRE(floating.text.remarks.size() == 1);
    CHECK(floating.text.remarks[0].find("/ground/friction: there is no ground") != std::string::npos);
}
