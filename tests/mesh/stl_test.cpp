#include <doctest/doctest.h>

#include <limits>

#include "lsdem/mesh/read_mesh.hpp"
#include "lsdem/mesh/split_mesh.hpp"
#include "tests/mesh/made_meshes.hpp"

namespace musim::lsdem {
namespace {

using tests::check_mesh_refused;

const std::vector<tests::Triangle> kBlock = tests::make_box_triangles({0.0, 0.0, 0.0}, {1.0, 2.0, 4.0});

/// Checks that a text is the block of 1 x 2 x 4.
void check_block(std::string_view bytes, std::string_view format) {
    const Mesh mesh = parse_stl(bytes, "a.stl");
    CHECK(mesh.format == format);
    CHECK(mesh.faces.size() == 12);
    CHECK(mesh.vertices.size() == 36);
    const ClosedParts parts = split_mesh(mesh);
    REQUIRE(parts.parts.size() == 1);
    CHECK(parts.parts[0].volume == doctest::Approx(8.0).epsilon(1e-15));
    CHECK(parts.parts[0].area == doctest::Approx(28.0).epsilon(1e-15));
    CHECK(parts.parts[0].corners.size() == 8);
}

std::string replace_all(std::string text, std::string_view from, std::string_view to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) text.replace(at, from.size(), to);
    return text;
}

void check_text_refused(const std::string& text, std::string_view said) {
    check_mesh_refused([&] { parse_stl(text, "a.stl"); }, said);
}

}  // namespace

TEST_CASE("a text STL is read by words, wherever its lines end") {
    check_block(tests::write_text_stl(kBlock), "text STL");
    check_block(tests::write_text_stl(kBlock, "block", " ", " "), "text STL");
    check_block(tests::write_text_stl(kBlock, "block", "\n", "\n"), "text STL");
    check_block(tests::write_text_stl(kBlock, "block", "\t ", "\r\n"), "text STL");
    check_block(tests::write_text_stl(kBlock, "block", " ", "\r"), "text STL");
}

TEST_CASE("keywords of an STL may have capitals") {
    std::string text = tests::write_text_stl(kBlock);
    for (const auto& [from, to] : {std::pair("solid", "SOLID"), std::pair("facet", "Facet"), std::pair("vertex", "VERTEX"),
                                   std::pair("loop", "Loop"), std::pair("outer", "OUTER"), std::pair("normal", "Normal")}) {
        text = replace_all(text, from, to);
    }
    check_block(text, "text STL");
}

TEST_CASE("the name of a solid may be several words, keywords or none") {
    for (const std::string_view name : {"", "a key of the ring", "facet", "solid", "solid solid facet 1", "lower block  (left)"}) {
        CAPTURE(name);
        check_block(tests::write_text_stl(kBlock, name), "text STL");
        check_block(tests::write_text_stl(kBlock, name, " ", " "), "text STL");
    }
    const Mesh mesh = parse_stl(tests::write_text_stl(kBlock, "lower block") + tests::write_text_stl(kBlock, "upper block"), "a.stl");
    CHECK(mesh.groups[mesh.faces.front().group].name == "lower block");
    CHECK(mesh.groups[mesh.faces.back().group].name == "upper block");
    CHECK(mesh.faces.size() == 24);
}

TEST_CASE("normals of an STL are read over, whatever they are") {
    check_block(replace_all(tests::write_text_stl(kBlock), "normal 0 0 -1", "normal nan -nan(ind) 1e999"), "text STL");
}

TEST_CASE("the length decides that an STL is binary, whatever word it begins with") {
    for (const std::string_view header : {"solid block", "binary", "", "COLOR=abcd, solid"}) {
        check_block(tests::write_binary_stl(kBlock, std::string(header)), "binary STL");
    }
}

TEST_CASE("an STL that is cut or followed by something is refused") {
    const std::string bytes = tests::write_binary_stl(kBlock), text = tests::write_text_stl(kBlock);
    check_text_refused(bytes.substr(0, bytes.size() - 1), "a.stl: has 683 bytes, but its 12 triangles take 684; the file has lost its end");
    check_text_refused(bytes + "x", "has 685 bytes, but its 12 triangles take 684; write it again without what stands behind");
    check_text_refused(text.substr(0, text.size() / 2), "a.stl:");
    check_text_refused(text.substr(0, text.rfind("endsolid")), "the file's end stands where 'facet' should; the file has lost its end");
    check_text_refused(text + text.substr(text.find("facet"), text.find("endfacet") + 8 - text.find("facet")),
                       "a facet stands behind the end of its solid");
}

TEST_CASE("a header that promises four billion triangles takes no memory") {
    std::string bytes = tests::write_binary_stl(kBlock);
    bytes.replace(80, 4, "\xff\xff\xff\xff");
    check_text_refused(bytes, "has 684 bytes, but its 4294967295 triangles take 214748364834");
}

TEST_CASE("an STL without a facet is refused") {
    check_text_refused("solid empty\nendsolid empty\n", "a.stl: has no face (text STL)");
    check_text_refused(tests::write_binary_stl({}), "a.stl: has no face (binary STL)");
    check_text_refused("", "a.stl: is no STL");
    check_text_refused("v 0 0 0\n", "a.stl: is no STL");
}

TEST_CASE("wrong words and numbers of an STL are named with their line") {
    const std::string text = tests::write_text_stl(kBlock);
    check_text_refused(replace_all(text, "vertex 0 0 0", "vertex 0 nan 0"), "a.stl:4: y is 'nan', no finite number of a double");
    check_text_refused(replace_all(text, "vertex 0 0 0", "vertex 0 1e999 0"), "a.stl:4: y is '1e999', no finite number of a double");
    check_text_refused(replace_all(text, "vertex 0 0 0", "vertex 0 1,5 0"), "a.stl:4: y is '1,5'");
    check_text_refused(replace_all(text, "vertex 0 0 0", "vertex 0 0"), "a.stl:5: z is 'vertex'");
    check_text_refused(replace_all(text, "outer loop", "outer"), "a.stl:4: 'vertex' stands where 'loop' should");
    check_text_refused(replace_all(text, "normal 0 0 -1", "normal 0 0"), "a.stl:3: a normal has fewer than three numbers");
    std::vector<tests::Triangle> block = kBlock;
    block[6][1].y() = std::numeric_limits<double>::infinity();
    check_text_refused(tests::write_binary_stl(block), "a.stl: triangle 7 has a corner whose y is inf");
}

TEST_CASE("a mesh beyond the limit of triangles is refused with the number") {
    const MeshLimits few{.bytes = 1000, .triangles = 11, .faces = 100, .dent = 1e-5};
    check_mesh_refused([&] { parse_stl(tests::write_text_stl(kBlock), "a.stl", few); }, "a.stl: has more than 11 triangles, the limit");
    check_mesh_refused([&] { parse_stl(tests::write_binary_stl(kBlock), "a.stl", few); }, "a.stl: has more than 11 triangles, the limit");
}

TEST_CASE("a file's ending names its format, in any case") {
    const musim::tests::TemporaryFolder folder;
    CHECK(read_mesh(folder.write("a.STL", tests::write_binary_stl(kBlock))).format == "binary STL");
    CHECK(read_mesh(folder.write("a.Obj", tests::write_cube_obj({0, 0, 0}, 1))).format == "OBJ");
    check_mesh_refused([&] { read_mesh(folder.write("a.step", "ISO-10303-21;")); }, "a.step: ends in '.step', not in .stl, .obj or .ply");
    check_mesh_refused([&] { read_mesh(folder.path() / "b.stl"); }, "b.stl: cannot be read as a mesh: no such file");
    check_mesh_refused([&] { read_mesh(folder.path()); }, "cannot be read as a mesh: a folder");
    const MeshLimits few{.bytes = 683, .triangles = 100, .faces = 100, .dent = 1e-5};
    check_mesh_refused([&] { read_mesh(folder.write("c.stl", tests::write_binary_stl(kBlock)), few); }, "c.stl: has 684 bytes (limit 683)");
}

}  // namespace musim::lsdem
