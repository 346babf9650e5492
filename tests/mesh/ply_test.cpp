#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "lsdem/mesh/read_mesh.hpp"
#include "lsdem/mesh/split_mesh.hpp"
#include "tests/mesh/made_meshes.hpp"

namespace musim::lsdem {
namespace {

constexpr int kQuads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

/// The writing of a cube of edge 2.
struct PlyWriting {
    std::string format = "ascii", line = "\n", coordinate = "float", count = "uchar", index = "int", list = "vertex_indices";
};

template <class Number>
std::string put(double value, bool big) {
    std::string bytes = tests::to_bytes(static_cast<Number>(value));
    if (big) std::reverse(bytes.begin(), bytes.end());
    return bytes;
}

std::string write_number(const PlyWriting& writing, const std::string& type, double value) {
    if (writing.format == "ascii") return fmt::format("{} ", value);
    const bool big = writing.format == "binary_big_endian";
    if (type == "char" || type == "int8") return put<std::int8_t>(value, big);
    if (type == "uchar" || type == "uint8") return put<std::uint8_t>(value, big);
    if (type == "short" || type == "int16") return put<std::int16_t>(value, big);
    if (type == "ushort" || type == "uint16") return put<std::uint16_t>(value, big);
    if (type == "int" || type == "int32") return put<std::int32_t>(value, big);
    if (type == "uint" || type == "uint32") return put<std::uint32_t>(value, big);
    return type == "float" || type == "float32" ? put<float>(value, big) : put<double>(value, big);
}

/// The cube of edge 2, its corners from (-1, -1, -1) on, with properties and elements that no reader of meshes needs.
std::string write_ply(const PlyWriting& w) {
    std::string text = "ply" + w.line + "format " + w.format + " 1.0" + w.line + "comment element face 7" + w.line;
    for (const std::string& line :
         {std::string("element camera 2"), std::string("property short id"), std::string("property list uchar double matrix"),
          std::string("element vertex 8"), "property " + w.coordinate + " x", "property " + w.coordinate + " y",
          std::string("property uchar red"), "property " + w.coordinate + " z", std::string("property list uchar float weights"),
          std::string("obj_info made for a test"), std::string("element face 6"), std::string("property float quality"),
          "property list " + w.count + " " + w.index + " " + w.list, std::string("property list ushort float texcoord"),
          std::string("element edge 1"), std::string("property int vertex1"), std::string("end_header")}) {
        text += line + w.line;
    }
    const std::string end = w.format == "ascii" ? w.line : "";
    for (int camera = 0; camera < 2; ++camera) {
        text += write_number(w, "short", -7) + write_number(w, "uchar", camera);
        for (int i = 0; i < camera; ++i) text += write_number(w, "double", 0.5);
        text += end;
    }
    for (unsigned c = 0; c < 8; ++c) {
        text += write_number(w, w.coordinate, (c & 1U) != 0 ? 1.0 : -1.0) + write_number(w, w.coordinate, (c & 2U) != 0 ? 1.0 : -1.0);
        text += write_number(w, "uchar", 255) + write_number(w, w.coordinate, (c & 4U) != 0 ? 1.0 : -1.0);
        text += write_number(w, "uchar", 1) + write_number(w, "float", 0.25) + end;
    }
    for (const auto& quad : kQuads) {
        text += write_number(w, "float", 1.5) + write_number(w, w.count, 4);
        for (const int corner : quad) text += write_number(w, w.index, corner);
        text += write_number(w, "ushort", 2) + write_number(w, "float", 0.0) + write_number(w, "float", 1.0) + end;
    }
    return text + write_number(w, "int", 3) + end;
}

void check_cube(const PlyWriting& writing) {
    CAPTURE(writing.format);
    CAPTURE(writing.coordinate);
    CAPTURE(writing.count);
    CAPTURE(writing.index);
    const ClosedParts mesh = split_mesh(parse_ply(write_ply(writing), "a.ply"));
    REQUIRE(mesh.parts.size() == 1);
    CHECK(mesh.parts[0].volume == doctest::Approx(8.0).epsilon(1e-15));
    CHECK(mesh.parts[0].corners.size() == 8);
    CHECK(mesh.parts[0].turned == 0);
}

void check_ply_refused(const std::string& text, std::string_view said) {
    tests::check_mesh_refused([&] { parse_ply(text, "a.ply"); }, said);
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

}  // namespace

TEST_CASE("a PLY is read in its three formats, with lists of any whole numbers, and what it has besides is read over") {
    for (const char* const format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
        for (const char* const type :
             {"char", "uchar", "short", "ushort", "int", "uint", "int8", "uint8", "int16", "uint16", "int32", "uint32"}) {
            check_cube({.format = format, .line = "\n", .coordinate = "float", .count = type, .index = type, .list = "vertex_index"});
        }
        for (const char* const type : {"float", "double", "float32", "float64", "short", "char"}) {
            check_cube({.format = format, .line = "\n", .coordinate = type, .count = "uchar", .index = "int", .list = "vertex_indices"});
        }
    }
}

TEST_CASE("lines of a PLY's header may end in any way") {
    for (const char* const format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
        for (const char* const line : {"\n", "\r\n", "\r"}) {
            check_cube({.format = format, .line = line, .coordinate = "float", .count = "uchar", .index = "int", .list = "vertex_indices"});
        }
    }
    // the first byte behind the header looks like the end of a line
    std::string text =
        "ply\rformat binary_little_endian 1.0\relement mark 1\rproperty uchar value\relement vertex 3\rproperty uchar x\r"
        "property uchar y\rproperty uchar z\relement face 1\rproperty list uchar uchar vertex_index\rend_header\r\n";
    text += std::string("\0\0\0\1\0\0\0\1\0\3\0\1\2", 13);
    CHECK(parse_ply(text, "a.ply").vertices == std::vector<Vector3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
}

TEST_CASE("binary numbers of 32 bits are known as such") {
    PlyWriting writing;
    CHECK(!parse_ply(write_ply(writing), "a.ply").single_precision);
    writing.format = "binary_big_endian";
    CHECK(parse_ply(write_ply(writing), "a.ply").single_precision);
    writing.coordinate = "double";
    CHECK(!parse_ply(write_ply(writing), "a.ply").single_precision);
}

TEST_CASE("wrong headers and rows of a PLY are refused with their line") {
    const std::string text = write_ply({});
    check_ply_refused("", "a.ply:1: is no PLY: it does not begin with 'ply'");
    check_ply_refused("ply end_header", "a.ply:1: has no element face");
    check_ply_refused("ply\nformat ascii 1.0\nelement vertex 3\n", "the file's end stands in the header; the file has lost its end");
    check_ply_refused(replaced(text, "ascii", "utf8"), "a.ply:2: 'utf8' is no format of a PLY");
    check_ply_refused(replaced(text, "float x", "real x"), "a.ply:8: 'real' is no type of a property");
    check_ply_refused(replaced(text, "list uchar int", "list float int"), "a.ply:16: the count of a list is no whole number");
    check_ply_refused(replaced(text, "list uchar int", "list uchar float"), "element face has no list vertex_indices of whole numbers");
    check_ply_refused(replaced(text, "float z", "float w"), "element vertex has not the properties x, y and z");
    check_ply_refused(replaced(text, "element face 6", "element facet 6"), "a.ply:38: has no element face");
    check_ply_refused(replaced(text, "element vertex 8", "element vertex -8"), "a.ply:7: element 'vertex' has '-8' rows");
    check_ply_refused(replaced(text, "-1 -1 255", "-1 nan 255"), "a.ply:23: y is 'nan', no finite number");
    check_ply_refused(replaced(text, "4 0 4 6 2", "4 0 4 6 -2"), "a.ply:31: a corner of face 1 is vertex -2");
    check_ply_refused(replaced(text, "4 0 4 6 2", "4 0 4 6 8"), "a.ply:31: face 1 has a corner that is vertex 8, counted from 0, of 8");
    check_ply_refused(replaced(text, "4 0 4 6 2", "4 0 4 6.5 2"), "a.ply:31: a corner is '6.5', no whole number");
    check_ply_refused(replaced(text, "4 0 4 6 2", "2 0 4"), "a.ply:31: face 1 has 2 corners, fewer than three");
    check_ply_refused(text + "7\n", "something stands behind the rows that the header counts");
    check_ply_refused(text.substr(0, text.size() - 3), "the last rows of the header's elements are missing");
}

TEST_CASE("wrong rows of a binary PLY are refused") {
    const std::string bytes = write_ply({.format = "binary_little_endian",
                                         .line = "\n",
                                         .coordinate = "double",
                                         .count = "uchar",
                                         .index = "int",
                                         .list = "vertex_indices"});
    check_ply_refused(bytes + "x", "a.ply: something stands behind the rows that the header counts");
    check_ply_refused(bytes.substr(0, bytes.size() - 1), "a.ply: the last rows of the header's elements are missing");
    check_ply_refused(replaced(bytes, "element face 6", "element face 4000000000"),
                      "a.ply: the last rows of the header's elements are missing");
    check_ply_refused(replaced(bytes, "element camera 2", "element camera 4000000000"), "a.ply:");
    check_ply_refused(replaced(bytes, tests::to_bytes(1.0), tests::to_bytes(std::numeric_limits<double>::quiet_NaN())),
                      "a.ply: x of vertex 1, counted from 0, is nan");
}

}  // namespace musim::lsdem
