#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "lsdem/scene/material_presets.hpp"
#include "scaling/units.hpp"

/// Shapes that a scene names, as it describes them.
namespace musim::lsdem {

/// Axis of the frame in which a shape is drawn.
enum class ShapeAxis { x, y, z };

/// Spheres as grid level sets.
struct SphereShape {
    scaling::Length radius{};
    int nodes = 440;          ///< over the whole surface
    scaling::Length voxel{};  ///< spacing of the grid

    bool operator==(const SphereShape&) const = default;
};

/// A box about the origin.
struct BoxForm {
    Triple<scaling::Length> size{};  ///< edge lengths

    bool operator==(const BoxForm&) const = default;
};

/// A right prism, or frustum, of a convex outline; the origin is the outline's own, in the middle of the length.
struct PrismForm {
    std::vector<std::array<scaling::Length, 2>> outline;  ///< corners in the plane across the axis: (x, y), (y, z) or (z, x)
    ShapeAxis axis = ShapeAxis::z;                        ///< along which it has its length
    scaling::Length length{};
    double taper = 1.0;  ///< size of the end at +length/2 over that at -length/2, about the outline's origin

    bool operator==(const PrismForm&) const = default;
};

/// A drum of flat sides about the z axis, with the origin in its middle.
struct CylinderForm {
    scaling::Length radius{};  ///< of the circle through the corners
    scaling::Length height{};
    int flats = 24;
    std::optional<scaling::Length> top_radius;  ///< default: `radius`

    bool operator==(const CylinderForm&) const = default;
};

/// A convex polyhedron by its corners.
struct PolyhedronForm {
    std::vector<Triple<scaling::Length>> vertices;
    std::vector<std::vector<std::uint32_t>> faces;  ///< corners of each, from 0; empty: the convex hull

    bool operator==(const PolyhedronForm&) const = default;
};

/// A part of a file with several: its number from 0, or the name of its group.
using ChosenPart = std::variant<std::size_t, std::string>;

/// A closed triangle mesh in a file: STL, OBJ or PLY.
struct MeshForm {
    std::filesystem::path file;      ///< absolute path
    std::string unit;                ///< of its coordinates: "m", "mm", ...
    std::optional<ChosenPart> part;  ///< default: the file has one

    bool operator==(const MeshForm&) const = default;
};

/// Part of a compound: a shape in its place.
struct CompoundPart {
    std::string shape;                                     ///< key of Scene::shapes
    Triple<scaling::Length> position{};                    ///< of the origin of the part's frame
    std::array<double, 4> quaternion{1.0, 0.0, 0.0, 0.0};  ///< (w, x, y, z), part to compound; any length but 0

    bool operator==(const CompoundPart&) const = default;
};

/// Convex parts that touch and make one rigid body: shapes in their places, or the parts of a file.
struct CompoundForm {
    std::vector<CompoundPart> parts;            ///< none where there is a file
    std::optional<std::filesystem::path> file;  ///< absolute path
    std::optional<std::string> unit;            ///< of its coordinates

    bool operator==(const CompoundForm&) const = default;
};

using ShapeForm = std::variant<BoxForm, PrismForm, CylinderForm, PolyhedronForm, MeshForm, CompoundForm, SphereShape>;

/// A shape that blocks name. The form is scaled, then mirrored, then turned; all else is of the result, in the frame that blocks are placed
/// by.
struct ShapeEntry {
    ShapeForm form;
    std::array<double, 3> scale{1.0, 1.0, 1.0};                      ///< of the form's x, y, z
    std::optional<ShapeAxis> mirror;                                 ///< of which the sign is changed
    std::array<double, 4> quaternion{1.0, 0.0, 0.0, 0.0};            ///< (w, x, y, z), any length but 0
    std::optional<scaling::Mass> mass;                               ///< of a block, whatever its material; default: by the density
    std::optional<Triple<scaling::Length>> centre;                   ///< of mass; default: that of the homogeneous solid
    std::optional<std::array<Triple<scaling::Inertia>, 3>> inertia;  ///< about the centre of mass; default: as the centre

    /// Is a box along its own axes whose mass is spread evenly, however it is turned?
    bool is_box() const { return std::holds_alternative<BoxForm>(form) && !centre && !inertia; }
    bool is_sphere() const { return std::holds_alternative<SphereShape>(form); }
    bool operator==(const ShapeEntry&) const = default;
};

}  // namespace musim::lsdem
