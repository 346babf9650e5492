#include "lsdem/mesh/split_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <string_view>
#include <tuple>

#include "lsdem/mesh/detail/face_edges.hpp"
#include "lsdem/mesh/detail/mesh_making.hpp"
#include "lsdem/mesh/detail/part_making.hpp"

namespace musim::lsdem {
namespace {

/// For each vertex the first one of the same coordinates.
std::vector<std::uint32_t> find_equal_vertices(const std::vector<Vector3>& vertices) {
    std::vector<std::uint32_t> order(vertices.size()), first(vertices.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        for (Eigen::Index i = 0; i < 3; ++i) {
            if (vertices[a][i] != vertices[b][i]) return vertices[a][i] < vertices[b][i];
        }
        return a < b;
    });
    for (std::size_t i = 0; i < order.size(); ++i) {
        first[order[i]] = i > 0 && vertices[order[i]] == vertices[order[i - 1]] ? first[order[i - 1]] : order[i];
    }
    return first;
}

/// Numbers of the faces but for triangles two of whose corners are equal: they are the edge that their neighbours share without them.
std::vector<std::uint32_t> leave_out_edges(const Mesh& mesh, std::span<const std::uint32_t> points) {
    std::vector<std::uint32_t> kept, corners;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        const Mesh::Face& face = mesh.faces[f];
        corners.clear();
        for (const std::uint32_t vertex : mesh.loop(face)) corners.push_back(points[vertex]);
        std::sort(corners.begin(), corners.end());
        const auto twice = std::adjacent_find(corners.begin(), corners.end());
        if (twice == corners.end()) {
            kept.push_back(f);
        } else if (face.count > 3) {
            detail::fail_mesh(mesh.file, face.line,
                              fmt::format("face {} has the corner {} twice", f + 1, detail::name_point(mesh.vertices[*twice])),
                              "split it in two");
        }
    }
    return kept;
}

/// Which faces may share a surface: those of one group, of one object, or all.
enum class Together { group, object, all };

std::vector<std::vector<std::uint32_t>> sort_faces(const Mesh& mesh, const std::vector<std::uint32_t>& faces, Together together) {
    std::map<std::string, std::uint32_t> objects;
    std::vector<std::uint32_t> keys;
    for (const Mesh::Group& group : mesh.groups) {
        const auto number = static_cast<std::uint32_t>(keys.size());
        keys.push_back(together == Together::all     ? 0
                       : together == Together::group ? number
                                                     : objects.try_emplace(group.object, number).first->second);
    }
    std::vector<std::vector<std::uint32_t>> sorted(mesh.groups.size());
    for (const std::uint32_t face : faces) sorted[keys[mesh.faces[face].group]].push_back(face);
    return sorted;
}

struct SplitStep {
    bool joined;  ///< vertices of equal coordinates count as one
    Together together;
};

}  // namespace

ClosedParts split_mesh(const Mesh& mesh, const MeshLimits& limits) {
    std::vector<std::uint32_t> own(mesh.vertices.size());
    std::iota(own.begin(), own.end(), 0U);
    const std::vector<std::uint32_t> equal = find_equal_vertices(mesh.vertices);
    std::vector<std::uint32_t> rest = leave_out_edges(mesh, equal);
    const std::size_t left_out = mesh.faces.size() - rest.size();
    if (rest.empty()) detail::fail_mesh(mesh.file, 0, "all triangles have two equal corners", "were its numbers rounded too far?");

    // the narrowest step that closes a surface decides: what the file keeps apart stays apart
    constexpr std::array kSteps{SplitStep{false, Together::group}, SplitStep{true, Together::group}, SplitStep{false, Together::object},
                                SplitStep{true, Together::object}, SplitStep{true, Together::all}};
    detail::PartMaking making(mesh, limits);
    std::vector<std::pair<std::uint32_t, ClosedPart>> found;
    std::vector<std::uint32_t> partners(mesh.loops.size());
    for (const SplitStep& step : kSteps) {
        if (!step.joined && !mesh.indexed) continue;
        const std::vector<std::uint32_t>& points = step.joined ? equal : own;
        // again as long as something is closed: what it touched may then be clear
        for (std::size_t before = rest.size() + 1; !rest.empty() && rest.size() < before;) {
            before = rest.size();
            std::vector<std::uint32_t> open;
            for (const std::vector<std::uint32_t>& faces : sort_faces(mesh, rest, step.together)) {
                const detail::ClosedSurfaces closed = detail::find_closed_surfaces(mesh, faces, points, partners);
                for (const std::vector<std::uint32_t>& surface : closed.surfaces) {
                    found.emplace_back(surface.front(), making.make(surface, points, partners));
                }
                open.insert(open.end(), closed.open.begin(), closed.open.end());
            }
            std::sort(open.begin(), open.end());
            rest = std::move(open);
        }
    }
    if (!rest.empty()) detail::fail_open(mesh, rest, equal);

    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    ClosedParts result{
        .file = mesh.file, .format = mesh.format, .single_precision = mesh.single_precision, .left_out = left_out, .parts = {}};
    for (auto& part : found) {
        part.second.number = result.parts.size();
        result.parts.push_back(std::move(part.second));
    }
    return result;
}

std::string describe_parts(const ClosedParts& mesh) {
    std::size_t faces = 0, triangles = 0, read = 0, corners = 0, turned = 0;
    for (const ClosedPart& part : mesh.parts) {
        faces += part.faces.size();
        triangles += part.triangles();
        read += part.corners_read;
        corners += part.corners.size();
        turned += part.turned;
    }
    const auto count = [](std::size_t number, std::string_view noun) {
        return fmt::format("{} {}{}", number, noun, number == 1 ? "" : "s");
    };
    std::string text = fmt::format("{}: {}, {}{}", mesh.format, count(mesh.parts.size(), "closed part"),
                                   faces == triangles ? "" : fmt::format("{} of ", count(faces, "face")), count(triangles, "triangle"));
    text += fmt::format(", {}", count(read, "corner"));
    if (corners < read) text += fmt::format(" of which {} differ", corners);
    if (turned > 0) text += fmt::format("; {} turned outwards", count(turned, "face"));
    if (mesh.left_out > 0) text += fmt::format("; {} with two equal corners left out", count(mesh.left_out, "triangle"));
    return text;
}

}  // namespace musim::lsdem
