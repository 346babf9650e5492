#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lsdem/contact/depth_cells.hpp"
#include "lsdem/contact/placed_solid.hpp"
#include "lsdem/types.hpp"

/// Forces between two convex bodies where they overlap, see docs/theory/overlap_contact.md.
namespace musim::lsdem {

/// A point of a face of one body inside the other.
struct OverlapVertex {
    Vector3 place;  ///< world axes, about the origin of the pair [m]
    double depth;   ///< below the nearest face of the other body [m]
};

/// The faces of two bodies inside each other, cut into pieces over which the depth below the nearest face of the other body is affine.
/// Keeps its memory from one pair to the next.
class OverlapPieces {
  public:
    struct Piece {
        Vector3 normal;          ///< outward, of the body whose face it is part of
        double facing;           ///< cosine by which it faces the nearest face of the other body: 1 where they meet flat [-]
        std::uint32_t first;     ///< into the vertices
        std::uint32_t count;     ///< of its vertices, counter-clockwise about the normal
        std::uint32_t body;      ///< whose face it is: 0 the first's, 1 the second's
        Vector3 nearest_normal;  ///< outward, of the face of the other body that is nearest
    };
    using Vertex = OverlapVertex;

    /// Cuts the faces of `a` and `b` anew.
    void cut(const PlacedSolid& a, const PlacedSolid& b);

    const Piece* begin() const { return pieces_.data(); }
    const Piece* end() const { return pieces_.data() + pieces_.size(); }
    const Vertex* vertices(const Piece& piece) const { return &vertices_[piece.first]; }
    /// The largest number of vertices of a piece.
    std::size_t most_vertices() const { return most_vertices_; }

  private:
    /// Which corners of one piece lie outside which planes of another.
    struct Sides {
        enum class Share { none, some, all };
        std::vector<std::uint64_t> outside;  ///< corners, one bit each in `words` words a plane
        std::vector<std::uint64_t> shallow;  ///< likewise those outside or inside by rounding only; empty of few planes
        std::size_t words = 0;
        bool all_outside = false;  ///< all corners lie outside one plane: the pieces are apart

        void find(const PlacedPiece& corners, const PlacedPiece& planes);
        /// Share of the corners of a face that lie outside a plane.
        Share share(std::size_t plane, const Polyhedron& form, std::size_t face) const { return share(outside, plane, form, face); }
        /// Are all of them no deeper below it than rounding?
        bool is_shallow(std::size_t plane, const Polyhedron& form, std::size_t face) const {
            return !shallow.empty() && share(shallow, plane, form, face) == Share::all;
        }

      private:
        Share share(const std::vector<std::uint64_t>& marked, std::size_t plane, const Polyhedron& form, std::size_t face) const {
            if (words == 1) return share_of(marked[plane] & form.marks[face], ~marked[plane] & form.marks[face]);
            const std::uint64_t* const out = &marked[plane * words];
            const std::uint64_t* const of = &form.marks[face * words];
            std::uint64_t any = 0, missing = 0;
            for (std::size_t w = 0; w < words; ++w) any |= out[w] & of[w], missing |= ~out[w] & of[w];
            return share_of(any, missing);
        }
        static Share share_of(std::uint64_t any, std::uint64_t missing) {
            return missing == 0 ? Share::all : any != 0 ? Share::some : Share::none;
        }
    };
    void cut(const PlacedPiece& x, const PlacedPiece& y, const Sides& of_x, const Sides& of_y, std::uint32_t body);
    /// The part of face f of x inside y, as `polygon_`.
    void cut_face(const PlacedPiece& x, std::size_t f, const PlacedPiece& y, const Sides& of_x, const Sides& of_y);
    void add_pieces(const PlacedPiece& x, std::size_t f, const PlacedPiece& y, std::uint32_t body);

    std::vector<Piece> pieces_;
    std::vector<Vertex> vertices_;
    std::size_t most_vertices_ = 0;
    // room for one face at a time
    std::array<Sides, 2> sides_;
    std::vector<std::size_t> cuts_;
    detail::Polygon polygon_;
    detail::PolygonCutter cutter_;
    detail::DepthCells cells_;
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

/// ∫ d² over a polygon in a plane of normal n [m⁴].
double integrate_square(std::size_t count, const Vector3& normal, const OverlapVertex* vertices);

/// ½ ∫ (d_a + d_b) dV over the overlap, of which the force is minus the gradient [m⁴]: the energy for a stiffness per area of one.
double compute_overlap_energy(const PlacedSolid& a, const PlacedSolid& b, const OverlapPieces& pieces);

}  // namespace musim::lsdem
