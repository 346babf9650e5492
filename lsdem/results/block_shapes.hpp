#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "lsdem/model.hpp"
#include "lsdem/solid/solid.hpp"
#include "lsdem/types.hpp"

namespace musim::lsdem {

/// A shape that is no box, for results and pictures.
struct BlockShape {
    std::string name;     ///< of the scene; empty: it has none
    Solid solid;          ///< in the body frame [m]; of a ball facets of its surface
    double radius = 0.0;  ///< of a ball [m]; 0: the solid is what there is
};

/// Shapes of blocks: what is drawn of them.
struct BlockShapes {
    std::vector<std::shared_ptr<const BlockShape>> list;
    std::vector<int> of_block;  ///< into `list`; -1: a box of its size; no entries where all are boxes

    bool any() const { return !list.empty(); }
    /// Shape of a block; nothing of a box.
    const BlockShape* find(std::size_t block) const;
};

/// Shapes of the blocks of a model; blocks of one shape that differ in height have one each. `names`: of the model's shapes, may be empty.
BlockShapes list_block_shapes(const Model& model, const std::vector<std::string>& names);

/// Shapes of all blocks, those of boxes of equal size shared. `size`: of the bounding boxes, as results hold them [m].
std::vector<std::shared_ptr<const BlockShape>> list_drawn_shapes(const BlockShapes& shapes, const std::vector<Vector3>& size);

/// Facets of a ball of the given radius [m]: an icosahedron whose 20 faces are divided into 16 each, with their corners on the ball.
Solid make_ball_facets(double radius);

}  // namespace musim::lsdem
