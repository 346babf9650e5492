#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "lsdem/contact/solid.hpp"
#include "lsdem/types.hpp"

/// Forces between two convex bodies where they overlap, see docs/theory/overlap_contact.md.
namespace musim::lsdem {

/// The faces of two bodies inside each other, cut into pieces over which the depth below the nearest face of the other body is affine.
class OverlapPieces {
  public:
    struct Piece {
        Vector3 normal;          ///< outward, of the body whose face it is part of
        double facing;           ///< cosine by which it faces the nearest face of the other body: 1 where they meet flat [-]
        std::uint16_t first;     ///< into the vertices
        std::uint16_t count;     ///< of its vertices, counter-clockwise about the normal
        std::size_t body;        ///< whose face it is: 0 the first's, 1 the second's
        Vector3 nearest_normal;  ///< outward, of the face of the other body that is nearest
    };
    struct Vertex {
        Vector3 place;  ///< world axes, about the origin of the pair [m]
        double depth;   ///< below the nearest face of the other body [m]
    };

    /// Corners of a piece at most.
    static constexpr std::size_t kMostCorners = PlacedSolid::kMostCorners + 2 * PlacedSolid::kMostFaces;

    OverlapPieces() {}  // room that is not used is not cleared

    /// Cuts the faces of `a` and `b` anew.
    void cut(const PlacedSolid& a, const PlacedSolid& b);

    const Piece* begin() const { return pieces_.data(); }
    const Piece* end() const { return pieces_.data() + piece_count_; }
    const Vertex* vertices(const Piece& piece) const { return &vertices_[piece.first]; }
    /// The faces of a body that may be nearest to some of the overlap, one bit each: those nearest to some piece, and those that have one,
    /// since a cell that reaches no face of the other body reaches its own.
    std::uint32_t with_cells_of(std::size_t body) const { return with_cells_[body]; }

  private:
    /// Enough for two boxes: twelve faces, each with a cell for every face of the other box and 14 corners at most. Shapes with more faces
    /// will need more.
    static constexpr std::size_t kMostPieces = 128, kMostVertices = 1024;
    void cut_faces(const PlacedSolid& x, const PlacedSolid& y, std::size_t body);

    std::size_t piece_count_ = 0, vertex_count_ = 0;
    std::array<std::uint32_t, 2> with_cells_{};
    std::array<Piece, kMostPieces> pieces_;
    std::array<Vertex, kMostVertices> vertices_;
};

/// Load by the springs of an overlap, for a stiffness per area of one.
struct OverlapLoad {
    Vector3 force = Vector3::Zero();   ///< on the second body [m³]
    Vector3 moment = Vector3::Zero();  ///< of that force about the origin of the pair [m⁴]
    double energy = 0.0;               ///< but for a part overlap/size of it, see compute_overlap_energy [m⁴]
    double deepest = 0.0;              ///< largest depth of a point of one body in the other [m]
    double area = 0.0;                 ///< of the faces of one body inside the other, the mean of both: its stiffness is no larger [m²]
};
OverlapLoad sum_load(const OverlapPieces& pieces);

/// ½ ∫ (d_a + d_b) dV over the overlap, of which the force is minus the gradient [m⁴]: the energy for a stiffness per area of one.
double compute_overlap_energy(const PlacedSolid& a, const PlacedSolid& b, const OverlapPieces& pieces);

}  // namespace musim::lsdem
