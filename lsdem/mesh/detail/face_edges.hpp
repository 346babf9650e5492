#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lsdem/mesh/mesh.hpp"

namespace musim::lsdem::detail {

/// An edge of a face, from a corner to the face's next one.
struct FaceEdge {
    std::uint32_t low = 0, high = 0;  ///< numbers of its ends; the same for the other faces at this edge
    std::uint32_t face = 0;           ///< its place in the list of faces
    std::uint32_t at = 0;             ///< of its first corner in the mesh's loops
};

/// The edges of some faces, sorted by their ends, then by their place in the mesh. `points`: the number of each vertex.
std::vector<FaceEdge> list_edges(const Mesh& mesh, std::span<const std::uint32_t> faces, std::span<const std::uint32_t> points);

/// Where the uses of the edge at `first` end: `edges` are sorted.
std::size_t find_edge_end(std::span<const FaceEdge> edges, std::size_t first);

/// Closed surfaces among some faces, and the faces left over.
struct ClosedSurfaces {
    std::vector<std::vector<std::uint32_t>> surfaces;  ///< numbers of faces, ascending
    std::vector<std::uint32_t> open;
};

/// Finds closed surfaces. A run of faces at whose end no edge is open, each having been met an even number of times, is one surface or
/// several, and nothing behind it belongs to it; within a run faces hang together by edges of two faces. `partners`
/// gets, for each edge of a closed surface, its place in the loop of the other face. `faces`: ascending.
ClosedSurfaces find_closed_surfaces(const Mesh& mesh, std::span<const std::uint32_t> faces, std::span<const std::uint32_t> points,
                                    std::vector<std::uint32_t>& partners);

}  // namespace musim::lsdem::detail
