#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/scene/build_model.hpp"
#include "lsdem/scene/detail/overlap.hpp"
#include "lsdem/scene/named_shape.hpp"
#include "lsdem/scene/scene.hpp"
#include "lsdem/types.hpp"

namespace musim::lsdem::detail {

/// A block in its place, in SI; what all blocks of a scene have in common is left to the scene.
struct Placement {
    Vector3 size = Vector3::Zero();        ///< edge lengths of its shape in the body frame [m]; of spheres their diameter
    std::string shape;                     ///< key of Scene::shapes, of solids and spheres; empty: a box, or as Scene::shape has it
    std::shared_ptr<const Shape> solid;    ///< of that name; nothing: a box or a sphere
    std::optional<double> mass;            ///< given apart from the shape [kg]
    double height_offset = 0.0;            ///< Δ: how much taller than its shape [m]
    Vector3 whole_size = Vector3::Zero();  ///< of the block whose face the stiffnesses belong to: `size`, but for half blocks [m]
    Vector3 position = Vector3::Zero();    ///< of the centre of mass [m]
    Quaternion orientation = Quaternion::Identity();
    Vector3 velocity = Vector3::Zero();
    Vector3 angular_velocity = Vector3::Zero();
    bool fixed = false;
    bool with_base = false;  ///< of a fixed one
    bool rotation_locked = false;
    std::string material;           ///< key of Scene::materials; empty: Scene::material
    std::optional<double> density;  ///< default: that of the material [kg/m³]
    std::string name;               ///< of a listed block; empty: none
    int layer = 0;                  ///< from 1 at the base; 0: in no layer
    int level = 0;                  ///< from 1 at the base: the layer, or by height

    /// Edge lengths of the block itself, its own height included [m].
    Vector3 own_size() const { return {size.x(), size.y(), size.z() + height_offset}; }
    /// Edges of the box along the world's axes that holds it [m].
    Vector3 extent() const;
};

/// All blocks of a structure and its spine.
struct Arrangement {
    std::vector<Placement> blocks;
    Spine spine;
};

/// Places the boxes of a column, a tower or a wall, of their own heights; of a tower of a named shape what these would be.
Arrangement arrange_boxes(const Scene& scene);

/// Places the blocks of a scene's structure, as its scatter has them. Throws SceneError when the tower's ring cannot be tiled or its tiling
/// cannot be read, and when its scatter is too large for a block.
Arrangement arrange(const Scene& scene);

/// The blocks as bodies of the overlap check; they refer to the solids of `blocks`.
std::vector<Body> make_bodies(const Scene& scene, const std::vector<Placement>& blocks);

/// Levels of blocks by their heights, from 1 at the lowest: a block begins a new level when its centre is higher than the first of the
/// level by half of the lower of the two, or more; blocks of one course differ by less, those of the next by a whole height.
///
/// `extent`: along the world's axes [m]; both one entry per block. Depends on ratios of lengths only.
std::vector<int> find_levels(const std::vector<Vector3>& position, const std::vector<Vector3>& extent);

/// Three typed values as a plain SI vector.
template <class Quantity>
Vector3 to_vector(const Triple<Quantity>& triple) {
    return {triple[0].value(), triple[1].value(), triple[2].value()};
}

}  // namespace musim::lsdem::detail
