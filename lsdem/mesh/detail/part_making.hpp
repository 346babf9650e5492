#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lsdem/mesh/mesh.hpp"
#include "lsdem/mesh/split_mesh.hpp"

namespace musim::lsdem::detail {

/// Makes parts of a mesh, each face of which belongs to one.
class PartMaking {
  public:
    PartMaking(const Mesh& mesh, const MeshLimits& limits);

    /// The closed surface of some faces, wound outwards by its volume, with corners joined by `points`, and checked as `split_mesh` says.
    /// `partners`: for each edge of it, the place in the mesh's loops of the same edge of the other face.
    ClosedPart make(std::span<const std::uint32_t> faces, std::span<const std::uint32_t> points, std::span<const std::uint32_t> partners);

  private:
    void wind_alike(std::uint32_t first, std::span<const std::uint32_t> points, std::span<const std::uint32_t> partners);
    void copy_faces(std::span<const std::uint32_t> faces, std::span<const std::uint32_t> points, ClosedPart& part);

    const Mesh* mesh_;
    MeshLimits limits_;
    std::vector<std::uint32_t> face_at_;  // of each place in the mesh's loops
    std::vector<bool> reached_, turned_;  // of each face: it is wound like those before it, which turns it
    std::vector<std::uint32_t> corners_;  // of the part, for the points that it has
    std::vector<bool> used_;              // of each vertex: a part has it
};

/// Throws MeshError for faces that bound nothing: names an edge of three faces or more, or the first edge of one face and their number.
[[noreturn]] void fail_open(const Mesh& mesh, std::span<const std::uint32_t> faces, std::span<const std::uint32_t> points);

}  // namespace musim::lsdem::detail
