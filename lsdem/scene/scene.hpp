#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "lsdem/model.hpp"
#include "lsdem/scene/accuracy_presets.hpp"
#include "lsdem/scene/held.hpp"
#include "lsdem/scene/load_entry.hpp"
#include "lsdem/scene/material_presets.hpp"
#include "lsdem/scene/pair_entry.hpp"
#include "lsdem/scene/preparation.hpp"
#include "lsdem/scene/scene_motion.hpp"
#include "lsdem/scene/sensors.hpp"
#include "lsdem/scene/shape_entry.hpp"
#include "lsdem/scene/tower_tiling.hpp"
#include "scaling/units.hpp"

/// Scenes: what to simulate, in typed quantities; from and to JSON, scaled by a similitude, turned into the kernel's Model.
namespace musim::lsdem {

/// Blocks as boxes with a closed-form level set.
struct BoxShape {
    int nodes_per_face = 44;  ///< of boxes that meet by nodes: on the face across z, edges and corners included; 44 in [Harmon23]

    bool operator==(const BoxShape&) const = default;
};

/// Blocks as boxes whose level set is sampled on a grid.
struct GridShape {
    int nodes_per_face = 44;
    scaling::Length voxel{};  ///< spacing of the grid; 0.65 mm at 1:107 in [Harmon23]

    bool operator==(const GridShape&) const = default;
};

/// Shape of blocks that name none. Spheres are for structures of kind "blocks", whose entries then need no size.
using ShapeSettings = std::variant<BoxShape, GridShape, SphereShape>;

/// One block of an explicit list.
struct BlockEntry {
    Triple<scaling::Length> size{};                        ///< edge lengths in the body frame; unused for spheres and named shapes
    std::string shape;                                     ///< key of Scene::shapes; empty: Scene::shape
    Triple<scaling::Length> position{};                    ///< of the frame in which its shape is drawn, the middle of a box; world frame
    std::array<double, 4> quaternion{1.0, 0.0, 0.0, 0.0};  ///< (w, x, y, z), that frame to world; any length but 0
    Triple<scaling::Velocity> velocity{};                  ///< of the centre of mass, world frame
    Triple<scaling::Frequency> angular_velocity{};         ///< world frame [rad/s]
    Held fixed = Held::free;
    bool rotation_locked = false;             ///< translates only
    std::string material;                     ///< key of Scene::materials; empty: Scene::material
    std::optional<scaling::Density> density;  ///< default: that of the material
    std::string name;                         ///< in results and messages; empty: its number, counted from 0

    bool operator==(const BlockEntry&) const = default;
};

/// An explicit list of blocks.
struct BlockList {
    std::vector<BlockEntry> blocks;

    bool operator==(const BlockList&) const = default;
};

/// One block per layer.
struct Column {
    int layers = 1;
    Triple<scaling::Length> block{};     ///< b, w, H
    bool rotation_locked = false;        ///< all blocks translate only; for wave speeds
    scaling::Length height_deviation{};  ///< standard deviation σ_H of the block heights
    std::uint64_t seed = 1;              ///< of the heights

    bool operator==(const Column&) const = default;
};

/// Tower of dominoes on a square grid of cells, layers turned by 90° in turn [Harmon23], with any tiling.
struct Tower {
    int layers = 38;
    Triple<scaling::Length> block{};                   ///< b, w, H
    std::optional<scaling::Length> pitch;              ///< of the cells; default: see default_pitch
    TilingSettings tiling;                             ///< ring to be tiled, unless a file is named
    std::optional<std::filesystem::path> tiling_file;  ///< absolute path of a list of dominoes
    scaling::Length height_deviation{};                ///< standard deviation σ_H of the block heights, see block_heights.hpp
    std::uint64_t seed = 1;                            ///< of the heights
    std::string shape;                                 ///< key of Scene::shapes, drawn about the middle of the block; empty: boxes

    bool operator==(const Tower&) const = default;
};

/// A hole in a wall, between courses.
struct WallOpening {
    scaling::Length from{};   ///< from the left end of the wall, at −x, to the near jamb
    scaling::Length width{};  ///< clear, from jamb to jamb
    int sill = 0;             ///< courses below it
    int courses = 1;          ///< that it is high

    bool operator==(const WallOpening&) const = default;
};

/// Boxes over openings, one course high and as thick as a leaf; none over an opening that reaches the top of its wall.
struct WallLintel {
    std::optional<scaling::Length> bearing;  ///< on the wall at each side; default: a half block
    std::string material;                    ///< key of Scene::materials; empty: Scene::material

    bool operator==(const WallLintel&) const = default;
};

/// Two leaves instead of one, each as thick as a block.
struct WallLeaves {
    scaling::Length gap{};  ///< between them
    int headers_every = 0;  ///< courses whose number is a multiple of it are of blocks that go through both leaves; 0: none

    bool operator==(const WallLeaves&) const = default;
};

/// Walls at right angles to the ends of another, towards +y, interlocked: every other course runs through the corner.
struct WallReturns {
    int left = 0, right = 0;  ///< whole blocks in a course, the corner included; 0: no such wall

    bool operator==(const WallReturns&) const = default;
};

/// A straight wall along x in running bond: odd courses of whole blocks, even courses shifted by half a block, closed by half blocks.
struct Wall {
    int layers = 1;
    int blocks_per_layer = 1;
    Triple<scaling::Length> block{};       ///< b across the wall, w along it, H
    std::optional<scaling::Length> pitch;  ///< half a block and its joint, along x; default: see default_pitch
    std::vector<WallOpening> openings;
    std::optional<WallLintel> lintel;    ///< default: of half a block's bearing and the scene's material
    std::optional<WallLeaves> leaves;    ///< default: one
    std::optional<WallReturns> returns;  ///< default: a straight wall
    scaling::Length height_deviation{};  ///< standard deviation σ_H of the block heights
    std::uint64_t seed = 1;              ///< of the heights

    bool operator==(const Wall&) const = default;
};

/// Named shapes one on top of the other, from the base up: each stands where the one below it ends, its frame upright on the z axis.
struct ShapeColumn {
    std::vector<std::string> blocks;  ///< keys of Scene::shapes

    bool operator==(const ShapeColumn&) const = default;
};

/// A circular arch of equal voussoirs with radial joints in the x-z plane, the middle of its springing line in the origin.
struct Arch {
    scaling::Length radius{};     ///< of the line midway between intrados and extrados
    scaling::Length thickness{};  ///< along the radius
    scaling::Length depth{};      ///< along y
    scaling::Ratio embrace{};     ///< angle between the springings [rad]
    int voussoirs = 7;
    bool abutments = true;  ///< does a block that moves with the base carry each springing?

    bool operator==(const Arch&) const = default;
};

/// A structure by itself.
using OneStructure = std::variant<BlockList, Column, Tower, Wall, ShapeColumn, Arch>;

/// A structure among others, in its place.
struct PlacedStructure {
    std::string name;  ///< before the names of its blocks; empty: its number
    OneStructure structure;
    Triple<scaling::Length> place{};  ///< of its origin
    scaling::Ratio turn{};            ///< about z, before it is moved there [rad]

    bool operator==(const PlacedStructure&) const = default;
};

/// Several structures in one scene.
struct Assembly {
    std::vector<PlacedStructure> structures;

    bool operator==(const Assembly&) const = default;
};

using Structure = std::variant<BlockList, Column, Tower, Wall, ShapeColumn, Arch, Assembly>;

/// Scatter of what was built against what was drawn, by a seed: see detail/scatter_blocks.hpp, and JointScatter for friction.
struct Scatter {
    scaling::Length size{};   ///< standard deviation of the horizontal edges of boxes, none of which is longer than drawn
    scaling::Length place{};  ///< of the places of blocks, along x and y, within their joints
    double friction = 0.0;    ///< of the friction coefficients of joints, as a part of their mean [-]
    std::uint64_t seed = 1;

    bool operator==(const Scatter&) const = default;
};

/// Pitch of the cells when a scene gives none: that of the prototype tower for its block,  p = w·1.435/2.82  [Harmon23].
scaling::Length default_pitch(const Triple<scaling::Length>& block);

/// One of several motions that shake the same structure one after another.
struct MotionEntry {
    std::string name;                       ///< for people and folders; empty: named after its record or signal
    SceneMotion base_motion;                ///< its displacement and velocity count from where the motion before it has left the base
    std::optional<scaling::Time> duration;  ///< default: TimeSettings::duration, or else until the motion ends
    bool settle = true;                     ///< does the structure come to rest before it? The first: as without a list of motions
    int repeat = 1;                         ///< how many times

    bool operator==(const MotionEntry&) const = default;
};

/// The plane z = 0.
struct GroundSettings {
    bool present = true;
    std::optional<double> friction;  ///< μ of every block on it, whatever theirs; default: the smaller of theirs and Scene::material's [-]

    bool operator==(const GroundSettings&) const = default;
};

struct TimeSettings {
    scaling::Time duration{};           ///< zero only in a scene with a list of motions: as long as each motion
    std::optional<scaling::Time> step;  ///< default ("auto"): `safety` times the critical step of the model
    double safety = 0.8;

    bool operator==(const TimeSettings&) const = default;
};

struct OutputSettings {
    scaling::Frequency spine_rate{};               ///< samples of the spine per second; 0: one per step
    std::optional<scaling::Frequency> frame_rate;  ///< pictures of all blocks; default: none

    bool operator==(const OutputSettings&) const = default;
};

/// Names in a scene of the ways in which boxes meet, in the order of FaceContact.
const std::vector<std::string>& face_contact_names();

/// About the text that a scene was read from. Scenes that mean the same are equal, whatever their texts.
struct SceneText {
    std::string origin;                ///< the file, as messages name it; empty for a scene that was made
    std::vector<std::string> remarks;  ///< about settings that change nothing and about unlikely values, with their places
    std::vector<std::string> notes;    ///< about values that were understood in a way of their own, with their places
    std::string plain_number;          ///< JSON path of the first quantity that is a number without a unit; empty: there is none
    bool operator==(const SceneText& /*other*/) const { return true; }
};

/// Everything a simulation needs. Complete and consistent when it comes from read_scene, parse_scene or scale_scene.
struct Scene {
    std::string name;
    Triple<scaling::Acceleration> gravity{0.0 * scaling::kStandardGravity, 0.0 * scaling::kStandardGravity, -scaling::kStandardGravity};
    BlockMaterial material;                          ///< of the ground, and of blocks that name no other
    std::map<std::string, BlockMaterial> materials;  ///< further ones, for entries of a BlockList
    std::vector<PairEntry> pairs;                    ///< of materials that meet in a way of their own
    ShapeSettings shape;
    std::map<std::string, ShapeEntry> shapes;  ///< for entries of a BlockList that name one
    Structure structure;
    std::optional<Scatter> scatter;  ///< default: none
    SceneMotion base_motion;
    std::vector<MotionEntry> motions;  ///< instead of base_motion: one after another, see motions.hpp
    std::vector<LoadEntry> loads;      ///< beside the weight
    GroundSettings ground;
    std::optional<Preparation> preparation;  ///< default: at rest under its weight; single blocks begin as listed
    ContactNodes contact_nodes = ContactNodes::leader;
    FaceContact face_contact = FaceContact::overlap;
    std::optional<Accuracy> accuracy;  ///< what the scene asked for; its consequences stand in the other settings
    TimeSettings time;
    OutputSettings output;
    std::vector<SensorEntry> sensors;
    SceneText text;

    /// Where it comes from, to begin messages with: its file, or `scene "name"`.
    std::string place() const { return text.origin.empty() ? "scene \"" + name + "\"" : text.origin; }
    /// Is there a contact by surface nodes: of spheres, grids, or boxes that ask for it?
    bool has_contact_nodes() const;
    /// The shape that a block names; none where it is a box, or a sphere, of Scene::shape.
    const ShapeEntry* find_shape(const BlockEntry& block) const;
    /// Is a block of the list a sphere?
    bool is_sphere(const BlockEntry& block) const;
    bool operator==(const Scene&) const = default;
};

/// Does the ground tilt until the structure collapses? Then runs end there.
inline bool tilts(const Scene& scene) { return std::holds_alternative<TiltMotion>(scene.base_motion.source); }

/// Checks that a scene can be built: positive sizes, densities, stiffnesses, durations, restitution in (0, 1], and so on.
/// Throws SceneError `origin: /json/path: what (why); what to do`.
void check_scene(const Scene& scene, const std::string& origin);

}  // namespace musim::lsdem
