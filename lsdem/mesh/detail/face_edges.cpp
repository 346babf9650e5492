#include "lsdem/mesh/detail/face_edges.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace musim::lsdem::detail {
namespace {

/// Sets that grow together.
class JoinedFaces {
  public:
    explicit JoinedFaces(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0U); }

    /// The first face of the set.
    std::uint32_t find(std::uint32_t face) {
        while (parents_[face] != face) face = parents_[face] = parents_[parents_[face]];
        return face;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = find(a), b = find(b);
        parents_[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<std::uint32_t> parents_;
};

/// The run of each face: it ends where every edge has been met an even number of times.
std::vector<std::uint32_t> number_runs(std::span<const FaceEdge> edges, std::size_t faces) {
    // an edge is open from its first use to its second, from its third to its fourth
    std::vector<std::int64_t> opened(faces, 0);
    for (std::size_t first = 0, last = 0; first < edges.size(); first = last) {
        last = find_edge_end(edges, first);
        for (std::size_t e = first; e < last; ++e) opened[edges[e].face] += (e - first) % 2 == 0 ? 1 : -1;
    }
    std::vector<std::uint32_t> runs(faces);
    std::int64_t open = 0;
    std::uint32_t run = 0;
    for (std::size_t f = 0; f < faces; ++f) {
        runs[f] = run;
        open += opened[f];
        if (open == 0) ++run;
    }
    return runs;
}

/// The first face, by edges of two faces of one run, of each face's component.
std::vector<std::uint32_t> find_components(std::span<const FaceEdge> edges, std::size_t faces) {
    const std::vector<std::uint32_t> runs = number_runs(edges, faces);
    JoinedFaces joined(faces);
    for (std::size_t first = 0, end = 0; first < edges.size();) {
        if (first == end) end = find_edge_end(edges, first);
        std::size_t last = first;
        while (last < end && runs[edges[last].face] == runs[edges[first].face]) ++last;
        if (last - first == 2) joined.join(edges[first].face, edges[first + 1].face);
        first = last;
    }
    std::vector<std::uint32_t> components(faces);
    for (std::uint32_t f = 0; f < faces; ++f) components[f] = joined.find(f);
    return components;
}

}  // namespace

std::vector<FaceEdge> list_edges(const Mesh& mesh, std::span<const std::uint32_t> faces, std::span<const std::uint32_t> points) {
    std::vector<FaceEdge> edges;
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        const Mesh::Face& face = mesh.faces[faces[f]];
        for (std::uint32_t i = 0; i < face.count; ++i) {
            const std::uint32_t at = face.first + i, next = face.first + (i + 1) % face.count;
            const auto [low, high] = std::minmax(points[mesh.loops[at]], points[mesh.loops[next]]);
            edges.push_back({low, high, f, at});
        }
    }
    std::sort(edges.begin(), edges.end(),
              [](const FaceEdge& a, const FaceEdge& b) { return std::tie(a.low, a.high, a.at) < std::tie(b.low, b.high, b.at); });
    return edges;
}

std::size_t find_edge_end(std::span<const FaceEdge> edges, std::size_t first) {
    std::size_t last = first;
    while (last < edges.size() && edges[last].low == edges[first].low && edges[last].high == edges[first].high) ++last;
    return last;
}

ClosedSurfaces find_closed_surfaces(const Mesh& mesh, std::span<const std::uint32_t> faces, std::span<const std::uint32_t> points,
                                    std::vector<std::uint32_t>& partners) {
    std::vector<FaceEdge> edges = list_edges(mesh, faces, points);
    const std::vector<std::uint32_t> components = find_components(edges, faces.size());

    // a component is closed when each of its edges has two of its faces
    std::vector<bool> closed(faces.size(), true);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (std::size_t first = 0, end = 0; first < edges.size();) {
        const auto component = [&](std::size_t e) { return components[edges[e].face]; };
        if (first == end) {
            end = find_edge_end(edges, first);
            std::sort(edges.begin() + static_cast<std::ptrdiff_t>(first), edges.begin() + static_cast<std::ptrdiff_t>(end),
                      [&](const FaceEdge& a, const FaceEdge& b) {
                          return std::pair(components[a.face], a.at) < std::pair(components[b.face], b.at);
                      });
        }
        std::size_t last = first;
        while (last < end && component(last) == component(first)) ++last;
        if (last - first == 2) {
            pairs.emplace_back(edges[first].at, edges[first + 1].at);
        } else {
            closed[component(first)] = false;
        }
        first = last;
    }

    ClosedSurfaces result;
    std::vector<std::uint32_t> numbers(faces.size());
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        const std::uint32_t component = components[f];
        if (!closed[component]) {
            result.open.push_back(faces[f]);
            continue;
        }
        if (component == f) {
            numbers[f] = static_cast<std::uint32_t>(result.surfaces.size());
            result.surfaces.emplace_back();
        }
        result.surfaces[numbers[component]].push_back(faces[f]);
    }
    for (const auto& [a, b] : pairs) partners[a] = b, partners[b] = a;
    return result;
}

}  // namespace musim::lsdem::detail
