#pragma once

#include <string>

#include "lsdem/scene/scene.hpp"
#include "lsdem/shape.hpp"
#include "lsdem/solid/solid.hpp"

/// Named shapes of a scene as the kernel takes them, in SI.
namespace musim::lsdem {

/// A solid as a scene draws it, about a point that lies within or near it, so that a far origin costs no digits.
struct DrawnSolid {
    Solid solid;
    Vector3 origin = Vector3::Zero();  ///< of the solid's coordinates, in the frame that blocks are placed by [m]
};

/// Solid of a shape: drawn, scaled, mirrored and turned; a box as any other. Not of a sphere. Throws SceneError, with the place of the
/// shape, for what is no solid: an outline that is not convex, points in one plane, faces with a dent, parts that overlap, and so on.
DrawnSolid make_drawn_solid(const Scene& scene, const std::string& name);

/// Shape by name, of all but spheres; its `own` is the frame that blocks are placed by, in the body frame. Throws as make_drawn_solid, and
/// for a centre or an inertia that the solid cannot have.
Shape make_named_shape(const Scene& scene, const std::string& name);

/// Edge lengths of a shape that is a box, along its own axes.
Triple<scaling::Length> find_box_size(const ShapeEntry& box);

}  // namespace musim::lsdem
