#include "lsdem/scene/named_shape.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "lsdem/model_hash.hpp"
#include "lsdem/scene/build_model.hpp"
#include "lsdem/scene/reference_block.hpp"
#include "lsdem/scene/scale_scene.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/scene/made_scene.hpp"

using namespace musim;
using namespace musim::lsdem;
using namespace musim::lsdem::testing;

namespace {

/// A scene of limestone whose blocks, and shapes, are given as members of JSON objects.
Scene make_shapes_scene(const std::string& shapes, const std::string& blocks, const std::string& more = "") {
    return parse_scene(
        R"({"schema": "musim-scene/1", "name": "test", "material": "limestone", "structure": {"kind": "blocks", "blocks": [)" + blocks +
            R"(]}, "shapes": {)" + shapes + "}" + more + R"(, "time": {"duration": "1 s"}})",
        "scene.json");
}

const std::string kBox = R"("box": {"kind": "box", "size": ["0.4 m", "0.6 m", "0.2 m"])";
/// The same box with its lower corner in the origin.
const std::string kCorners = R"("corners": {"kind": "polyhedron", "vertices": [[0, 0, 0], [0.4, 0, 0], [0, 0.6, 0], [0.4, 0.6, 0],
    [0, 0, 0.2], [0.4, 0, 0.2], [0, 0.6, 0.2], [0.4, 0.6, 0.2]])";

/// A right triangle 0.4 m along z and 0.3 m along x, 0.5 m along y.
const std::string kSplitWedge =
    R"("wedge": {"kind": "prism", "outline": [[0, 0], ["0.4 m", 0], [0, "0.3 m"]], "axis": "y", "length": "0.5 m"})";

Placing place_of(const Block& block) { return {block.orientation.toRotationMatrix(), block.position}; }

/// Largest distance between the corners of a placed block and those that its drawn solid has by a placing of its frame.
double find_misplacement(const Model& model, const DrawnSolid& drawn, const Placing& frame) {
    const Block& block = model.blocks.front();
    double largest = 0.0;
    const Solid& solid = *model.shapes[block.shape].solid;
    for (std::size_t p = 0; p < solid.pieces.size(); ++p) {
        for (std::size_t c = 0; c < solid.pieces[p].corners.size(); ++c) {
            const Vector3 wanted = frame * Vector3(drawn.solid.pieces[p].corners[c] + drawn.origin);
            largest = std::max(largest, (place_of(block) * solid.pieces[p].corners[c] - wanted).norm());
        }
    }
    return largest;
}

}  // namespace

TEST_CASE("a block is placed by the frame in which its shape is drawn") {
    const Scene scene = make_shapes_scene(kSplitWedge, R"({"shape": "wedge", "position": [1, 2, 3], "quaternion": [1, 0, 0, 1]})");
    const Model model = make_model(scene);
    REQUIRE(model.blocks.size() == 1);
    // the centre of the triangle, turned by a quarter about z: (x, y, z) -> (-y, x, z)
    CHECK((model.blocks[0].position - Vector3(1.0, 2.1, 3.0 + 0.4 / 3.0)).norm() < 1e-15);
    CHECK(model.blocks[0].mass == doctest::Approx(scene.material.density.value() * 0.5 * 0.4 * 0.3 * 0.5).epsilon(1e-14));
    const Placing frame{Eigen::AngleAxisd(std::acos(0.0), Vector3::UnitZ()).toRotationMatrix(), {1.0, 2.0, 3.0}};
    CHECK(find_misplacement(model, make_drawn_solid(scene, "wedge"), frame) < 1e-15);

    // scaled, mirrored, turned: z doubled, x negated, then turned about z
    const std::string placed =
        kSplitWedge.substr(0, kSplitWedge.size() - 1) + R"(, "scale": [1, 1, 2], "mirror": "x", "quaternion": [1, 0, 0, 1]})";
    const Scene changed = make_shapes_scene(placed, R"({"shape": "wedge", "position": [1, 2, 3]})");
    const Vector3 centre = make_model(changed).blocks[0].position;
    CHECK((centre - Vector3(1.0, 2.0 - 0.1, 3.0 + 0.8 / 3.0)).norm() < 1e-15);
    CHECK(make_model(changed).shapes[0].volume == doctest::Approx(0.06).epsilon(1e-14));
}

TEST_CASE("a named box is the box of the same size, to the last bit of its model") {
    const std::string steel = R"(, "materials": {"other": {"preset": "marble"}})";
    const Scene named = make_shapes_scene(kBox + "}", R"({"shape": "box", "position": [0, 0, 0.1], "quaternion": [1, 0, 0, 2]})", steel);
    const Scene sized = make_shapes_scene("", R"({"size": [0.4, 0.6, 0.2], "position": [0, 0, 0.1], "quaternion": [1, 0, 0, 2]})", steel);
    CHECK(named.material == sized.material);
    CHECK(hash_model(make_model(named), 1e-4) == hash_model(make_model(sized), 1e-4));
    // a turned shape is a turned block
    const Scene turned =
        make_shapes_scene(kBox + R"(, "quaternion": [1, 0, 0, 2]})", R"({"shape": "box", "position": [0, 0, 0.1]})", steel);
    CHECK(hash_model(make_model(turned), 1e-4) == hash_model(make_model(sized), 1e-4));
}

TEST_CASE("boxes drawn as polyhedra, prisms, compounds and meshes have the mass, inertia and base of the box") {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "musim_named_shape_test";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "box.obj") << "v 0 0 0\nv 400 0 0\nv 0 600 0\nv 400 600 0\nv 0 0 200\nv 400 0 200\nv 0 600 200\nv 400 600 200\n"
                                         "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
    const std::string half = R"("half": {"kind": "box", "size": [0.2, 0.6, 0.2]})";
    const Vector3 inertia = Vector3(0.36 + 0.04, 0.16 + 0.04, 0.16 + 0.36) / 12.0;
    for (const std::string& shape :
         {kCorners + "}", kCorners + R"(, "faces": [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]})",
          std::string(R"("corners": {"kind": "prism", "outline": [[5, 0], [5.4, 0], [5.4, 0.6], [5, 0.6]], "length": 0.2})"),
          half + R"(, "corners": {"kind": "compound", "parts": [{"shape": "half"}, {"shape": "half", "position": [0.2, 0, 0]}]})",
          std::string(R"("corners": {"kind": "mesh", "file": ")") + (folder / "box.obj").string() + R"(", "unit": "mm"})"}) {
        CAPTURE(shape);
        const Scene scene = make_shapes_scene(shape, R"({"shape": "corners", "position": [0, 0, 0.2]})");
        const Model model = make_model(scene);
        const Shape& own = model.shapes.at(0);
        REQUIRE(own.solid);
        CHECK(own.volume == doctest::Approx(0.048).epsilon(1e-13));
        CHECK((own.inertia_over_mass - inertia).norm() < 1e-13 * inertia.norm());
        CHECK(own.face_area == doctest::Approx(0.24).epsilon(1e-13));
        CHECK((own.half_extents - Vector3(0.2, 0.3, 0.1)).norm() < 1e-15);
        CHECK(own.own.rotation == Matrix3::Identity());
        CHECK(reference_area(scene).value() == doctest::Approx(0.24).epsilon(1e-13));
        CHECK(reference_block(scene)[1].value() == doctest::Approx(0.6).epsilon(1e-13));
        CHECK(reference_block(scene)[2].value() == doctest::Approx(0.2).epsilon(1e-13));
    }
    std::filesystem::remove_all(folder);
}

namespace {

/// An OBJ of boxes, each a group, turned and about a place [mm], its numbers of six digits.
std::string write_turned_boxes(const std::vector<Bounds>& boxes) {
    const Matrix3 turn = Quaternion(0.8, 0.3, -0.4, 0.33).normalized().toRotationMatrix();
    std::string text;
    for (std::size_t b = 0; b < boxes.size(); ++b) {
        text += fmt::format("g box_{}\n", b);
        for (int c = 0; c < 8; ++c) {
            const auto pick = [&](int axis) { return ((c >> axis & 1) != 0 ? boxes[b].high : boxes[b].low)[axis]; };
            const Vector3 x = turn * Vector3(pick(0), pick(1), pick(2)) + Vector3(120.0, -340.0, 90.0);
            text += fmt::format("v {:.6g} {:.6g} {:.6g}\n", x.x(), x.y(), x.z());
        }
        for (const auto& face : {std::array{1, 3, 4, 2}, {5, 6, 8, 7}, {1, 2, 6, 5}, {3, 7, 8, 4}, {1, 5, 7, 3}, {2, 4, 8, 6}}) {
            text += "f";
            for (const int corner : face) text += fmt::format(" {}", corner + 8 * static_cast<int>(b));
            text += "\n";
        }
    }
    return text;
}

}  // namespace

TEST_CASE("groups of an OBJ that share a face to its six digits make one solid") {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "musim_touching_groups_test";
    std::filesystem::create_directories(folder);
    const std::string shape = R"("whole": {"kind": "compound", "file": ")" + (folder / "parts.obj").string() + R"(", "unit": "mm"})";
    const auto make = [&](const std::vector<Bounds>& boxes) {
        std::ofstream(folder / "parts.obj") << write_turned_boxes(boxes);
        return make_model(make_shapes_scene(shape, R"({"shape": "whole", "position": [0, 0, 3]})")).shapes.at(0);
    };
    // two halves are a box, but for the rounding of its coordinates; a smaller face on a larger one makes a key
    const Shape box = make({{{0, 0, 0}, {200, 600, 200}}, {{200, 0, 0}, {400, 600, 200}}});
    CHECK(box.solid->is_convex());
    CHECK(box.solid->pieces.front().faces.size() == 6);
    CHECK(box.volume == doctest::Approx(0.048).epsilon(2e-5));
    const Shape keyed = make({{{0, 0, 0}, {400, 600, 200}}, {{150, 200, 200}, {250, 400, 300}}});
    CHECK_FALSE(keyed.solid->is_convex());
    CHECK(keyed.volume == doctest::Approx(0.05).epsilon(2e-5));

    // what is farther apart than digits give is refused, and what lies within another
    check_message(error_of([&] {
                      make({{{0, 0, 0}, {200, 600, 200}}, {{200.1, 0, 0}, {400, 600, 200}}});
                  }),
                  {"/shapes/whole: ", "part 1 does not hang together with part 0"});
    check_message(error_of([&] {
                      make({{{0, 0, 0}, {400, 600, 200}}, {{100, 100, 50}, {200, 200, 150}}});
                  }),
                  {"/shapes/whole: ", "parts 0 and 1 overlap"});
    std::filesystem::remove_all(folder);
}

TEST_CASE("a shape far from its origin is where it is drawn, with the same mass properties") {
    const auto stone = [](double far) {
        std::string vertices;
        for (const Vector3& x : {Vector3(0, 0, 0), Vector3(0.5, 0, 0), Vector3(0, 0.75, 0), Vector3(0, 0, 0.25)})
            vertices += fmt::format("{}[{}, {}, {}]", vertices.empty() ? "" : ", ", x.x() + far, x.y() - far, x.z() + far);
        return R"("stone": {"kind": "polyhedron", "vertices": [)" + vertices + "]}";
    };
    const Model near = make_model(make_shapes_scene(stone(0.0), R"({"shape": "stone", "position": [0, 0, 0.25]})"));
    // 2^20 keeps the corners exact
    const Scene scene = make_shapes_scene(stone(1048576.0), R"({"shape": "stone", "position": [-1048576, 1048576, -1048575.75]})");
    const Model far = make_model(scene);
    CHECK(far.shapes[0].inertia_over_mass == near.shapes[0].inertia_over_mass);
    CHECK(far.shapes[0].volume == near.shapes[0].volume);
    CHECK((far.blocks[0].position - near.blocks[0].position).norm() < 1e-9);  // a place has the digits of the numbers that give it
}

TEST_CASE("mass, centre and inertia given apart from a shape are those of its blocks") {
    const Scene scene =
        make_shapes_scene(kCorners + R"(, "mass": "50 kg", "centre": [0.2, 0.3, 0.05], "inertia": [[2, 0, 0], [0, 3, 0], [0, 0, 4]]})",
                          R"({"shape": "corners", "position": [0, 0, 1]})");
    const Model model = make_model(scene);
    CHECK(model.blocks[0].mass == 50.0);
    CHECK((model.blocks[0].position - Vector3(0.2, 0.3, 1.05)).norm() < 1e-15);
    CHECK((model.shapes[0].inertia_over_mass - Vector3(0.04, 0.06, 0.08)).norm() < 1e-16);
    CHECK(model.shapes[0].volume == doctest::Approx(0.048).epsilon(1e-13));
    CHECK(model.shapes[0].half_extents.z() == doctest::Approx(0.15).epsilon(1e-13));
    CHECK(find_bounds(*model.shapes[0].solid).low.z() == doctest::Approx(-0.05).epsilon(1e-13));

    // a mass alone leaves the rest homogeneous; a density alone is that of one block
    const Scene heavy = make_shapes_scene(kCorners + R"(, "mass": "50 kg"}, )" + kBox + "}", R"({"shape": "corners", "position": [0, 0, 1]},
        {"shape": "box", "position": [5, 0, 1], "density": "1000 kg/m^3"}, {"size": [1, 1, 1], "position": [9, 0, 1], "density": "500 kg/m^3"})");
    const Model several = make_model(heavy);
    CHECK(several.blocks[0].mass == 50.0);
    CHECK(several.blocks[1].mass == doctest::Approx(48.0).epsilon(1e-14));
    CHECK(several.blocks[2].mass == 500.0);
    CHECK(several.materials.size() == 1);
}

TEST_CASE("solids that cannot be, and blocks that stand in each other, are refused in one line") {
    struct Case {
        std::string shapes, blocks;
        std::vector<std::string> parts;
    };
    const std::string once = R"({"shape": "a", "position": [0, 0, 5]})";
    for (
        const Case& c : std::vector<Case>{
            {R"("a": {"kind": "prism", "outline": [[0, 0], [2, 0], [1, 0.5], [2, 2], [0, 2]], "length": 1})",
             once,
             {"scene.json: /shapes/a: ", "not convex at corner 2"}},
            {R"("a": {"kind": "prism", "outline": [[0, 0], [0, 1], [1, 0]], "length": 1})", once, {"/shapes/a: ", "clockwise"}},
            {R"("a": {"kind": "polyhedron", "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]})",
             once,
             {"/shapes/a: ", "one plane"}},
            {R"("a": {"kind": "polyhedron", "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], "faces": [[0, 2, 1], [0, 1, 3], [1, 2, 3]]})",
             once,
             {"/shapes/a: faces: "}},
            {R"("a": {"kind": "mesh", "file": "/nowhere/a.obj", "unit": "m"})", once, {"/shapes/a: /nowhere/a.obj"}},
            {R"("b": {"kind": "box", "size": [1, 1, 1]}, "a": {"kind": "compound", "parts": [{"shape": "b"}, {"shape": "b", "position": [0.5, 0, 0]}]})",
             once,
             {"/shapes/a: ", "overlap"}},
            {kCorners + R"(, "mass": 1, "centre": [0, 0, 2], "inertia": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]})",
             R"({"shape": "corners", "position": [0, 0, 5]})",
             {"/shapes/corners/centre: it lies outside of the solid, which is from (0, 0, 0) to (0.4, 0.6, 0.2) m"}},
            {kCorners + R"(, "mass": 1, "inertia": [[1, 0, 0], [0, 1, 0], [0, 0, 3]]})",
             R"({"shape": "corners", "position": [0, 0, 5]})",
             {"/shapes/corners/inertia: principal moments 1, 1 and 3 kg m^2 are those of no body"}},
            {kSplitWedge,
             R"({"shape": "wedge", "position": [0, 0, 1]}, {"shape": "wedge", "position": ["0.1 m", 0, 1], "name": "upper"})",
             {"/structure/blocks/0 and /structure/blocks/1 (\"upper\") overlap by 160 mm"}},
            {kSplitWedge,
             R"({"shape": "wedge", "position": [0, 0, 1]}, {"size": [1, 1, 1], "position": [0.5, 0, 0.75]})",
             {"overlap by 250 mm"}},
            {kSplitWedge, R"({"shape": "wedge", "position": [0, 0, -0.01]})", {"/structure/blocks/0 reaches 10 mm below the ground"}}}) {
        CAPTURE(c.shapes);
        check_message(error_of([&] { make_model(make_shapes_scene(c.shapes, c.blocks)); }), c.parts);
    }
    // touching faces, whatever their slope, do not overlap
    const std::string turned = R"({"shape": "wedge", "position": [0.3, 0, 1.4], "quaternion": [0, 0, 1, 0]})";
    CHECK(make_model(make_shapes_scene(kSplitWedge, R"({"shape": "wedge", "position": [0, 0, 1]}, )" + turned)).blocks.size() == 2);
}

TEST_CASE("the shapes of a similar scene agree with the prototype's to the last bit") {
    const std::string shapes = kSplitWedge + R"(, "drum": {"kind": "cylinder", "radius": 0.3, "height": 0.2, "top_radius": 0.25},
        "stone": {"kind": "polyhedron", "vertices": [[0, 0, 0], [0.7, 0, 0.1], [0.1, 0.6, 0], [0.2, 0.2, 0.5]], "mass": 300,
                  "centre": [0.2, 0.2, 0.2], "inertia": [[9, 1, 0], [1, 8, -0.5], [0, -0.5, 7]]})";
    const Scene scene = make_shapes_scene(shapes, R"({"shape": "wedge", "position": [0, 0, 1]}, {"shape": "drum", "position": [3, 0, 0.1]},
        {"shape": "stone", "position": [6, 0, 2], "quaternion": [3, 1, 0, 1]})");
    const double length = 0.25;
    const Model model = make_model(scene), image = make_model(scale_scene(scene, scaling::make_similitude("mu", {.length = length})));
    for (std::size_t b = 0; b < 3; ++b) {
        CAPTURE(b);
        const Shape &own = model.shapes[b], &scaled = image.shapes[b];
        CHECK(image.blocks[b].mass == model.blocks[b].mass * length * length * length);
        CHECK(image.blocks[b].position == Vector3(length * model.blocks[b].position));
        CHECK(image.blocks[b].orientation.coeffs() == model.blocks[b].orientation.coeffs());
        CHECK(scaled.inertia_over_mass == Vector3(length * length * own.inertia_over_mass));
        CHECK(scaled.face_area == length * length * own.face_area);
        CHECK(scaled.own.position == Vector3(length * own.own.position));
        for (std::size_t c = 0; c < own.solid->pieces[0].corners.size(); ++c)
            CHECK(scaled.solid->pieces[0].corners[c] == Vector3(length * own.solid->pieces[0].corners[c]));
        for (std::size_t f = 0; f < own.solid->pieces[0].faces.size(); ++f) {
            CHECK(scaled.solid->pieces[0].faces[f].plane.normal == own.solid->pieces[0].faces[f].plane.normal);
            CHECK(scaled.solid->pieces[0].faces[f].plane.offset == length * own.solid->pieces[0].faces[f].plane.offset);
        }
    }
}

TEST_CASE("spheres of several radii may be named, each with nodes of its own") {
    const Scene scene = make_shapes_scene(R"("small": {"kind": "sphere", "radius": 0.1, "nodes": 50, "voxel": 0.02},
        "large": {"kind": "sphere", "radius": 0.2, "nodes": 80, "voxel": 0.04})",
                                          R"({"shape": "small", "position": [0, 0, 0.1]}, {"shape": "large", "position": [1, 0, 0.2]})");
    CHECK(scene.has_contact_nodes());
    const Model model = make_model(scene);
    REQUIRE(model.shapes.size() == 2);
    CHECK(model.shapes[1].nodes.size() == 80);
    CHECK_FALSE(model.shapes[0].faceted);
    CHECK(parse_scene(write_scene(scene), "scene.json") == scene);
}
