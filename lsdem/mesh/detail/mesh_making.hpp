#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "lsdem/mesh/mesh.hpp"

namespace musim::lsdem::detail {

/// Throws MeshError: `file:line: problem; remedy`, without the line where it is 0.
[[noreturn]] void fail_mesh(const std::string& file, std::size_t line, const std::string& problem, const std::string& remedy);

/// A mesh that a reader fills, face by face.
class MeshMaking {
  public:
    MeshMaking(const std::string& file, std::string_view format, const MeshLimits& limits);

    /// Adds a vertex; fails beyond the numbers of 32 bits. Coordinates are finite.
    void add_vertex(const Vector3& vertex);
    std::size_t vertices() const { return mesh_.vertices.size(); }

    /// Faces added from now on are of this group.
    void choose_group(const Mesh::Group& group);

    /// A corner of the next face: a vertex, which may be added later. Fails beyond the limit of triangles.
    void add_corner(std::uint32_t vertex);
    /// Ends the face of the corners added since the last one; fails with fewer than three.
    void end_face(std::size_t line);

    /// The mesh, complete. Fails without a face, and for a corner that is no vertex.
    Mesh take();

    Mesh& mesh() { return mesh_; }

  private:
    Mesh mesh_;
    MeshLimits limits_;
    std::size_t ended_ = 0;                                                // corners of complete faces
    std::map<std::pair<std::string, std::string>, std::uint32_t> groups_;  // by object and name
    std::uint32_t group_ = 0;
};

/// A face in a message: "triangle 7" or, of more corners, "face 7"; with " (line 50)" where it has a line. `number`: from 1.
std::string name_face(std::size_t number, std::size_t corners, std::size_t line);

/// A point in a message: "(0.5, 0, 1.25)".
std::string name_point(const Vector3& x);

}  // namespace musim::lsdem::detail
