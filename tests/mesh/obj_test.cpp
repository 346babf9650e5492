#include <doctest/doctest.h>

#include "lsdem/mesh/read_mesh.hpp"
#include "lsdem/mesh/split_mesh.hpp"
#include "tests/mesh/made_meshes.hpp"

namespace musim::lsdem {
namespace {

constexpr std::string_view kVertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";

std::vector<std::uint32_t> read_loops(const std::string& faces) {
    return parse_obj(std::string(kVertices) + "vt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n" + faces, "a.obj").loops;
}

void check_obj_refused(const std::string& text, std::string_view said) {
    tests::check_mesh_refused([&] { parse_obj(std::string(kVertices) + text, "a.obj"); }, said);
}

}  // namespace

TEST_CASE("corners of an OBJ's faces are counted from 1, or back from the last vertex") {
    const std::vector<std::uint32_t> first{0, 2, 1};
    CHECK(read_loops("f 1 3 2\n") == first);
    CHECK(read_loops("f 1/1 3/3 2/2\n") == first);
    CHECK(read_loops("f 1//1 3//1 2//1\n") == first);
    CHECK(read_loops("f 1/1/1 3/3/1 2/2/1\n") == first);
    CHECK(read_loops("f -4 -2 -3\nv 5 5 5\n") == first);
    CHECK(read_loops("f -4/-3/-1 -2/-1/-1 -3/-2/-1\n") == first);
    CHECK(read_loops("f\t1  3 \\\n 2\n") == first);
    CHECK(read_loops("f 1 3\\\r\n 2\r\n") == first);
    CHECK(read_loops("f 1 3 2 # the base\\\n# and no more\\\n") == first);
    CHECK(read_loops("usemtl stone\ns off\nl 1 2\np 1\nF 1 3 2") == first);
    CHECK(read_loops("f 1 3 2\r") == first);
    CHECK(read_loops("f 1 5 2\nv 7 7 7\n") == std::vector<std::uint32_t>{0, 4, 1});
}

TEST_CASE("weights and colours behind an OBJ's coordinates are read over") {
    const Mesh mesh = parse_obj("v 1 2 +3 1.0\nv -4 5e0 6 0.5 0.5 0.5\nv 7 8 9\nf 1 2 3\n", "a.obj");
    CHECK(mesh.vertices == std::vector<Vector3>{{1, 2, 3}, {-4, 5, 6}, {7, 8, 9}});
}

TEST_CASE("objects and groups of an OBJ name its parts") {
    const std::string text = "o ring\ng left key\n" + tests::write_cube_obj({0, 0, 0}, 1) + "g right\n" +
                             tests::write_cube_obj({3, 0, 0}, 9) + "o lintel\n" + tests::write_cube_obj({6, 0, 0}, 17);
    const ClosedParts mesh = split_mesh(parse_obj(text, "a.obj"));
    REQUIRE(mesh.parts.size() == 3);
    CHECK(mesh.parts[0].name == "left key");
    CHECK(mesh.parts[1].name == "right");
    CHECK(mesh.parts[2].name == "lintel");
}

TEST_CASE("groups that are sides of one body make one part, named by their object") {
    std::string text = tests::write_cube_obj({0, 0, 0}, 1);
    text.insert(text.find("f "), "o cube\ng bottom\n");
    text.insert(text.rfind("f "), "g top\n");
    const ClosedParts mesh = split_mesh(parse_obj(text, "a.obj"));
    REQUIRE(mesh.parts.size() == 1);
    CHECK(mesh.parts[0].name == "cube");
    CHECK(mesh.parts[0].volume == doctest::Approx(1.0).epsilon(1e-15));
}

TEST_CASE("the faces of a group may stand apart in an OBJ") {
    std::string cube = tests::write_cube_obj({0, 0, 0}, 1), other = tests::write_cube_obj({0, 0, 1}, 9);
    const std::size_t half = cube.rfind("f ");
    const std::string last = cube.substr(half);
    const ClosedParts mesh = split_mesh(parse_obj("g a\n" + cube.substr(0, half) + "g b\n" + other + "g a\n" + last, "a.obj"));
    REQUIRE(mesh.parts.size() == 2);
    CHECK(mesh.parts[0].name == "a");
    CHECK(mesh.parts[1].name == "b");
}

TEST_CASE("wrong lines of an OBJ are named") {
    check_obj_refused("f 1 2 5\n", "a.obj:5: triangle 1 has a corner that is vertex 4, counted from 0, of 4");
    check_obj_refused("f 1 2 0\n", "a.obj:5: vertex 0 does not exist: 4 stand before this line, counted from 1");
    check_obj_refused("f 1 2 -5\n", "a.obj:5: vertex -5 does not exist: 4 stand before this line");
    check_obj_refused("f 1 2 99999999999\n", "a.obj:5: vertex 99999999999 does not exist");
    check_obj_refused("f 1 2 99999999999999999999\n", "a.obj:5: '99999999999999999999' is no corner of a face");
    check_obj_refused("f 1 2 x\n", "a.obj:5: 'x' is no corner of a face");
    check_obj_refused("f 1 2\n", "a.obj:5: face 1 has 2 corners, fewer than three");
    check_obj_refused("f 1 \\\n2\n", "a.obj:5: face 1 has 2 corners");
    check_obj_refused("f\n", "a.obj:5: face 1 has 0 corners");
    check_obj_refused("v 1 2\n", "a.obj:5: a vertex has fewer than three coordinates");
    check_obj_refused("v 1 nan 2\n", "a.obj:5: y is 'nan', no finite number");
    check_obj_refused("v 1 2 -inf\n", "a.obj:5: z is '-inf', no finite number");
    check_obj_refused("v 1 2 0x10\n", "a.obj:5: z is '0x10', no finite number");
    check_obj_refused("surf 0 1 0 1\n", "a.obj:5: 'surf' is not read: a solid is bounded by faces");
    check_obj_refused("# nothing\n", "a.obj: has no face (OBJ)");
}

}  // namespace musim::lsdem
