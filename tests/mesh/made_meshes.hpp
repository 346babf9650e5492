#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "lsdem/mesh/mesh.hpp"
#include "tests/support/temporary_folder.hpp"

/// Meshes as texts and bytes.
namespace musim::lsdem::tests {

using Triangle = std::array<Vector3, 3>;

/// The twelve triangles of the box from `low` to `high`, wound outwards.
inline std::vector<Triangle> make_box_triangles(const Vector3& low, const Vector3& high) {
    const auto corner = [&](unsigned c) {
        return Vector3((c & 1U) != 0 ? high.x() : low.x(), (c & 2U) != 0 ? high.y() : low.y(), (c & 4U) != 0 ? high.z() : low.z());
    };
    constexpr unsigned kFaces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    std::vector<Triangle> triangles;
    for (const auto& face : kFaces) {
        triangles.push_back({corner(face[0]), corner(face[1]), corner(face[2])});
        triangles.push_back({corner(face[0]), corner(face[2]), corner(face[3])});
    }
    return triangles;
}

/// The same triangles wound the other way.
inline std::vector<Triangle> turned(std::vector<Triangle> triangles) {
    for (Triangle& triangle : triangles) std::swap(triangle[1], triangle[2]);
    return triangles;
}

inline std::vector<Triangle> joined(std::vector<Triangle> a, const std::vector<Triangle>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

/// A text STL. Its normals point in no useful direction: no reader may ask them. `space` stands between words, `line` where lines end.
inline std::string write_text_stl(const std::vector<Triangle>& triangles, std::string_view name = "block", std::string_view space = " ",
                                  std::string_view line = "\n") {
    std::string text = fmt::format("solid{}{}{}", space, name, line);
    for (const Triangle& triangle : triangles) {
        text += fmt::format("facet{0}normal{0}0{0}0{0}-1{1}outer{0}loop{1}", space, line);
        for (const Vector3& x : triangle) text += fmt::format("vertex{0}{1}{0}{2}{0}{3}{4}", space, x.x(), x.y(), x.z(), line);
        text += fmt::format("endloop{0}endfacet{0}", line);
    }
    return text + fmt::format("endsolid{}{}{}", space, name, line);
}

/// The bytes of a number, the least first.
template <class Number>
std::string to_bytes(Number number) {
    auto bytes = std::bit_cast<std::array<char, sizeof(Number)>>(number);
    if (std::endian::native == std::endian::big) std::reverse(bytes.begin(), bytes.end());
    return {bytes.begin(), bytes.end()};
}

/// A binary STL whose header is `header`, filled with blanks.
inline std::string write_binary_stl(const std::vector<Triangle>& triangles, std::string header = "solid of a CAD program") {
    header.resize(80, ' ');
    std::string bytes = header + to_bytes(static_cast<std::uint32_t>(triangles.size()));
    for (const Triangle& triangle : triangles) {
        bytes += std::string(12, '\0');
        for (const Vector3& x : triangle) {
            for (Eigen::Index a = 0; a < 3; ++a) bytes += to_bytes(static_cast<float>(x[a]));
        }
        bytes += std::string(2, '\x7f');
    }
    return bytes;
}

/// A cube of edge 1 from the origin on as the vertices and faces of an OBJ; `first`: the number of its first vertex.
inline std::string write_cube_obj(const Vector3& low, int first) {
    std::string text;
    for (unsigned c = 0; c < 8; ++c) {
        text += fmt::format("v {} {} {}\n", low.x() + (c & 1U), low.y() + ((c >> 1U) & 1U), low.z() + ((c >> 2U) & 1U));
    }
    constexpr int kFaces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (const auto& face : kFaces) {
        text += fmt::format("f {} {} {} {}\n", first + face[0], first + face[1], first + face[2], first + face[3]);
    }
    return text;
}

/// Checks that a call is refused in one line that holds `said`.
template <class Call>
void check_mesh_refused(Call&& call, std::string_view said) {
    const std::string message = musim::tests::message_of<MeshError>(call);
    CAPTURE(said);
    CAPTURE(message);
    CHECK(message.find(said) != std::string::npos);
    CHECK(message.find('\n') == std::string::npos);
}

}  // namespace musim::lsdem::tests
