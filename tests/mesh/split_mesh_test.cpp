#include "lsdem/mesh/split_mesh.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "lsdem/mesh/read_mesh.hpp"
#include "tests/mesh/made_meshes.hpp"

namespace musim::lsdem {
namespace {

using tests::joined;
using tests::make_box_triangles;
using tests::turned;

ClosedParts split_stl(const std::vector<tests::Triangle>& triangles) {
    return split_mesh(parse_stl(tests::write_text_stl(triangles), "a.stl"));
}

ClosedParts split_obj(const std::string& text) { return split_mesh(parse_obj(text, "a.obj")); }

const std::vector<tests::Triangle> kCube = make_box_triangles({0, 0, 0}, {1, 1, 1});

/// The prism of the L of area 3, from z = 0 to 1, whose ends' lists of corners begin at `start`.
std::string write_l_shape(int start) {
    constexpr double kOutline[6][2] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
    std::string text, top = "f", bottom = "f";
    for (int z = 0; z < 2; ++z) {
        for (const auto& corner : kOutline) text += fmt::format("v {} {} {}\n", corner[0], corner[1], z);
    }
    for (int i = 0; i < 6; ++i) {
        top += fmt::format(" {}", 7 + (start + i) % 6);
        bottom += fmt::format(" {}", 1 + (start + 6 - i) % 6);
        text += fmt::format("f {} {} {} {}\n", 1 + i, 1 + (i + 1) % 6, 7 + (i + 1) % 6, 7 + i);
    }
    return text + top + "\n" + bottom + "\n";
}

void check_split_refused(const std::vector<tests::Triangle>& triangles, std::string_view said) {
    tests::check_mesh_refused([&] { split_stl(triangles); }, said);
}

}  // namespace

// Assimp 5.2.5 makes a third more of its area of one start, tinyobjloader 2.0 of a T
TEST_CASE("the area and volume of an L do not depend on the corner that its polygon begins with") {
    for (int start = 0; start < 6; ++start) {
        const ClosedParts mesh = split_obj(write_l_shape(start));
        REQUIRE(mesh.parts.size() == 1);
        CHECK(mesh.parts[0].area == doctest::Approx(2 * 3.0 + 8.0).epsilon(1e-14));
        CHECK(mesh.parts[0].volume == doctest::Approx(3.0).epsilon(1e-14));
        CHECK(mesh.parts[0].triangles() == 2 * 4 + 6 * 2);
    }
}

TEST_CASE("two cubes of one file that are wound oppositely have both their volumes") {
    const auto far = make_box_triangles({3, 0, 0}, {4, 1, 1});
    for (const auto& triangles : {joined(kCube, turned(far)), joined(turned(kCube), far), joined(turned(kCube), turned(far))}) {
        const ClosedParts mesh = split_stl(triangles);
        REQUIRE(mesh.parts.size() == 2);
        CHECK(mesh.parts[0].volume == doctest::Approx(1.0).epsilon(1e-15));
        CHECK(mesh.parts[1].volume == doctest::Approx(1.0).epsilon(1e-15));
        CHECK(mesh.parts[0].turned + mesh.parts[1].turned == (triangles[0] == kCube[0] || triangles[12] == far[0] ? 12 : 24));
    }
}

TEST_CASE("faces that are wound inwards one by one are turned") {
    std::vector<tests::Triangle> triangles = kCube;
    for (const std::size_t t : {0U, 5U, 11U}) std::swap(triangles[t][0], triangles[t][1]);
    const ClosedParts mesh = split_stl(triangles);
    REQUIRE(mesh.parts.size() == 1);
    CHECK(mesh.parts[0].volume == doctest::Approx(1.0).epsilon(1e-15));
    CHECK(mesh.parts[0].turned == 3);
    CHECK(describe_parts(mesh) == "text STL: 1 closed part, 12 triangles, 36 corners of which 8 differ; 3 faces turned outwards");
    // each face now sees its corners counter-clockwise from outside
    const ClosedPart& cube = mesh.parts[0];
    for (const ClosedPart::Face& face : cube.faces) {
        const auto loop = cube.loop(face);
        const Vector3 a = cube.corners[loop[0]], b = cube.corners[loop[1]], c = cube.corners[loop[2]];
        CHECK((b - a).cross(c - a).dot(a - Vector3(0.5, 0.5, 0.5)) > 0.0);
    }
}

TEST_CASE("two blocks that share a face stay two closed parts") {
    const auto beside = make_box_triangles({1, 0, 0}, {2, 1, 1});
    for (const auto& triangles : {joined(kCube, beside), joined(kCube, turned(beside))}) {
        const ClosedParts mesh = split_stl(triangles);
        REQUIRE(mesh.parts.size() == 2);
        for (const ClosedPart& part : mesh.parts) {
            CHECK(part.volume == doctest::Approx(1.0).epsilon(1e-15));
            CHECK(part.corners.size() == 8);
            CHECK(part.corners_read == 36);
        }
    }
    // with vertices of their own, and with four in common
    const std::string own = tests::write_cube_obj({0, 0, 0}, 1) + tests::write_cube_obj({1, 0, 0}, 9);
    CHECK(split_obj(own).parts.size() == 2);
    std::string shared = tests::write_cube_obj({0, 0, 0}, 1) + "v 2 0 0\nv 2 1 0\nv 2 0 1\nv 2 1 1\n";
    shared += "f 2 6 8 4\nf 9 10 12 11\nf 2 9 11 6\nf 4 8 12 10\nf 2 4 10 9\nf 6 11 12 8\n";
    const ClosedParts mesh = split_obj(shared);
    REQUIRE(mesh.parts.size() == 2);
    CHECK(mesh.parts[1].volume == doctest::Approx(1.0).epsilon(1e-15));
}

TEST_CASE("solids of an STL that stand mixed but touch nowhere are parted, and keep their own numbers") {
    const auto far = make_box_triangles({3, 0, 0}, {4, 1, 1});
    std::vector<tests::Triangle> mixed;
    for (std::size_t t = 0; t < 12; ++t) mixed.insert(mixed.end(), {kCube[t], far[t]});
    const ClosedParts mesh = split_stl(mixed);
    REQUIRE(mesh.parts.size() == 2);
    CHECK(mesh.parts[1].faces[3].number == 8);
    CHECK(mesh.parts[1].faces[3].line == 3 + 7 * 7 - 1);
}

TEST_CASE("corners are joined where their coordinates are equal and nowhere else") {
    std::vector<tests::Triangle> triangles = kCube;
    triangles[0][0].x() = -0.0;
    CHECK(split_stl(triangles).parts[0].corners.size() == 8);
    triangles[0][0] = {0.0, 1e-12, 0.0};
    check_split_refused(
        triangles,
        "a.stl:2: the surface 'block' is open: 4 edges belong to one face only, the first is the edge from (0, 1e-12, 0) to "
        "(0, 0, 1) of triangle 1 (line 2); the corner (0, 0, 0) lies 1e-12 beside its beginning; give corners that are one "
        "the same digits");
    // vertices of equal coordinates are joined in files of shared vertices, too, where the surface needs it
    std::string text = tests::write_cube_obj({0, 0, 0}, 1);
    text.replace(text.find("f 1 5 7 3"), 9, "v 0 0 0\nv 0 0 1\nf 9 10 7 3");
    const ClosedParts mesh = split_obj(text);
    REQUIRE(mesh.parts.size() == 1);
    CHECK(mesh.parts[0].corners_read == 10);
    CHECK(mesh.parts[0].corners.size() == 8);
}

TEST_CASE("an open surface is refused with the number of its open edges and the first") {
    std::vector<tests::Triangle> triangles = kCube;
    triangles.erase(triangles.begin() + 7);
    check_split_refused(triangles,
                        "a.stl:16: the surface 'block' is open: 3 edges belong to one face only, the first is the edge from (1, 1, 0) to "
                        "(1, 1, 1) of triangle "
                        "3 (line 16); close it");
    CHECK_THROWS_AS(split_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), MeshError);
    // a closed part beside it does not help
    check_split_refused(joined(triangles, make_box_triangles({3, 0, 0}, {4, 1, 1})), "is open: 3 edges");
}

TEST_CASE("an edge of three faces is refused with their numbers") {
    // a wall between two rooms
    const auto beside = make_box_triangles({1, 0, 0}, {2, 1, 1});
    check_split_refused(joined(kCube, {beside.begin() + 2, beside.end()}), "belongs to 3 faces: triangle ");
    // a triangle given twice
    std::vector<tests::Triangle> twice = kCube;
    twice.insert(twice.begin() + 5, twice[4]);
    check_split_refused(twice, "belongs to 3 faces: triangle ");
}

TEST_CASE("what encloses no volume is refused") {
    const tests::Triangle sheet{Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0)};
    check_split_refused({sheet, turned({sheet})[0]},
                        "a.stl:2: 2 faces from triangle 1 (line 2) on, with corners (0, 0, 0) (1, 0, 0) (0, 1, 0), close no volume");
    // a pyramid so low that its hull is flat, though its sides are no slivers
    const std::string pyramid = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.3 0.3 {}\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    tests::check_mesh_refused([&] { split_obj(fmt::format(fmt::runtime(pyramid), "4e-12")); },
                              "close no volume (6.67e-13 of the size cubed)");
    CHECK(split_obj(fmt::format(fmt::runtime(pyramid), "4e-11")).parts[0].volume == doctest::Approx(4e-11 / 6).epsilon(1e-12));
    CHECK(split_stl(make_box_triangles({0, 0, 0}, {1, 1, 1e-10})).parts[0].volume == doctest::Approx(1e-10).epsilon(1e-12));
}

TEST_CASE("triangles that two equal corners make an edge are left out") {
    // the edge from (0, 0, 0) to (1, 0, 0) is split at its beginning
    std::vector<tests::Triangle> triangles = kCube;
    triangles.insert(triangles.begin() + 5, {Vector3(0, 0, 0), Vector3(-0.0, 0, 0), Vector3(1, 0, 0)});
    const ClosedParts mesh = split_stl(triangles);
    CHECK(mesh.left_out == 1);
    REQUIRE(mesh.parts.size() == 1);
    CHECK(mesh.parts[0].faces[5].number == 7);
    CHECK(describe_parts(mesh) ==
          "text STL: 1 closed part, 12 triangles, 36 corners of which 8 differ; 1 triangle with two equal corners left out");
    std::string text = tests::write_cube_obj({0, 0, 0}, 1) + "v 0 0 0\nf 1 9 2\n";
    text.replace(text.find("f 1 2 6 5"), 9, "f 9 2 6 5");
    CHECK(split_obj(text).parts[0].corners.size() == 8);

    tests::check_mesh_refused([&] { split_obj("v 0 0 0\nv 0 0 0\nv 1 0 0\nf 1 2 3\n"); }, "a.obj: all triangles have two equal corners");
    tests::check_mesh_refused([&] { split_obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4 2\n"); },
                              "a.obj:5: face 1 has the corner (1, 0, 0) twice; split it in two");
}

TEST_CASE("slivers are refused with number and corners") {
    // a corner in the middle of an edge, bridged by a triangle without area
    std::string text = tests::write_cube_obj({0, 0, 0}, 1) + "v 0.5 0 0\nf 1 9 2\n";
    text.replace(text.find("f 1 2 6 5"), 9, "f 1 9 2 6 5");
    text.replace(text.find("f 1 3 4 2"), 9, "f 1 3 4 2");
    tests::check_mesh_refused(
        [&] { split_obj(text); },
        "a.obj:16: triangle 7 (line 16) has an area of 0 of its body's size squared (limit 1e-12): (0, 0, 0) (0.5, 0, 0) (1, 0, 0)");
}

TEST_CASE("a face that is not plane is refused with its corner, one that is so to rounding is not") {
    std::string text = tests::write_cube_obj({0, 0, 0}, 1);
    const std::string corner = "v 1 1 1\n";
    const auto lifted = [&](std::string_view z) {
        return std::string(text).replace(text.find(corner), corner.size(), fmt::format("v 1 1 {}\n", z));
    };
    tests::check_mesh_refused([&] { split_obj(lifted("1.1")); },
                              "face 6 (line 14) is not plane: its corner (0, 0, 1) lies 0.0249 off its mean plane");
    CHECK(split_obj(lifted("1.000001")).parts.size() == 1);
}

TEST_CASE("a surface with one side is refused") {
    // the torus of 3 x 3 squares whose seam is glued the other way round: Klein's bottle, in four dimensions and hence anywhere
    std::string text;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) text += fmt::format("v {} {} {}\n", i * i + j, j * j - i, i + 2 * j + i * j);
    }
    const auto vertex = [](int i, int j) { return i < 3 ? 3 * i + j % 3 + 1 : (3 - j % 3) % 3 + 1; };
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            text += fmt::format("f {} {} {}\n", vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1));
            text += fmt::format("f {} {} {}\n", vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1));
        }
    }
    tests::check_mesh_refused([&] { split_obj(text); }, "cannot both be wound outwards: the surface has one side");
}

TEST_CASE("a far origin costs volume and area no digits") {
    // corners in binary numbers of 32 bits whose steps are 1/16
    const Vector3 far(1e6, -1e6, 1e6);
    const auto triangles = make_box_triangles(far, far + Vector3(1, 2, 4));
    const ClosedParts mesh = split_mesh(parse_stl(tests::write_binary_stl(triangles), "a.stl"));
    REQUIRE(mesh.parts.size() == 1);
    CHECK(mesh.parts[0].volume == doctest::Approx(8.0).epsilon(1e-15));
    CHECK(mesh.parts[0].area == doctest::Approx(28.0).epsilon(1e-15));
}

TEST_SUITE("slow") {
    TEST_CASE("a million triangles are parted in seconds") {
        // a cube of 289 x 289 squares a side: 1002252 triangles
        constexpr int kSquares = 289;
        std::vector<tests::Triangle> triangles;
        for (int axis = 0; axis < 3; ++axis) {
            for (int side = 0; side < 2; ++side) {
                const auto at = [&](int i, int j) {
                    Vector3 x;
                    x[axis] = side * kSquares;
                    x[(axis + 1) % 3] = i;
                    x[(axis + 2) % 3] = j;
                    return x;
                };
                for (int i = 0; i < kSquares; ++i) {
                    for (int j = 0; j < kSquares; ++j) {
                        triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
                        triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
                    }
                }
            }
        }
        const ClosedParts mesh = split_mesh(parse_stl(tests::write_binary_stl(triangles), "a.stl"));
        REQUIRE(mesh.parts.size() == 1);
        // sums of a million terms
        CHECK(mesh.parts[0].volume == doctest::Approx(std::pow(kSquares, 3)).epsilon(1e-10));
        CHECK(mesh.parts[0].corners.size() == 6 * kSquares * kSquares + 2);
    }
}

}  // namespace musim::lsdem
