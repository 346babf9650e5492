#include "lsdem/scene/build_model.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "lsdem/time_step.hpp"
#include "tests/scene/made_scene.hpp"

using namespace musim;
using namespace musim::lsdem;
using namespace musim::lsdem::testing;

TEST_CASE("a column stands block on block without gap or overlap") {
    const BuiltModel built = build_model(parse_scene(make_scene_text(kColumn)));
    const Model& model = built.model;
    REQUIRE(model.blocks.size() == 3);
    CHECK(model.shapes.size() == 1);
    CHECK(model.materials.size() == 1);
    const double height = 0.03978;
    for (std::size_t k = 0; k < 3; ++k) {
        CHECK(model.blocks[k].position == Vector3(0.0, 0.0, height * (static_cast<double>(k) + 0.5)));
        CHECK(model.blocks[k].orientation.coeffs() == Quaternion::Identity().coeffs());
    }
    CHECK(built.structure.layer == std::vector<int>{1, 2, 3});
    CHECK(built.structure.spine.block == std::vector<std::size_t>{0, 2});
    CHECK(built.structure.spine.level == std::vector<int>{1, 3});
}

TEST_CASE("mass is density times volume and the stiffness of a face is spread over its area") {
    const Model model = make_model(parse_scene(make_scene_text(kColumn)));
    const double area = 0.01271 * 0.026355;
    CHECK(model.blocks[0].mass == doctest::Approx(800.0 * area * 0.03978).epsilon(1e-14));
    CHECK(model.materials[0].normal_stiffness == doctest::Approx(30e6 / area).epsilon(1e-14));
    CHECK(model.materials[0].shear_stiffness == doctest::Approx(26e6 / area).epsilon(1e-14));
    CHECK(model.materials[0].friction == 0.63);
    CHECK(model.materials[0].restitution == 0.3);
    CHECK(model.ground.material.normal_stiffness == model.materials[0].normal_stiffness);
    CHECK(model.ground.present);
    CHECK(model.gravity == Vector3(0.0, 0.0, -9.80665));
    CHECK(model.numerics.contact_nodes == ContactNodes::leader);
    CHECK(model.numerics.face_contact == FaceContact::overlap);
}

TEST_CASE("the ground may have its own friction or be absent, and both sides may probe") {
    const Model model = make_model(
        parse_scene(make_scene_text(kColumn, R"(, "ground": {"friction": 0.2}, "contact": {"nodes": "both", "faces": "nodes"})")));
    CHECK(model.ground.material.friction == 0.2);
    CHECK(model.materials[0].friction == 0.63);
    CHECK(model.numerics.contact_nodes == ContactNodes::both);
    CHECK(model.numerics.face_contact == FaceContact::nodes);
    CHECK_FALSE(make_model(parse_scene(make_scene_text(kColumn, R"(, "ground": {"present": false})"))).ground.present);
}

TEST_CASE("every block of a tower rests on exactly two blocks below, with joints between neighbors") {
    const BuiltModel built = build_model(parse_scene(make_scene_text(kTower)));
    const Model& model = built.model;
    REQUIRE(model.blocks.size() == 4 * 14);
    CHECK(model.shapes.size() == 1);
    // footprints as boxes along x and y, from each block's own rotation
    const auto half_plan = [&](const Block& block) { return Vector3((block.orientation * model.shapes[0].half_extents).cwiseAbs()); };
    for (std::size_t k = 0; k < model.blocks.size(); ++k) {
        const int layer = built.structure.layer[k];
        CHECK(layer == static_cast<int>(k / 14) + 1);
        CHECK(model.blocks[k].position.z() == 0.03978 * (layer - 0.5));
        int supports = 0;
        for (std::size_t other = 0; other < model.blocks.size(); ++other) {
            if (other == k) continue;
            const Vector3 reach = half_plan(model.blocks[k]) + half_plan(model.blocks[other]);
            const Vector3 apart = (model.blocks[k].position - model.blocks[other].position).cwiseAbs();
            const bool plans_meet = apart.x() < reach.x() && apart.y() < reach.y();
            if (built.structure.layer[other] == layer) CHECK_FALSE(plans_meet);
            if (built.structure.layer[other] == layer - 1 && plans_meet) ++supports;
        }
        CHECK(supports == (layer == 1 ? 0 : 2));
    }
}

TEST_CASE("the spine of a tower is one vertical line on the outer face, every second layer") {
    const BuiltModel built = build_model(parse_scene(make_scene_text(kTower)));
    const Spine& spine = built.structure.spine;
    CHECK(spine.level == std::vector<int>{1, 3, 4});
    CHECK(spine.line() == 2);
    CHECK(spine.has_top);
    const Vector3 low = built.model.blocks[spine.block[0]].position;
    const Vector3 high = built.model.blocks[spine.block[1]].position;
    CHECK(built.structure.layer[spine.block[1]] == 3);
    CHECK(low.head<2>() == high.head<2>());
    for (std::size_t k = 0; k < 14; ++k) CHECK(built.model.blocks[k].position.x() <= low.x());

    // where the top layer is even, its block nearest above the line comes last
    const auto apart = [&](std::size_t b) { return (built.model.blocks[b].position - high).head<2>().norm(); };
    CHECK(built.structure.layer[spine.block[2]] == 4);
    for (std::size_t b = 0; b < built.model.blocks.size(); ++b) {
        if (built.structure.layer[b] == 4) CHECK(apart(b) >= apart(spine.block[2]) * (1.0 - 1e-12));
    }
}

TEST_CASE("an odd number of layers needs no other top than the spine's line") {
    for (const char* const structure : {R"({"kind": "column", "layers": 5, "block": ["1 m", "2 m", "3 m"]})",
                                        R"({"kind": "wall", "layers": 5, "blocks_per_layer": 3, "block": ["1 m", "2 m", "3 m"]})"}) {
        const BuiltModel built = build_model(parse_scene(make_scene_text(structure)));
        CHECK_FALSE(built.structure.spine.has_top);
        CHECK(built.structure.spine.level == std::vector<int>{1, 3, 5});
    }
}

TEST_CASE("the full tower has 7144 blocks on a pitch of 1.435 m") {
    const std::string text = R"({"kind": "tower", "block": ["1.36 m", "2.82 m", "4.25 m"]})";
    const BuiltModel built = build_model(parse_scene(make_scene_text(text)));
    CHECK(built.model.blocks.size() == 7144);
    CHECK(built.structure.spine.line() == 19);
    CHECK(built.structure.spine.level[18] == 37);
    CHECK(built.structure.spine.level.back() == 38);
    double radius = 0.0;
    for (const Block& block : built.model.blocks) radius = std::max(radius, block.position.head<2>().norm());
    // block centres lie within the outer radius of the cells
    CHECK(radius < 12.59 * 1.435);
    CHECK(radius > 11.5 * 1.435);
}

TEST_CASE("a wall is a running bond closed by half blocks of the same stiffness per area") {
    const BuiltModel built = build_model(parse_scene(make_scene_text(kWall)));
    const Model& model = built.model;
    REQUIRE(model.blocks.size() == 2 * 3 + 2 * 4);
    CHECK(model.shapes.size() == 2);
    CHECK(model.materials.size() == 1);
    CHECK(built.structure.layer == std::vector<int>{1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 4, 4, 4, 4});

    const double pitch = 0.026355 * (1.435 / 2.82);
    const auto half_length = [&](std::size_t k) { return model.shapes[model.blocks[k].shape].half_extents.y(); };
    for (const std::size_t first : {std::size_t{0}, std::size_t{3}}) {
        const std::size_t last = first == 0 ? 2 : 6;
        // both courses end at the same faces and leave the same joints
        CHECK(model.blocks[first].position.x() - half_length(first) == doctest::Approx(-2.0 * pitch - 0.026355 / 2).epsilon(1e-12));
        CHECK(model.blocks[last].position.x() + half_length(last) == doctest::Approx(2.0 * pitch + 0.026355 / 2).epsilon(1e-12));
        for (std::size_t k = first; k < last; ++k) {
            const double joint = model.blocks[k + 1].position.x() - half_length(k + 1) - model.blocks[k].position.x() - half_length(k);
            CHECK(joint == doctest::Approx(2.0 * pitch - 0.026355).epsilon(1e-9));
        }
    }
}

TEST_CASE("explicit blocks keep their state, their material and their shape") {
    const BuiltModel built = build_model(parse_scene(make_scene_text(kBlocks, kSteel)));
    const Model& model = built.model;
    REQUIRE(model.blocks.size() == 2);
    CHECK(model.shapes.size() == 1);
    CHECK(model.blocks[0].fixed);
    CHECK_FALSE(model.blocks[1].fixed);
    CHECK(model.blocks[0].mass == doctest::Approx(7850.0 * 0.006).epsilon(1e-14));
    CHECK(model.blocks[1].mass == doctest::Approx(800.0 * 0.006).epsilon(1e-14));
    CHECK(model.materials[model.blocks[0].material].normal_stiffness == doctest::Approx(2e9 / 0.02).epsilon(1e-14));
    CHECK(model.materials[model.blocks[0].material].shear_damping_ratio == 0.05);
    CHECK(model.blocks[1].velocity == Vector3(0.1, 0.0, 0.0));
    CHECK(model.blocks[1].angular_velocity == Vector3(0.0, 0.0, 2.0));
    CHECK(model.blocks[1].orientation.norm() == doctest::Approx(1.0).epsilon(1e-15));
    CHECK(model.blocks[1].orientation.w() == doctest::Approx(2.0 / std::sqrt(5.0)).epsilon(1e-15));
    CHECK(built.structure.layer == std::vector<int>{0, 0});
    CHECK(built.structure.spine.level == std::vector<int>{1, 2});
}

TEST_CASE("grid level sets and spheres are built") {
    const Model grid =
        make_model(parse_scene(make_scene_text(kColumn, R"(, "shape": {"kind": "box", "level_set": "grid", "voxel": "0.65 mm"})")));
    CHECK(std::holds_alternative<GridLevelSet>(grid.shapes[0].level_set));
    const Model sphere =
        make_model(parse_scene(make_scene_text(R"({"kind": "blocks", "blocks": [{"position": [0, 0, "10 cm"]}]})",
                                               R"(, "shape": {"kind": "sphere", "radius": "10 cm", "nodes": 50, "voxel": "1 cm"})")));
    CHECK(sphere.shapes[0].nodes.size() == 50);
}

TEST_CASE("boxes that meet by nodes have as many on a face as the scene says, half blocks at the same distances") {
    const Model model = make_model(
        parse_scene(make_scene_text(kWall, R"(, "shape": {"kind": "box", "nodes_per_face": 45}, "contact": {"faces": "nodes"})")));
    REQUIRE(model.shapes.size() == 2);
    const NodeLattice whole = make_node_lattice({12.71, 26.355, 39.78}, 45);
    CHECK(whole.nx * whole.ny == 45);
    // half blocks come first where a wall begins with whole ones, or second: the longer is the whole one
    const Shape& longer = model.shapes[model.shapes[0].half_extents.y() > model.shapes[1].half_extents.y() ? 0 : 1];
    const Shape& shorter = model.shapes[&longer == &model.shapes[0] ? 1 : 0];
    CHECK(longer.nodes.size() == make_box_shape({12.71, 26.355, 39.78}, whole).nodes.size());
    CHECK(shorter.nodes.size() == make_box_shape({12.71, 13.0, 39.78}, {whole.nx, whole.ny / 2 + 1, whole.nz}).nodes.size());
}

TEST_CASE("nodes that do not fit the face are refused with a number that does") {
    check_message(error_of([] {
                      make_model(parse_scene(make_scene_text(kColumn, R"(, "shape": {"kind": "box", "nodes_per_face": 43},
                                                                              "contact": {"faces": "nodes"})")));
                  }),
                  {"scene: /shape", "43", "use "});
}

TEST_CASE("blocks that overlap at the start are refused: which two, and by how much") {
    const auto stack = [](const std::string& height) {
        return parse_scene(make_scene_text(R"({"kind": "blocks", "blocks": [
            {"size": [1, 1, 1], "position": [5, 0, 0.5]}, {"size": [1, 1, 1], "position": [0, 0, 0.5]},
            {"size": [1, 1, 1], "position": [0.2, 0, )" +
                                           height + "]}]}"));
    };
    CHECK_NOTHROW(make_model(stack("1.5")));
    check_message(error_of([&] { make_model(stack("1.488")); }), {"/structure/blocks/1 and /structure/blocks/2 overlap by 12 mm"});
}

TEST_CASE("blocks that reach below the ground are refused unless there is none or they are fixed") {
    const auto sunk = [](const std::string& more, const std::string& scene_more) {
        return parse_scene(
            make_scene_text(R"({"kind": "blocks", "blocks": [{"size": [1, 1, 1], "position": [0, 0, "49 cm"])" + more + "}]}", scene_more));
    };
    check_message(error_of([&] { make_model(sunk("", "")); }), {"/structure/blocks/0 reaches 10 mm below the ground"});
    CHECK_NOTHROW(make_model(sunk(R"(, "fixed": true)", "")));
    CHECK_NOTHROW(make_model(sunk("", R"(, "ground": {"present": false})")));
}

TEST_CASE("the automatic time step is the safety times the critical step, a given one is kept") {
    Scene scene = parse_scene(make_scene_text(kColumn));
    const Model model = make_model(scene);
    CHECK(compute_time_step(scene, model).value() == 0.8 * compute_critical_time_step(model));
    scene.time.step = scaling::Time::from_value(1e-6);
    CHECK(compute_time_step(scene, model).value() == 1e-6);
}
