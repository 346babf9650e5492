#include "lsdem/mesh/detail/mesh_making.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace musim::lsdem::detail {

void fail_mesh(const std::string& file, std::size_t line, const std::string& problem, const std::string& remedy) {
    throw MeshError(line == 0 ? fmt::format("{}: {}", file, problem) : fmt::format("{}:{}: {}", file, line, problem), Remedy(remedy));
}

MeshMaking::MeshMaking(const std::string& file, std::string_view format, const MeshLimits& limits) : limits_(limits) {
    mesh_.file = file;
    mesh_.format = format;
    choose_group({});
}

void MeshMaking::add_vertex(const Vector3& vertex) {
    // three of its own for each triangle, and as many again that no face uses
    const std::size_t most = 6 * limits_.triangles;
    if (mesh_.vertices.size() >= most) {
        fail_mesh(mesh_.file, 0, fmt::format("has more than {} vertices, six times the limit of triangles", most), "take a coarser mesh");
    }
    mesh_.vertices.push_back(vertex);
}

void MeshMaking::choose_group(const Mesh::Group& group) {
    const auto [found, is_new] = groups_.try_emplace({group.object, group.name}, static_cast<std::uint32_t>(mesh_.groups.size()));
    if (is_new) mesh_.groups.push_back(group);
    group_ = found->second;
}

void MeshMaking::add_corner(std::uint32_t vertex) {
    // a face of n corners is n - 2 triangles
    if (mesh_.loops.size() >= limits_.triangles + 2 * (mesh_.faces.size() + 1)) {
        fail_mesh(mesh_.file, 0, fmt::format("has more than {} triangles, the limit", limits_.triangles), "take a coarser mesh");
    }
    mesh_.loops.push_back(vertex);
}

void MeshMaking::end_face(std::size_t line) {
    const std::size_t count = mesh_.loops.size() - ended_;
    if (count < 3) {
        fail_mesh(mesh_.file, line, fmt::format("face {} has {} corners, fewer than three", mesh_.faces.size() + 1, count),
                  "correct or remove it");
    }
    mesh_.faces.push_back({.first = static_cast<std::uint32_t>(ended_),
                           .count = static_cast<std::uint32_t>(count),
                           .group = group_,
                           .line = static_cast<std::uint32_t>(std::min<std::size_t>(line, std::numeric_limits<std::uint32_t>::max()))});
    ended_ = mesh_.loops.size();
}

Mesh MeshMaking::take() {
    if (mesh_.faces.empty()) fail_mesh(mesh_.file, 0, fmt::format("has no face ({})", mesh_.format), "is it the right file?");
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
        const Mesh::Face& face = mesh_.faces[f];
        for (const std::uint32_t corner : mesh_.loop(face)) {
            if (corner >= mesh_.vertices.size()) {
                fail_mesh(mesh_.file, face.line,
                          fmt::format("{} has a corner that is vertex {}, counted from 0, of {}", name_face(f + 1, face.count, 0), corner,
                                      mesh_.vertices.size()),
                          "correct the face; has the file lost its end?");
            }
        }
    }
    return std::move(mesh_);
}

std::string name_face(std::size_t number, std::size_t corners, std::size_t line) {
    const std::string name = fmt::format("{} {}", corners == 3 ? "triangle" : "face", number);
    return line == 0 ? name : fmt::format("{} (line {})", name, line);
}

std::string name_point(const Vector3& x) { return fmt::format("({:.9g}, {:.9g}, {:.9g})", x.x(), x.y(), x.z()); }

}  // namespace musim::lsdem::detail
