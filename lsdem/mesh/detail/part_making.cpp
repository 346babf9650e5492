#include "lsdem/mesh/detail/part_making.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "lsdem/mesh/detail/face_edges.hpp"
#include "lsdem/mesh/detail/mesh_making.hpp"

namespace musim::lsdem::detail {
namespace {

constexpr std::uint32_t kNoCorner = std::numeric_limits<std::uint32_t>::max();

std::string name_face_of(const Mesh& mesh, std::uint32_t face) {
    return name_face(face + 1U, mesh.faces[face].count, mesh.faces[face].line);
}

const Vector3& corner_at(const Mesh& mesh, std::uint32_t at) { return mesh.vertices[mesh.loops[at]]; }

/// The place in the mesh's loops of the corner behind `at` in a face.
std::uint32_t find_next(const Mesh::Face& face, std::uint32_t at) { return face.first + (at - face.first + 1) % face.count; }

std::string name_edge(const Mesh& mesh, std::uint32_t face, std::uint32_t at) {
    return fmt::format("the edge from {} to {}", name_point(corner_at(mesh, at)),
                       name_point(corner_at(mesh, find_next(mesh.faces[face], at))));
}

/// All corners of a face for a message, the first four of more.
std::string name_corners(const Mesh& mesh, std::uint32_t face) {
    std::string text;
    for (std::uint32_t i = 0; i < std::min(mesh.faces[face].count, 4U); ++i) {
        if (i > 0) text += ' ';
        text += name_point(corner_at(mesh, mesh.faces[face].first + i));
    }
    return mesh.faces[face].count > 4 ? text + " ..." : text;
}

/// A surface in a frame in which no number of the file costs digits: about one of its corners, in parts of its size.
struct LocalFrame {
    Vector3 origin = Vector3::Zero();
    double size = 0.0;

    Vector3 operator()(const Vector3& x) const { return (x - origin) / size; }
};

LocalFrame find_frame(const Mesh& mesh, std::span<const std::uint32_t> faces) {
    Vector3 low = corner_at(mesh, mesh.faces[faces.front()].first), high = low;
    for (const std::uint32_t f : faces) {
        for (const std::uint32_t corner : mesh.loop(mesh.faces[f])) {
            low = low.cwiseMin(mesh.vertices[corner]);
            high = high.cwiseMax(mesh.vertices[corner]);
        }
    }
    LocalFrame frame{.origin = corner_at(mesh, mesh.faces[faces.front()].first), .size = (high - low).maxCoeff()};
    // beyond, cubes of lengths are no doubles
    constexpr double kLargest = 1e90;
    if (!(frame.size > 1.0 / kLargest && frame.size < kLargest)) {
        fail_mesh(mesh.file, mesh.faces[faces.front()].line, fmt::format("a part has the size {}", frame.size), "correct its coordinates");
    }
    return frame;
}

/// The area of a face as a vector along its normal, by Newell's sum, and three times the volume of the pyramid from
/// `frame`'s origin to it, in parts of the size. Fails for a face too small to have a normal, and for one that is not plane.
struct FaceSums {
    Vector3 area = Vector3::Zero();
    double volume = 0.0;
};

FaceSums sum_face(const Mesh& mesh, std::uint32_t number, const LocalFrame& frame, const MeshLimits& limits) {
    const Mesh::Face& face = mesh.faces[number];
    const Vector3 first = frame(corner_at(mesh, face.first));
    FaceSums sums;
    Vector3 before = Vector3::Zero(), mean = Vector3::Zero();
    for (std::uint32_t i = 1; i < face.count; ++i) {
        const Vector3 here = frame(corner_at(mesh, face.first + i)) - first;
        sums.area += 0.5 * before.cross(here);
        mean += here / face.count;
        before = here;
    }
    sums.volume = first.dot(sums.area);
    const double area = sums.area.norm();
    if (!(area >= kLeastArea)) {
        fail_mesh(mesh.file, face.line,
                  fmt::format("{} has an area of {:.3g} of its body's size squared (limit {:.0e}): {}", name_face_of(mesh, number), area,
                              kLeastArea, name_corners(mesh, number)),
                  "remove it and close the gap");
    }
    for (std::uint32_t i = 0; i < face.count && face.count > 3; ++i) {
        const Vector3& corner = corner_at(mesh, face.first + i);
        const double height = std::abs(sums.area.dot(frame(corner) - first - mean)) / area;
        if (height > limits.dent) {
            fail_mesh(mesh.file, face.line,
                      fmt::format("{} is not plane: its corner {} lies {:.3g} off its mean plane", name_face_of(mesh, number),
                                  name_point(corner), height * frame.size),
                      "split it into triangles");
        }
    }
    return sums;
}

/// The name that all faces share: of the group, or of the object.
std::string find_name(const Mesh& mesh, std::span<const std::uint32_t> faces) {
    const Mesh::Group& group = mesh.groups[mesh.faces[faces.front()].group];
    const bool one =
        std::all_of(faces.begin(), faces.end(), [&](std::uint32_t f) { return mesh.faces[f].group == mesh.faces[faces[0]].group; });
    return one && !group.name.empty() ? group.name : group.object;
}

/// Refuses an edge of three faces or more.
[[noreturn]] void fail_crowded(const Mesh& mesh, std::span<const FaceEdge> uses) {
    constexpr std::size_t kNamed = 4;
    std::string names;
    for (std::size_t e = 0; e < std::min(uses.size(), kNamed); ++e) {
        if (e > 0) names += ", ";
        names += name_face_of(mesh, uses[e].face);
    }
    fail_mesh(mesh.file, mesh.faces[uses.front().face].line,
              fmt::format("{} belongs to {} faces: {}{}", name_edge(mesh, uses.front().face, uses.front().at), uses.size(), names,
                          uses.size() > kNamed ? " ..." : ""),
              "an edge of a solid has two; write solids that touch one after the other");
}

/// The end of some edges that is nearest to a point without being there, and its distance.
std::pair<Vector3, double> find_beside(const Mesh& mesh, std::span<const FaceEdge> edges, const Vector3& point) {
    std::pair<Vector3, double> nearest{point, std::numeric_limits<double>::infinity()};
    for (const FaceEdge& edge : edges) {
        for (const std::uint32_t at : {edge.at, find_next(mesh.faces[edge.face], edge.at)}) {
            const double distance = (corner_at(mesh, at) - point).norm();
            if (distance > 0.0 && distance < nearest.second) nearest = {corner_at(mesh, at), distance};
        }
    }
    return nearest;
}

}  // namespace

PartMaking::PartMaking(const Mesh& mesh, const MeshLimits& limits)
    : mesh_(&mesh),
      limits_(limits),
      face_at_(mesh.loops.size()),
      reached_(mesh.faces.size(), false),
      turned_(mesh.faces.size(), false),
      corners_(mesh.vertices.size(), kNoCorner),
      used_(mesh.vertices.size(), false) {
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        for (std::uint32_t i = 0; i < mesh.faces[f].count; ++i) face_at_[mesh.faces[f].first + i] = f;
    }
}

ClosedPart PartMaking::make(std::span<const std::uint32_t> faces, std::span<const std::uint32_t> points,
                            std::span<const std::uint32_t> partners) {
    const LocalFrame frame = find_frame(*mesh_, faces);
    wind_alike(faces.front(), points, partners);
    double area = 0.0, volume = 0.0;
    for (const std::uint32_t f : faces) {
        const FaceSums sums = sum_face(*mesh_, f, frame, limits_);
        area += sums.area.norm();
        volume += turned_[f] ? -sums.volume : sums.volume;
    }
    volume /= 3.0;
    if (std::abs(volume) < kLeastVolume) {
        fail_mesh(mesh_->file, mesh_->faces[faces.front()].line,
                  fmt::format("{} faces from {} on, with corners {}, close no volume ({:.3g} of the size cubed)", faces.size(),
                              name_face_of(*mesh_, faces.front()), name_corners(*mesh_, faces.front()), volume),
                  "a solid needs a thickness");
    }
    if (volume < 0.0) {
        for (const std::uint32_t f : faces) turned_[f] = !turned_[f];
    }

    ClosedPart part;
    part.name = find_name(*mesh_, faces);
    part.size = frame.size;
    part.area = area * frame.size * frame.size;
    part.volume = std::abs(volume) * frame.size * frame.size * frame.size;
    copy_faces(faces, points, part);
    return part;
}

/// Marks the faces to be turned so that each edge is met in both directions, the first face not among them.
void PartMaking::wind_alike(std::uint32_t first, std::span<const std::uint32_t> points, std::span<const std::uint32_t> partners) {
    std::vector<std::uint32_t> next{first};
    reached_[first] = true;
    while (!next.empty()) {
        const std::uint32_t f = next.back();
        next.pop_back();
        const Mesh::Face& face = mesh_->faces[f];
        for (std::uint32_t at = face.first; at < face.first + face.count; ++at) {
            const std::uint32_t other = face_at_[partners[at]];
            const bool alike = points[mesh_->loops[at]] == points[mesh_->loops[partners[at]]];  // both begin the edge at the same end
            const bool turn = turned_[f] != alike;
            if (!reached_[other]) {
                reached_[other] = true;
                turned_[other] = turn;
                next.push_back(other);
            } else if (turned_[other] != turn) {
                fail_mesh(mesh_->file, face.line,
                          fmt::format("{} and {} meet at {}, and cannot both be wound outwards: the surface has one side",
                                      name_face_of(*mesh_, std::min(f, other)), name_face_of(*mesh_, std::max(f, other)),
                                      name_edge(*mesh_, f, at)),
                          "correct the mesh");
            }
        }
    }
}

/// Copies the faces, wound outwards, with their corners in the order of their first use.
void PartMaking::copy_faces(std::span<const std::uint32_t> faces, std::span<const std::uint32_t> points, ClosedPart& part) {
    for (const std::uint32_t f : faces) {
        const Mesh::Face& face = mesh_->faces[f];
        const auto first = static_cast<std::uint32_t>(part.loops.size());
        for (const std::uint32_t vertex : mesh_->loop(face)) {
            if (!used_[vertex]) ++part.corners_read;
            used_[vertex] = true;
            std::uint32_t& corner = corners_[points[vertex]];
            if (corner == kNoCorner) {
                corner = static_cast<std::uint32_t>(part.corners.size());
                part.corners.push_back(mesh_->vertices[vertex]);
            }
            part.loops.push_back(corner);
        }
        if (turned_[f]) std::reverse(part.loops.begin() + first, part.loops.end());
        if (turned_[f]) ++part.turned;
        part.faces.push_back({.first = first, .count = face.count, .number = f + 1, .line = face.line});
    }
    // other parts may have the same points, and vertices of their own number
    for (const std::uint32_t f : faces) {
        for (const std::uint32_t vertex : mesh_->loop(mesh_->faces[f])) corners_[points[vertex]] = kNoCorner, used_[vertex] = false;
    }
}

void fail_open(const Mesh& mesh, std::span<const std::uint32_t> faces, std::span<const std::uint32_t> points) {
    std::vector<bool> left(mesh.faces.size(), false);
    for (const std::uint32_t f : faces) left[f] = true;
    std::vector<std::uint32_t> all(mesh.faces.size());
    std::iota(all.begin(), all.end(), 0U);
    const std::vector<FaceEdge> edges = list_edges(mesh, all, points);

    std::vector<FaceEdge> single;
    for (std::size_t first = 0, last = 0; first < edges.size(); first = last) {
        last = find_edge_end(edges, first);
        const auto uses = std::span(edges).subspan(first, last - first);
        const auto open = std::count_if(uses.begin(), uses.end(), [&](const FaceEdge& edge) { return left[edge.face]; });
        if (open == 0 || (open == 2 && uses.size() > 2)) continue;  // closed, or beside a part that is
        if (uses.size() > 2) fail_crowded(mesh, uses);
        if (open == 1) single.push_back(*std::find_if(uses.begin(), uses.end(), [&](const FaceEdge& edge) { return left[edge.face]; }));
    }
    const FaceEdge& first =
        *std::min_element(single.begin(), single.end(), [](const FaceEdge& a, const FaceEdge& b) { return a.at < b.at; });
    const Mesh::Face& face = mesh.faces[first.face];
    const Mesh::Group& group = mesh.groups[face.group];
    const std::string& name = group.name.empty() ? group.object : group.name;
    std::string problem =
        fmt::format("the surface{} is open: {} {} to one face only, {}{} of {}", name.empty() ? "" : fmt::format(" '{}'", name),
                    single.size(), single.size() == 1 ? "edge belongs" : "edges belong", single.size() == 1 ? "" : "the first is ",
                    name_edge(mesh, first.face, first.at), name_face_of(mesh, first.face));

    // a corner that is nearly the same is what a careless writer makes of one
    const Vector3 corner = corner_at(mesh, first.at), length = corner_at(mesh, find_next(face, first.at)) - corner;
    const auto [near, distance] = find_beside(mesh, single, corner);
    const bool beside = distance < 1e-3 * length.norm();
    if (beside) problem += fmt::format("; the corner {} lies {:.3g} beside its beginning", name_point(near), distance);
    fail_mesh(mesh.file, face.line, problem, beside ? "give corners that are one the same digits: only those are joined" : "close it");
}

}  // namespace musim::lsdem::detail
