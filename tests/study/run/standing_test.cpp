#include "lsdem/run/standing.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lsdem/run/equilibrium.hpp"
#include "lsdem/run/run.hpp"
#include "lsdem/run/scale_specimen.hpp"
#include "lsdem/run/scene_summary.hpp"
#include "lsdem/scene/build_model.hpp"
#include "lsdem/scene/new_scene.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "lsdem/statics/linear_program.hpp"
#include "lsdem/statics/overturning.hpp"
#include "lsdem/statics/rigid_joints.hpp"
#include "scaling/laws/law_similitude.hpp"

using namespace musim::lsdem;
using nlohmann::json;
using Answer = RigidStatics::Answer;
using Begins = SceneStanding::Begins;

namespace {

json make_block(const std::vector<double>& size, const std::vector<double>& position) { return {{"size", size}, {"position", position}}; }

json lean(json block, double degrees) {
    const double half = degrees * std::acos(-1.0) / 360.0;
    block["quaternion"] = {std::cos(half), 0.0, std::sin(half), 0.0};
    return block;
}

json hold(json block) {
    block["fixed"] = true;
    return block;
}

/// Listed blocks of stone on a base that hardly moves.
Scene make_listed(const std::vector<json>& blocks, double friction = 0.6) {
    json scene = json::parse(R"({"schema": "musim-scene/1", "name": "listed",
        "material": {"density": 2000, "normal_stiffness": 2e10, "shear_stiffness": 1.6e10, "restitution": 0.3},
        "base_motion": {"signal": "sine", "amplitude": "0.4 g", "frequency": "5 Hz", "cycles": 1, "direction": "x"},
        "time": {"duration": "0.1 s"}, "output": {"spine_rate": "100 Hz"}})");
    scene["material"]["friction"] = friction;
    scene["structure"] = {{"kind", "blocks"}, {"blocks", blocks}};
    return parse_scene(scene.dump(), "standing_test");
}

/// Blocks of 200 x 100 x 60 mm, each as far out as the ones above it allow, times `part`.
std::vector<json> make_overhang(std::size_t blocks, double part) {
    std::vector<json> list{make_block({0.2, 0.1, 0.06}, {0.0, 0.0, 0.03})};
    double x = 0.0;
    for (std::size_t k = 1; k < blocks; ++k) {
        x += part * 0.1 / static_cast<double>(blocks - k);
        list.push_back(make_block({0.2, 0.1, 0.06}, {x, 0.0, 0.03 + 0.06 * static_cast<double>(k)}));
    }
    return list;
}

/// A cube on a slope of a fixed block.
std::vector<json> make_slope(double tangent) {
    const double angle = std::atan(tangent), degrees = angle * 180.0 / std::acos(-1.0);
    return {hold(lean(make_block({0.6, 0.3, 0.1}, {0.0, 0.0, 0.5}), degrees)),
            lean(make_block({0.1, 0.1, 0.1}, {0.1 * std::sin(angle), 0.0, 0.5 + 0.1 * std::cos(angle)}), degrees)};
}

/// A cube that stands on an edge, leaning by so much.
std::vector<json> make_on_edge(double degrees) {
    const double height = 0.1 * std::sqrt(0.5) * std::cos(degrees * std::acos(-1.0) / 180.0);
    return {lean(make_block({0.1, 0.1, 0.1}, {0.0, 0.0, height}), 45.0 + degrees)};
}

std::vector<json> make_stack(std::size_t blocks, double step, double gap = 0.0) {
    std::vector<json> list;
    for (std::size_t k = 0; k < blocks; ++k) {
        const auto i = static_cast<double>(k);
        list.push_back(make_block({0.1, 0.1, 0.1}, {step * i, 0.0, 0.05 + (0.1 + gap) * i}));
    }
    return list;
}

RigidStatics ask(const std::vector<json>& blocks, double friction = 0.6) {
    return ask_rigid_statics(make_upright_specimen(make_listed(blocks, friction)).model);
}

std::optional<double> find_estimate(const SceneSummary& summary, const std::string& key) {
    for (const SceneEstimate& each : summary.estimates) {
        if (each.key == key) return each.value;
    }
    return std::nullopt;
}

std::string find_text(const SceneSummary& summary, const std::string& key) {
    for (const SceneEstimate& each : summary.estimates) {
        if (each.key == key) return each.text;
    }
    return "";
}

}  // namespace

TEST_CASE("rigid statics says what can stand of structures whose limit is known") {
    if (!has_linear_programs()) return;
    const json pier = make_block({0.1, 0.1, 0.3}, {0.0, 0.0, 0.15}), other = make_block({0.1, 0.1, 0.3}, {0.6, 0.0, 0.15});
    struct Case {
        std::string what;
        std::vector<json> blocks;
        double friction;
        Answer answer;
    };
    const std::vector<Case> cases{
        // [PatersonZwick09]: (L/2) sum 1/k
        {"overhang of 4, 0.99", make_overhang(4, 0.99), 0.6, Answer::can_stand},
        {"overhang of 4, 1.01", make_overhang(4, 1.01), 0.6, Answer::cannot_stand},
        {"lintel on piers", {pier, other, make_block({0.66, 0.1, 0.08}, {0.3, 0.0, 0.34})}, 0.6, Answer::can_stand},
        {"lintel short of a pier", {pier, other, make_block({0.4, 0.1, 0.08}, {0.26, 0.0, 0.34})}, 0.6, Answer::cannot_stand},
        // tan = friction
        {"slope that holds", make_slope(0.39), 0.4, Answer::can_stand},
        {"slope within the polygon around the circle", make_slope(0.404), 0.4, Answer::undecided},
        {"slope that slides", make_slope(0.42), 0.4, Answer::cannot_stand},
        // five cubes above the first: their centre is 3 steps out
        {"leaning stack", make_stack(6, 0.0165), 0.6, Answer::can_stand},
        {"stack that leans too far", make_stack(6, 0.0168), 0.6, Answer::cannot_stand},
        {"a gap that counts as contact", make_stack(2, 0.0, 1e-5), 0.6, Answer::can_stand},
        {"a gap that does not", make_stack(2, 0.0, 1e-4), 0.6, Answer::cannot_stand},
        {"on its edge", make_on_edge(0.0), 0.6, Answer::can_stand},
        {"beside its edge", make_on_edge(1.0), 0.6, Answer::cannot_stand},
        // friction bears it at any thrust of 1/(2 mu) of its weight or more; that there is one is more than is asked
        {"a cube between fixed ones",
         {hold(make_block({0.1, 0.1, 0.1}, {0.0, 0.0, 0.5})), make_block({0.1, 0.1, 0.1}, {0.1, 0.0, 0.5}),
          hold(make_block({0.1, 0.1, 0.1}, {0.2, 0.0, 0.5}))},
         0.6,
         Answer::can_stand},
    };
    for (const Case& each : cases) {
        CAPTURE(each.what);
        CHECK(ask(each.blocks, each.friction).answer == each.answer);
    }
}

TEST_CASE("rigid statics says what is missing to a block") {
    if (!has_linear_programs()) return;
    // its centre 0.12 m out, its support 0.1 m
    const RigidStatics overhang = ask({make_block({0.2, 0.1, 0.06}, {0.0, 0.0, 0.03}), make_block({0.2, 0.1, 0.06}, {0.12, 0.0, 0.09})});
    REQUIRE(overhang.needs.size() == 1);
    CHECK(overhang.each_alone);
    CHECK(overhang.needs[0].block == 1);
    CHECK(overhang.needs[0].arm == doctest::Approx(0.02).epsilon(1e-6));
    CHECK(overhang.needs[0].force < 1e-9);
    CHECK(describe(overhang) == "block 1 cannot stand where it is drawn: its weight acts 20 mm beside what could bear it");
    // pushed along the horizontal: tan(slope - friction angle)
    const RigidStatics slope = ask(make_slope(0.5), 0.4);
    REQUIRE(slope.needs.size() == 1);
    CHECK(slope.needs[0].force == doctest::Approx((0.5 - 0.4) / (1.0 + 0.5 * 0.4)).epsilon(1e-6));
    const RigidStatics hanging = ask(make_stack(2, 0.0, 0.01));
    REQUIRE(hanging.needs.size() == 1);
    CHECK_FALSE(hanging.needs[0].touches);
    CHECK(hanging.needs[0].force == doctest::Approx(1.0));
    // each cube stands on the one below, all together do not
    const RigidStatics stack = ask(make_stack(6, 0.03));
    CHECK_FALSE(stack.each_alone);
    CHECK(stack.needs.size() >= 1);
}

TEST_CASE("rigid statics does not decide on blocks that meet edge along edge") {
    if (!has_linear_programs()) return;
    // two boards of 0.3 x 0.03 m lean together at 60 degrees, their upper edges in one line: stable at a friction of 1/(2 tan 60) and more
    const double angle = std::acos(-1.0) / 3.0, reach = 0.15 * std::cos(angle) + 0.015 * std::sin(angle),
                 height = 0.15 * std::sin(angle) + 0.015 * std::cos(angle);
    const double top = 0.15 * std::cos(angle) - 0.015 * std::sin(angle), apart = std::max(reach, top);
    const std::vector<json> boards{lean(make_block({0.3, 0.1, 0.03}, {-apart, 0.0, height}), -60.0),
                                   lean(make_block({0.3, 0.1, 0.03}, {apart, 0.0, height}), 60.0)};
    const RigidStatics statics = ask(boards);
    CHECK(statics.answer == Answer::undecided);
    CHECK(describe(statics) ==
          "whether rigid blocks can stand where they are drawn is undecided: blocks meet edge along edge, where forces have no plane");
}

TEST_CASE("a beam over a gap is not in equilibrium where it is drawn, and is left there") {
    // two piers, the second lower by 0.3 mm; the beam's middle is 0.15 m beside the first
    const json beam = make_block({0.66, 0.1, 0.05}, {0.3, 0.0, 0.325});
    const Scene scene =
        make_listed({make_block({0.1, 0.1, 0.3}, {0.1, 0.0, 0.15}), make_block({0.1, 0.1, 0.2997}, {0.6, 0.0, 0.14985}), beam});
    Specimen specimen = make_upright_specimen(scene);
    const SceneStanding standing = find_standing(scene, specimen);
    CHECK(standing.begins == Begins::out_of_equilibrium);
    CHECK(put_in_equilibrium(specimen, compute_time_step(scene, specimen.model).value()).residual > kInEquilibrium);
    CHECK(specimen.model.blocks[0].orientation.coeffs() == Quaternion::Identity().coeffs());
}

TEST_CASE("a block that cannot stand is called by its name") {
    if (!has_linear_programs()) return;
    json beam = make_block({0.2, 0.1, 0.06}, {0.12, 0.0, 0.09});
    beam["name"] = "lintel";
    const Scene scene = make_listed({make_block({0.2, 0.1, 0.06}, {0.0, 0.0, 0.03}), beam});
    const SceneStanding standing = find_standing(scene, make_upright_specimen(scene));
    REQUIRE(standing.statics);
    CHECK(describe(*standing.statics, standing.blocks) ==
          "block 1 (\"lintel\") cannot stand where it is drawn: its weight acts 20 mm beside what could bear it");
    CHECK(to_json(standing)["statics"]["needs"][0]["label"] == "lintel");
}

TEST_CASE("rigid statics is the same at every scale and weight") {
    if (!has_linear_programs()) return;
    const auto scaled = [](const Specimen& specimen, double length) {
        return scale_specimen(specimen, musim::scaling::make_similitude("exact", {.length = length})).model;
    };
    for (const double length : {0.25, 1.0 / 25.0, 1.0 / 107.0, 1e-3, 37.0}) {
        CAPTURE(length);
        for (const double part : {0.99, 1.01}) {
            Specimen overhang = make_upright_specimen(make_listed(make_overhang(3, part)));
            const RigidStatics here = ask_rigid_statics(overhang.model);
            const RigidStatics there = ask_rigid_statics(scaled(overhang, length));
            CHECK(here.answer == there.answer);
            REQUIRE(here.needs.size() == there.needs.size());
            for (std::size_t k = 0; k < here.needs.size(); ++k) {
                CHECK(there.needs[k].block == here.needs[k].block);
                CHECK(there.needs[k].arm == doctest::Approx(length * here.needs[k].arm).epsilon(1e-6));
            }
        }
        // a portal is statically indeterminate, and half of its equations say what the other half does
        const Specimen portal =
            make_upright_specimen(make_listed({make_block({0.1, 0.1, 0.3}, {0.0, 0.0, 0.15}), make_block({0.1, 0.1, 0.3}, {0.6, 0.0, 0.15}),
                                               make_block({0.66, 0.1, 0.08}, {0.3, 0.0, 0.34})}));
        CHECK(*find_steady_acceleration(scaled(portal, length), Vector3::UnitX()) ==
              doctest::Approx(*find_steady_acceleration(portal.model, Vector3::UnitX())).epsilon(1e-9));
    }
}

TEST_CASE("rigid statics is as sure of light blocks beside heavy ones") {
    if (!has_linear_programs()) return;
    // two cubes, the lower or the upper one `part` as heavy as the other
    const auto make_two = [](bool light_below, double part, double out) {
        Model model = make_upright_specimen(make_listed(make_stack(2, out))).model;
        model.blocks[light_below ? 0 : 1].mass *= part;
        return model;
    };
    for (const double part : {1.0, 1e-3, 1e-6}) {
        CAPTURE(part);
        const double centre = (0.15 + 0.05 * part) / (1.0 + part);
        CHECK(*find_steady_acceleration(make_two(true, part, 0.0), Vector3::UnitX()) == doctest::Approx(0.05 / centre));
        CHECK(ask_rigid_statics(make_two(true, part, 0.049)).answer == Answer::can_stand);
        CHECK(ask_rigid_statics(make_two(false, part, 0.049)).answer == Answer::can_stand);
        const RigidStatics falls = ask_rigid_statics(make_two(false, part, 0.051));
        REQUIRE(falls.needs.size() == 1);
        CHECK(falls.needs[0].arm == doctest::Approx(0.001).epsilon(1e-4));
    }
    const RigidStatics beyond = ask_rigid_statics(make_two(true, 1e-7, 0.0));
    CHECK(beyond.answer == Answer::not_asked);
    CHECK(beyond.why == "its heaviest block weighs 1e+07 times its lightest, more than 1e+06");
}

TEST_CASE("a steady acceleration is that at which blocks slide or overturn") {
    if (!has_linear_programs()) return;
    const Model low = make_upright_specimen(make_listed({make_block({0.3, 0.1, 0.1}, {0.0, 0.0, 0.05})})).model;
    CHECK(*find_steady_acceleration(low, Vector3::UnitX()) == doctest::Approx(0.6));
    CHECK(*find_steady_acceleration(low, Vector3::UnitY()) == doctest::Approx(0.6));
    // a column of 12 overturns at b/(N H)
    const Model column = make_upright_specimen(make_listed(make_stack(12, 0.0))).model;
    CHECK(*find_steady_acceleration(column, -Vector3::UnitX()) == doctest::Approx(1.0 / 12.0));
    // a cube that overhangs too far stands only where the base pushes it back
    const Model leaning = make_upright_specimen(make_listed(make_stack(2, 0.06))).model;
    CHECK(find_steady_acceleration(leaning, Vector3::UnitX()));
    CHECK_FALSE(find_steady_acceleration(leaning, -Vector3::UnitX()));
}

TEST_CASE("a structure overturns as one body at the least of all its level joints") {
    const Model column = make_upright_specimen(make_listed(make_stack(12, 0.0))).model;
    CHECK(*find_overturning(column, 0) == doctest::Approx(1.0 / 12.0));
    // a fifth as wide from the eighth on: those 5 overturn before the whole
    std::vector<json> stack = make_stack(7, 0.0);
    for (int k = 7; k < 12; ++k) stack.push_back(make_block({0.02, 0.1, 0.1}, {0.0, 0.0, 0.05 + 0.1 * k}));
    const Model narrow = make_upright_specimen(make_listed(stack)).model;
    CHECK(*find_overturning(narrow, 0) == doctest::Approx(0.01 / 0.25));
    // centre of mass of 7 cubes of weight 1 and 5 of 0.2
    const double centre = (7.0 * 0.35 + 1.0 * 0.95) / 8.0;
    CHECK(*find_overturning(narrow, 1) == doctest::Approx(std::min(0.05 / centre, 0.05 / 0.25)));
    // two columns are two bodies
    std::vector<json> two = make_stack(4, 0.0);
    for (int k = 0; k < 4; ++k) two.push_back(make_block({0.1, 0.1, 0.1}, {1.0, 0.0, 0.05 + 0.1 * k}));
    CHECK(*find_overturning(make_upright_specimen(make_listed(two)).model, 0) == doctest::Approx(0.25));
    const auto of_layers = [](const NewScene& made, int axis) {
        const Specimen specimen = make_upright_specimen(make_new_scene(made));
        return *find_overturning_of_layers(specimen.model, specimen.layer, axis);
    };
    const Specimen wall = make_upright_specimen(make_new_scene({.kind = "wall", .layers = 6}));
    const Vector3 half = wall.model.shapes[0].half_extents;
    // courses with half blocks at their ends are lighter, by a joint: 1e-3 of the height of the centre
    CHECK(of_layers({.kind = "wall", .layers = 6}, 1) == doctest::Approx(std::min(half.x(), half.y()) / (6.0 * half.z())).epsilon(1e-3));
    const Specimen tall = make_upright_specimen(make_new_scene({.kind = "column", .layers = 5}));
    CHECK(of_layers({.kind = "column", .layers = 5}, 0) ==
          doctest::Approx(tall.model.shapes[0].half_extents.x() / (5.0 * tall.model.shapes[0].half_extents.z())));
}

TEST_CASE("estimates of first motion are of the structure where it overturns before a block") {
    // cubes rock above 1 g, slide above 0.6 g; twelve of them overturn above 1/12 g
    const SceneSummary stack = summarize_scene(make_listed(make_stack(12, 0.0)));
    CHECK(*find_estimate(stack, "overturning_x") == doctest::Approx(1.0 / 12.0));
    CHECK(find_text(stack, "first_motion_thin") == "rocks");
    CHECK(find_text(summarize_scene(make_listed(make_stack(1, 0.0))), "first_motion_thin") == "rests");
    const SceneSummary falls = summarize_scene(make_listed(make_stack(2, 0.06)));
    CHECK_FALSE(find_estimate(falls, "overturning_x"));
}

TEST_CASE("a check finds a structure in equilibrium where a run does") {
    struct Case {
        std::string what;
        std::vector<json> blocks;
        Begins begins;
    };
    const std::vector<Case> cases{{"overhang, 0.99", make_overhang(2, 0.99), Begins::in_equilibrium},
                                  {"overhang, 1.05", make_overhang(2, 1.05), Begins::out_of_equilibrium},
                                  {"stack", make_stack(3, 0.01), Begins::in_equilibrium},
                                  {"slope", make_slope(0.5), Begins::in_equilibrium},
                                  {"hanging", make_stack(2, 0.0, 1e-4), Begins::out_of_equilibrium}};
    for (const Case& each : cases) {
        CAPTURE(each.what);
        Scene scene = make_listed(each.blocks);
        CHECK(find_standing(scene, make_upright_specimen(scene)).begins == each.begins);
        const bool unmoved = make_specimen(scene).model.preload.empty();
        CHECK(unmoved == (each.begins == Begins::out_of_equilibrium));
    }
}

TEST_CASE("what is laid, taken from a file or thrown is not asked whether it stands as drawn") {
    const auto standing_of = [](const Scene& scene) { return find_standing(scene, make_upright_specimen(scene)); };
    Scene uneven = make_new_scene({.kind = "wall", .layers = 3});
    CHECK(standing_of(uneven).begins == Begins::in_equilibrium);
    std::get<Wall>(uneven.structure).height_deviation = musim::scaling::Length::from_value(1e-4);
    const SceneStanding laid = standing_of(uneven);
    CHECK(laid.begins == Begins::when_laid);
    CHECK_FALSE(laid.statics);
    Scene thrown = make_listed(make_stack(2, 0.0, 0.1));
    std::get<BlockList>(thrown.structure).blocks[1].velocity[0] = musim::scaling::Velocity::from_value(1.0);
    CHECK(standing_of(thrown).begins == Begins::as_listed);
    CHECK_FALSE(standing_of(thrown).statics);
}

TEST_CASE("equilibrium is found where friction slides on the way to it") {
    // a stiff lintel on courses of softer blocks: each solve takes a seventh off what is left
    const std::filesystem::path scene = std::filesystem::path(MUSIM_SOURCE_DIR) / "../shared/cases/scenes/check_says_equilibrium.json";
    if (!std::filesystem::exists(scene)) {
        MESSAGE("skipped: there is no ", scene.string());
        return;
    }
    const SceneSummary summary = summarize_scene(read_scene(scene));
    CHECK(summary.standing.begins == Begins::in_equilibrium);
    CHECK(summary.standing.equilibrium->solves > 30);
    const json written = to_json(summary);
    CHECK(written["standing"]["begins"] == "in_equilibrium");
}
