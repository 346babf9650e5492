#include "lsdem/mesh/mesh_solid.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lsdem/mesh/read_mesh.hpp"
#include "lsdem/solid/basic_solids.hpp"
#include "lsdem/solid/mass_properties.hpp"
#include "tests/mesh/made_meshes.hpp"
#include "tests/support/solids.hpp"

namespace musim::lsdem {
namespace {

using tests::make_box_triangles;

const MeshUnit kMetre;
const Placing kTurned{.rotation = Quaternion(0.9, 0.1, -0.3, 0.2).normalized().toRotationMatrix(), .position = {1, 2, 3}};

ClosedParts split_stl(const std::string& bytes) { return split_mesh(parse_stl(bytes, "a.stl")); }

MeshSolids solids_of_obj(const std::string& text, const MeshUnit& unit = kMetre) {
    return make_mesh_solids(split_mesh(parse_obj(text, "a.obj")), unit);
}

/// The triangles of a convex polyhedron, each face as a fan.
std::vector<tests::Triangle> triangles_of(const Polyhedron& body) {
    std::vector<tests::Triangle> triangles;
    for (const Polyhedron::Face& face : body.faces) {
        const auto loop = body.loop(face);
        for (std::size_t i = 2; i < loop.size(); ++i) {
            triangles.push_back({body.corners[loop[0]], body.corners[loop[i - 1]], body.corners[loop[i]]});
        }
    }
    return triangles;
}

/// The depth of the deepest of many points of a part's faces below its hull.
double sample_dent(const ClosedPart& part, const Polyhedron& hull) {
    constexpr int kSteps = 60;
    double deepest = 0.0;
    for (const ClosedPart::Face& face : part.faces) {
        const auto loop = part.loop(face);
        for (int i = 0; i <= kSteps; ++i) {
            for (int j = 0; i + j <= kSteps; ++j) {
                const double u = static_cast<double>(i) / kSteps, v = static_cast<double>(j) / kSteps;
                const Vector3 x = (1.0 - u - v) * part.corners[loop[0]] + u * part.corners[loop[1]] + v * part.corners[loop[2]];
                double depth = hull.faces[0].plane.depth(x);
                for (const Polyhedron::Face& own : hull.faces) depth = std::min(depth, own.plane.depth(x));
                deepest = std::max(deepest, depth);
            }
        }
    }
    return deepest;
}

}  // namespace

TEST_CASE("the mesh of a box is the box, whatever its unit and wherever its origin is") {
    const Solid box = make_box_solid({1.0, 2.0, 4.0});
    for (const Vector3& low : {Vector3(0, 0, 0), Vector3(-0.5, -1, -2), Vector3(1e6, -1e6, 1e6)}) {
        const std::string bytes = tests::write_binary_stl(make_box_triangles(low, low + Vector3(1, 2, 4)));
        const MeshSolids solids = make_mesh_solids(split_stl(bytes), kMetre);
        REQUIRE(solids.solids.size() == 1);
        const Polyhedron& solid = solids.solids[0].solid;
        CHECK(solids.origin == low + Vector3(0.5, 1, 2));
        CHECK(solids.solids[0].dent == 0.0);
        CHECK(tests::is_convex_polyhedron(solid, 0.0));
        REQUIRE(solid.faces.size() == 6);
        for (const Polyhedron::Face& face : box.pieces[0].faces) {
            CHECK(std::any_of(solid.faces.begin(), solid.faces.end(),
                              [&](const auto& own) { return own.plane == face.plane && own.count == 4; }));
        }
    }
    const MeshSolids inches =
        make_mesh_solids(split_stl(tests::write_text_stl(make_box_triangles({0, 0, 0}, {1, 2, 4}))), {.name = "in", .metres = 0.0254});
    CHECK(find_bounds({{inches.solids[0].solid}}).high == Vector3(0.0127, 0.0254, 0.0508));
    CHECK(inches.origin == Vector3(0.0127, 0.0254, 0.0508));
}

TEST_CASE("a drum is the same solid from every format") {
    const Solid drum = make_drum(0.5, 0.75, 24, 0.4);
    const std::vector<tests::Triangle> triangles = triangles_of(drum.pieces[0]);
    const double volume = compute_mass_properties(drum).volume;
    const MeshSolids text = make_mesh_solids(split_stl(tests::write_text_stl(triangles)), kMetre);
    REQUIRE(text.solids.size() == 1);
    CHECK(tests::is_convex_polyhedron(text.solids[0].solid, 1e-12));
    CHECK(text.solids[0].solid.faces.size() == 26);
    CHECK(compute_mass_properties({{text.solids[0].solid}}).volume == doctest::Approx(volume).epsilon(1e-12));

    // numbers of 32 bits: corners off by 2^-25, flats of two triangles whose planes differ by that over their width
    const MeshSolids binary = make_mesh_solids(split_stl(tests::write_binary_stl(triangles)), kMetre);
    CHECK(binary.solids[0].dent < 4 * std::ldexp(1.0, -25));
    CHECK(tests::is_convex_polyhedron(binary.solids[0].solid, 1e-12));
    CHECK(compute_mass_properties({{binary.solids[0].solid}}).volume == doctest::Approx(volume).epsilon(6 * std::ldexp(1.0, -25)));
}

TEST_CASE("coordinates of six digits are convex to rounding, and say by how much") {
    std::string text;
    const auto triangles = triangles_of(moved(make_drum(0.5, 0.75, 24, 0.4), kTurned).pieces[0]);
    for (const auto& triangle : triangles) {
        for (const Vector3& x : triangle) text += fmt::format("v {:.6f} {:.6f} {:.6f}\n", x.x(), x.y(), x.z());
        text += "f -3 -2 -1\n";
    }
    const MeshSolids solids = solids_of_obj(text);
    REQUIRE(solids.solids.size() == 1);
    CHECK(solids.solids[0].dent > 1e-9);
    CHECK(solids.solids[0].dent < 2e-6);
    CHECK(tests::is_convex_polyhedron(solids.solids[0].solid, 1e-12));
}

TEST_CASE("a part that is not convex is refused with its deepest dent in the file's unit") {
    // a cube whose top's middle is pressed in by 3 of 100
    std::string text = "v 0 0 0\nv 100 0 0\nv 100 100 0\nv 0 100 0\nv 0 0 100\nv 100 0 100\nv 100 100 100\nv 0 100 100\nv 40 60 97\n";
    text += "f 4 3 2 1\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nf 5 6 9\nf 6 7 9\nf 7 8 9\nf 8 5 9\n";
    tests::check_mesh_refused(
        [&] { solids_of_obj(text, {.name = "mm", .metres = 1e-3}); },
        "a.obj: part 0 is not convex: at (40, 60, 97) mm its surface lies 3 mm below its convex hull (limit 0.001 mm)");
    // an edge that lies deeper than its ends: a groove from side to side
    const std::string groove =
        "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 0 0 2\nv 4 0 2\nv 4 4 2\nv 0 4 2\nv 0 2 1.5\nv 4 2 1.5\n"
        "f 4 3 2 1\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 10 6\nf 4 1 5 9 8\nf 5 6 10 9\nf 9 10 7 8\n";
    tests::check_mesh_refused([&] { solids_of_obj(groove); }, "its surface lies 0.5 m below its convex hull (limit 4e-05 m)");
}

TEST_CASE("the deepest dent is that of a dense sample of the surface") {
    // the edge between the two triangles of a wide top runs through the body: corners are all on the hull
    const std::string text =
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1.4\nv 1 0 1\nv 1 1 1.5\nv 0 1 1.1\n"
        "f 4 3 2 1\nf 1 2 6\nf 1 6 5\nf 2 3 7\nf 2 7 6\nf 3 4 8\nf 3 8 7\nf 4 1 5\nf 4 5 8\nf 5 6 8\nf 6 7 8\n";
    ClosedParts mesh = split_mesh(parse_obj(text, "a.obj"));
    const std::string message = musim::tests::message_of<MeshError>([&] { make_mesh_solids(mesh, kMetre); });
    MeshLimits any;
    any.dent = 1.0;
    const MeshSolids solids = make_mesh_solids(mesh, kMetre, any);
    for (Vector3& corner : mesh.parts[0].corners) corner -= solids.origin;
    // 60 steps along an edge of length 1.5 of slopes below 1
    CHECK(solids.solids[0].dent == doctest::Approx(sample_dent(mesh.parts[0], solids.solids[0].solid)).epsilon(0.03));
    CHECK(message.find(" m its surface lies 0.347 m below its convex hull") != std::string::npos);
}

TEST_CASE("an L is refused as one body, and taken as two groups") {
    tests::check_mesh_refused(
        [] {
            solids_of_obj(
                "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 1\nv 2 0 1\nv 2 1 1\nv 1 1 1\nv 1 2 1\nv 0 2 1\n"
                "f 6 5 4 3 2 1\nf 7 8 9 10 11 12\nf 1 2 8 7\nf 2 3 9 8\nf 3 4 10 9\nf 4 5 11 10\nf 5 6 12 11\nf 6 1 7 12\n");
        },
        "at (1, 1, 0.5) m its surface lies 0.5 m below its convex hull");
    const MeshSolids two =
        solids_of_obj("g left\n" + tests::write_cube_obj({0, 0, 0}, 1) + "g right\n" + tests::write_cube_obj({1, 0, 0}, 9));
    REQUIRE(two.solids.size() == 2);
    CHECK(two.solids[0].name == "left");
    CHECK(two.origin == Vector3(1.0, 0.5, 0.5));
    // the face that they share is at the same places
    CHECK(find_bounds({{two.solids[0].solid}}).high.x() == 0.0);
    CHECK(find_bounds({{two.solids[1].solid}}).low.x() == 0.0);
}

TEST_CASE("faces that cover one another are refused by their volume") {
    // an octahedron wound twice round its axis: a closed surface of eight points of two layers, all on the hull of one
    std::string text = "v 0 0 1\nv 0 0 -1\n";
    const double tilt = 1e-7;  // no two edges are the same
    for (int i = 0; i < 8; ++i) {
        const double angle = (i + (i < 4 ? 0.0 : tilt)) * std::numbers::pi / 2;
        text += fmt::format("v {} {} 0\n", std::cos(angle), std::sin(angle));
    }
    for (int i = 0; i < 8; ++i) text += fmt::format("f 1 {0} {1}\nf 2 {1} {0}\n", 3 + i, 3 + (i + 1) % 8);
    tests::check_mesh_refused([&] { solids_of_obj(text); },
                              "a.obj: part 0 encloses 2 of the volume of its convex hull, on which it lies: its faces cover one another");
}

TEST_CASE("numbers of 32 bits far from zero are named as the reason of a dent") {
    const Vector3 far(1e6, 1e6, 1e6);
    auto triangles = triangles_of(moved(make_drum(0.5, 0.75, 9, 0.5), kTurned).pieces[0]);
    for (auto& triangle : triangles) {
        for (Vector3& x : triangle) x = (x + far).cast<float>().cast<double>();
    }
    tests::check_mesh_refused([&] { make_mesh_solids(split_stl(tests::write_binary_stl(triangles)), kMetre); },
                              "numbers of 32 bits have steps of 0.062 m so far from zero; write it about an origin near it");
}

TEST_CASE("a hull of too many faces is refused with their number") {
    const std::string bytes = tests::write_text_stl(triangles_of(make_drum(1.0, 1.0, 100, 1.0).pieces[0]));
    MeshLimits few;
    few.faces = 101;
    tests::check_mesh_refused([&] { make_mesh_solids(split_stl(bytes), kMetre, few); },
                              "a.stl: part 0 'block' has a hull of 102 faces (limit 101)");
}

TEST_CASE("a part is chosen by number or name, and what else there is is listed") {
    const ClosedParts mesh = split_mesh(
        parse_obj("g left\n" + tests::write_cube_obj({0, 0, 0}, 1) + "g right\n" + tests::write_cube_obj({1, 0, 0}, 9), "a.obj"));
    CHECK(choose_part(mesh, 1).parts[0].name == "right");
    CHECK(choose_part(mesh, "left").parts[0].corners == mesh.parts[0].corners);
    tests::check_mesh_refused([&] { choose_part(mesh); },
                              "a.obj: has 2 closed parts: part 0 'left', part 1 'right'; choose one by number or name");
    tests::check_mesh_refused([&] { choose_part(mesh, 2); }, "a.obj: has no part 2: part 0 'left', part 1 'right'");
    tests::check_mesh_refused([&] { choose_part(mesh, 3); }, "a.obj: has no part 3");
    tests::check_mesh_refused([&] { choose_part(mesh, "rigth"); }, "a.obj: has no part 'rigth' (did you mean \"right\"?): part 0 'left'");
    const ClosedParts same =
        split_mesh(parse_obj("g a\n" + tests::write_cube_obj({0, 0, 0}, 1) + tests::write_cube_obj({4, 0, 0}, 9), "a.obj"));
    tests::check_mesh_refused([&] { choose_part(same, "a"); }, "a.obj: has 2 parts 'a', from part 0 on; choose by number");
    CHECK(choose_part(choose_part(same, 1)).parts[0].number == 1);
}

TEST_CASE("a mesh at a power of four in length gives the same bits") {
    const auto triangles = triangles_of(moved(make_drum(0.5, 0.75, 7, 0.3), kTurned).pieces[0]);
    const ClosedParts mesh = split_stl(tests::write_text_stl(triangles));
    const MeshSolids one = make_mesh_solids(mesh, kMetre), small = make_mesh_solids(mesh, {.name = "m/64", .metres = 1.0 / 64.0});
    REQUIRE(one.solids[0].solid.corners.size() == small.solids[0].solid.corners.size());
    for (std::size_t c = 0; c < one.solids[0].solid.corners.size(); ++c) {
        CHECK(one.solids[0].solid.corners[c] / 64.0 == small.solids[0].solid.corners[c]);
    }
    for (std::size_t f = 0; f < one.solids[0].solid.faces.size(); ++f) {
        CHECK(one.solids[0].solid.faces[f].plane.normal == small.solids[0].solid.faces[f].plane.normal);
        CHECK(one.solids[0].solid.faces[f].plane.offset / 64.0 == small.solids[0].solid.faces[f].plane.offset);
    }
    CHECK(one.origin / 64.0 == small.origin);
}

}  // namespace musim::lsdem
