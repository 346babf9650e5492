#pragma once

#include <cstddef>
#include <vector>

#include "lsdem/model.hpp"
#include "lsdem/shape.hpp"
#include "lsdem/types.hpp"

/// Blocks that are taller or shorter than their shape, by Block::height_offset Δ: everything that depends on a block's own height H + Δ.
/// Shapes stay shared; see docs/theory/shapes.md, "Blocks of unequal height".
namespace musim::lsdem {

/// Half extents of a block, body frame [m]: those of its shape, and (H + Δ)/2 along z.
Vector3 half_extents(const Model& model, const Block& block);

/// Δ/H [-]: by what part of its height a block is taller than its shape.
double height_strain(const Model& model, const Block& block);

/// Principal moments per unit mass of a block of its own height [m²]; of a box ((w² + h²)/12, (b² + h²)/12, (b² + w²)/12), h = H + Δ.
Vector3 inertia_over_mass(const Model& model, const Block& block);

/// The masses that the blocks would have at the height of their shape, m·H/(H + Δ) [kg]. Of blocks of one shape, those that agree to
/// rounding are one number: the contacts of blocks that differ in height only are then of one kind.
std::vector<double> compute_nominal_masses(const Model& model);

/// The nodes of a block: those of its shape, stretched along z to the block's own height. Nodes on faces stay on faces, and their cells
/// still tile them: positions and cells along z grow by 1 + Δ/H, areas on the faces across x and y likewise, areas across z do not.
struct BlockNodes {
    const Shape& shape;
    double strain = 0.0;  ///< Δ/H [-]

    std::size_t size() const { return shape.nodes.size(); }
    Vector3 position(std::size_t i) const { return stretched(shape.nodes.position(i)); }
    Vector3 center(std::size_t i) const { return stretched({shape.nodes.center_x[i], shape.nodes.center_y[i], shape.nodes.center_z[i]}); }
    Vector3 half(std::size_t i) const { return stretched({shape.nodes.half_x[i], shape.nodes.half_y[i], shape.nodes.half_z[i]}); }
    Vector3 area(std::size_t i) const {
        const Vector3 a = shape.nodes.area(i);
        return {a.x() + strain * a.x(), a.y() + strain * a.y(), a.z()};
    }

  private:
    Vector3 stretched(const Vector3& v) const { return {v.x(), v.y(), v.z() + strain * v.z()}; }
};

/// The nodes of a block of a model.
BlockNodes nodes_of(const Model& model, const Block& block);

}  // namespace musim::lsdem
