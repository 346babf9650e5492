#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "lsdem/level_set.hpp"
#include "lsdem/solid/mass_properties.hpp"
#include "lsdem/solid/solid.hpp"
#include "lsdem/types.hpp"

namespace musim::lsdem {

/// Nodes on the surface of a shape, structure of arrays, body frame.
///
/// On a faceted shape a node stands for a rectangular cell of every face it lies on: its area vector holds, per axis, the outward sign of
/// that face times the node's share of it, and a contact acts on the share of the face that looks at the follower. The cell reaches from
/// position + center − half to position + center + half. On a smooth shape the area vector is the outward normal times the node's area,
/// and the cell has no size.
struct SurfaceNodes {
    std::vector<double> x, y, z;                       ///< position [m]
    std::vector<double> area_x, area_y, area_z;        ///< signed area shares [m²]
    std::vector<double> center_x, center_y, center_z;  ///< middle of the cell, relative to the node [m]
    std::vector<double> half_x, half_y, half_z;        ///< half extents of the cell [m]

    std::size_t size() const { return x.size(); }
    Vector3 position(std::size_t i) const { return {x[i], y[i], z[i]}; }
    Vector3 area(std::size_t i) const { return {area_x[i], area_y[i], area_z[i]}; }
};

/// Geometry of a block, shared by all blocks that are equal: level set, surface nodes, mass properties of the homogeneous solid.
struct Shape {
    std::variant<BoxLevelSet, GridLevelSet> level_set;  ///< of a solid its bounding box, which contacts do not ask
    /// In the body frame. Nothing: a box of `half_extents`, or a round body.
    std::shared_ptr<const Solid> solid;
    Placing own;  ///< the frame in which the solid was drawn, in the body frame
    SurfaceNodes nodes;
    bool faceted = true;                          ///< flat faces across the body axes, as of a box
    Vector3 node_spacing = Vector3::Zero();       ///< of the lattice of a box, along the body axes [m]
    Vector3 half_extents = Vector3::Zero();       ///< of the smallest box about the body's origin and axes that holds it [m]
    double volume = 0.0;                          ///< [m³]
    Vector3 inertia_over_mass = Vector3::Zero();  ///< principal moments per unit mass [m²]
    double face_area = 0.0;                       ///< A_face, the face k_n and k_s refer to: the base, across the body z axis [m²]
};

/// Numbers of nodes along each edge of a box, ends included.
struct NodeLattice {
    int nx = 0, ny = 0, nz = 0;
};

/// Lattice with exactly `nodes_per_face` nodes on the face across z, spaced as evenly as its divisors allow, and as wide along z.
/// `size` are the edge lengths [m]. Throws std::invalid_argument when no lattice of that number has a spacing ratio below 3, naming the
/// nearest number that does.
NodeLattice make_node_lattice(const Vector3& size, int nodes_per_face);

/// Box of edge lengths `size` [m] with its closed-form level set and a lattice of surface nodes, edges and corners included.
/// Trapezoidal cells: half along edges, a quarter at corners, so that the shares of a face sum to the face.
Shape make_box_shape(const Vector3& size, const NodeLattice& lattice);

/// The same nodes and mass properties with the level set sampled on a regular grid of spacing `voxel` [m].
Shape make_grid_box_shape(const Vector3& size, const NodeLattice& lattice, double voxel);

/// A solid bounded by planes, drawn in any frame. Its body frame has its origin in the centre of mass and its axes along the principal axes
/// of inertia, see find_principal_axes. The base, A_face, is made of the face that looks most to the drawn frame's −z and those within 15°
/// of it. `given`: centre of mass and inertia in the place of those of the homogeneous solid, in the drawn frame, and the volume that a
/// density refers to. Throws std::invalid_argument of a solid without volume.
Shape make_solid_shape(const Solid& drawn, const std::optional<MassProperties>& given = {});

/// Sphere of the given radius [m] as a grid level set, with `node_count` nodes spread evenly over its surface (Fibonacci lattice).
Shape make_sphere_shape(double radius, std::size_t node_count, double voxel);

/// Where the nodes of a solid cylinder (a drum) stand. On its flat ends they form rings around a node in the middle; the last ring is the
/// rim, the inner ones hold fewer nodes in proportion to their radius, three at least.
struct CylinderLattice {
    int around = 0;  ///< on each rim and on every row of the side
    int rings = 0;   ///< on each end, the rim included
    int along = 0;   ///< rows along the height, both rims included
};

/// Solid cylinder of the given radius and height [m] about the body z axis as a grid level set of spacing `voxel` [m].
///
/// A ring of an end stands for the annulus half way to its neighbors, a row of the side for the band half way to its neighbors; a rim node
/// has both shares, its area vector being their sum. So the shares along z of an end sum to πR², those of the side to 2πR·H, and the
/// vectors to zero. Principal moments per mass (3R² + H²)/12 twice and R²/2; A_face = πR² (the flat end). Throws std::invalid_argument when
/// radius, height or voxel is not positive, or with fewer than 3 nodes around, 1 ring or 2 rows.
Shape make_cylinder_shape(double radius, double height, const CylinderLattice& lattice, double voxel);

}  // namespace musim::lsdem
