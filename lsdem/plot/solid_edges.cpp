#include "lsdem/plot/solid_edges.hpp"

#include <algorithm>

namespace musim::lsdem {
namespace {

/// An edge of an outer face behind which its piece has an inner one.
struct JointEdge {
    std::size_t piece = 0, face = 0, at = 0;
    Vector3 from, to, normal;
};

std::vector<JointEdge> list_joint_edges(const Solid& solid) {
    std::vector<JointEdge> edges;
    for (std::size_t p = 0; p < solid.pieces.size(); ++p) {
        const Polyhedron& piece = solid.pieces[p];
        for (std::size_t f = 0; f < piece.faces.size(); ++f) {
            const Polyhedron::Face& face = piece.faces[f];
            for (std::uint32_t i = 0; i < face.count && face.outer; ++i) {
                if (piece.faces[piece.neighbours[face.first + i]].outer) continue;
                const Vector3 &from = piece.corners[piece.loops[face.first + i]],
                              &to = piece.corners[piece.loops[face.first + (i + 1) % face.count]];
                edges.push_back({p, f, i, from, to, face.plane.normal});
            }
        }
    }
    return edges;
}

}  // namespace

SolidEdges find_edges(const Solid& solid) {
    SolidEdges edges;
    for (const Polyhedron& piece : solid.pieces) {
        std::vector<std::vector<bool>>& of_piece = edges.drawn.emplace_back();
        for (const Polyhedron::Face& face : piece.faces) of_piece.emplace_back(face.count, true);
    }
    constexpr double kSame = 1e-6;
    const std::vector<JointEdge> joints = list_joint_edges(solid);
    const double far = joints.empty() ? 0.0 : kSame * find_bounds(solid).size().norm();
    for (const JointEdge& a : joints) {
        const bool goes_on = std::any_of(joints.begin(), joints.end(), [&](const JointEdge& b) {
            return b.piece != a.piece && (b.from - a.to).norm() <= far && (b.to - a.from).norm() <= far &&
                   (a.normal - b.normal).norm() <= kSame;
        });
        if (goes_on) edges.drawn[a.piece][a.face][a.at] = false;
    }
    return edges;
}

}  // namespace musim::lsdem
