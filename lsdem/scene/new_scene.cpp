#include "lsdem/scene/new_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lsdem/scene/reference_block.hpp"
#include "lsdem/scene/scene_error.hpp"
#include "records/synthesis/synthetic.hpp"
#include "scaling/angle.hpp"
#include "scaling/nearest_name.hpp"
#include "scaling/quantity_text.hpp"

namespace musim::lsdem {
namespace {

using scaling::Length;
using scaling::Time;

/// μ of the prototype's concrete [Harmon23, Table 3].
constexpr double kPrototypeFriction = 0.59;

/// Durations of the prototype's synthetic earthquake and run, so that the structure comes to rest again; samples and pictures
/// a second.
constexpr double kMotionDuration = 10.0, kRunDuration = 12.0;  // [s]
constexpr double kSpineRate = 100.0, kFrameRate = 25.0;        // [1/s]

/// A structure that is tilted, and how fast the prototype is [deg/s].
constexpr const char* kTilt = "tilt";
constexpr double kTiltRate = 0.5;

/// Whole blocks in a course of the wall.
constexpr int kBlocksPerLayer = 5;

/// Safety of the wall's time step: its half blocks come to meet their neighbors by side faces, which are stiffer than what stands at the
/// start [-].
constexpr double kWallSafety = 0.4;

/// Layers of a portal: more than a hundred blocks in a list are not for people.
constexpr int kMostPortalLayers = 50;

/// `value` to so many significant digits.
double round_to(double value, int digits) {
    const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) + 1.0 - digits);
    return std::round(value / unit) * unit;
}

template <class Quantity>
Quantity rounded(Quantity quantity, int digits) {
    return Quantity::from_value(round_to(quantity.value(), digits));
}

/// Thin, wide and high edges of the prototype's block.
const Triple<Length> kPrototypeBlock{1.36 * scaling::si::meter, 2.82 * scaling::si::meter, 4.25 * scaling::si::meter};

/// The prototype's block at the model's length, to a micrometre in a millimetre.
Triple<Length> make_block(double length) {
    Triple<Length> block = kPrototypeBlock;
    for (Length& edge : block) edge = rounded(edge * length, 4);
    return block;
}

/// Two pillars of upright blocks and one that lies across both, turned by a right angle about y, its ends past their outer faces by a tenth
/// of their thickness.
BlockList make_portal(const Triple<Length>& block, int layers) {
    const Length b = block[0], h = block[2];
    const Length none{};
    const Length to_pillar = 0.5 * (h - 1.2 * b);
    BlockList list;
    const auto add = [&](const Length& x, const Length& z) {
        BlockEntry entry;
        entry.size = block;
        entry.position = {x, none, z};
        list.blocks.push_back(entry);
    };
    for (const double side : {-1.0, 1.0}) {
        for (int k = 0; k < layers; ++k) add(side * to_pillar, (k + 0.5) * h);
    }
    add(none, static_cast<double>(layers) * h + 0.5 * b);
    list.blocks.back().quaternion = {1.0, 0.0, 1.0, 0.0};
    return list;
}

/// An arch of voussoirs of thickness b, depth w and length H.
Arch make_arch(const Triple<Length>& block, int voussoirs) {
    constexpr double kEmbrace = 157.5;  // [deg]
    Arch arch;
    arch.thickness = block[0];
    arch.depth = block[1];
    arch.embrace = kEmbrace * scaling::kDegree;
    arch.voussoirs = voussoirs;
    arch.radius = rounded(static_cast<double>(voussoirs) * block[2] / (kEmbrace * scaling::kDegree), 4);
    return arch;
}

/// A column of drums of diameter w and height H between a plinth and a capital.
ShapeColumn make_drums(const Triple<Length>& block, int drums, std::map<std::string, ShapeEntry>& shapes) {
    constexpr double kOver = 1.2;  // width of plinth and capital over that of the drums
    const Length width = rounded(kOver * block[1], 4);
    shapes["plinth"].form = shapes["capital"].form = BoxForm{{width, width, rounded(0.5 * block[0], 4)}};
    shapes["drum"].form = CylinderForm{.radius = rounded(0.5 * block[1], 4), .height = block[2], .flats = 12, .top_radius = {}};
    ShapeColumn column{{"plinth"}};
    column.blocks.insert(column.blocks.end(), static_cast<std::size_t>(drums), "drum");
    column.blocks.emplace_back("capital");
    return column;
}

/// The block of a file, on the ground.
ShapeColumn make_stone(const NewScene& wanted, std::map<std::string, ShapeEntry>& shapes) {
    if (!wanted.mesh)
        throw SceneError("mesh: no file is named (the scene is one of a block that a file has); name an STL, OBJ or PLY and its unit");
    shapes["stone"].form = MeshForm{.file = wanted.mesh->file, .unit = wanted.mesh->unit, .part = {}};
    return {{"stone"}};
}

Structure make_structure(const NewScene& wanted, const Triple<Length>& block, std::map<std::string, ShapeEntry>& shapes) {
    if (wanted.kind == "arch") return make_arch(block, wanted.layers.value_or(7));
    if (wanted.kind == "drums") return make_drums(block, wanted.layers.value_or(4), shapes);
    if (wanted.kind == "mesh") return make_stone(wanted, shapes);

    if (wanted.kind == "tower") {
        Tower tower;
        tower.layers = wanted.layers.value_or(8);
        tower.block = block;
        tower.tiling = find_tiling_preset("ring_14");
        return tower;
    }
    if (wanted.kind == "wall") {
        Wall wall;
        wall.layers = wanted.layers.value_or(6);
        wall.blocks_per_layer = kBlocksPerLayer;
        wall.block = block;
        return wall;
    }
    if (wanted.kind == "column" || wanted.kind == kTilt) {
        Column column;
        column.layers = wanted.layers.value_or(6);
        column.block = block;
        return column;
    }
    if (wanted.kind == "blocks") {
        const int layers = wanted.layers.value_or(2);
        if (layers > kMostPortalLayers) {
            throw SceneError(fmt::format("blocks: {} layers are too many to list block by block; take {} at most, or a column", layers,
                                         kMostPortalLayers));
        }
        return make_portal(block, layers);
    }
    throw SceneError(fmt::format("\"{}\" is no structure; {}", wanted.kind, scaling::suggest_name(wanted.kind, new_scene_kinds())));
}

/// The preset that a material is; null for one of a file.
const MaterialPreset* find_preset(const MeasuredMaterial& material) {
    const std::vector<std::string> names = material_preset_names();
    if (std::find(names.begin(), names.end(), material.name) == names.end()) return nullptr;
    const MaterialPreset& preset = find_material_preset(material.name);
    return preset.material == material.material && preset.reference_block == material.reference_block ? &preset : nullptr;
}

/// Edges of the blocks where they do not follow from the length: given ones, or those on which an own material was measured.
std::optional<Triple<Length>> find_block(const NewScene& wanted) {
    if (wanted.block || wanted.length || find_preset(wanted.material) != nullptr) return wanted.block;
    return wanted.material.reference_block;
}

double find_length(const NewScene& wanted) {
    if (wanted.length) return *wanted.length;
    if (const auto block = find_block(wanted)) return (*block)[2] / kPrototypeBlock[2];
    return find_preset(wanted.material)->length_scale.value_or(1.0);
}

std::string describe_kind(const NewScene& wanted) {
    const std::string& material = wanted.material.name;
    if (wanted.kind == "drums") return fmt::format("column of {} drums", material);
    if (wanted.kind == "mesh") return fmt::format("{} of {}", wanted.mesh->file.stem().string(), material);
    const std::string what = wanted.kind == "blocks" ? "portal" : wanted.kind == kTilt ? "tilted column" : wanted.kind;
    return fmt::format("{} of {} blocks", what, material);
}

std::string describe_scale(double length) {
    if (length == 1.0) return "prototype scale";
    return length < 1.0 ? fmt::format("1:{:.6g}", 1.0 / length) : fmt::format("{:.6g}:1", length);
}

/// The material on one face of the model's block, in numbers that people write.
BlockMaterial make_material(const NewScene& wanted, const Triple<Length>& block) {
    BlockMaterial material = fit_to_block(wanted.material, block);
    material.normal_stiffness = rounded(material.normal_stiffness, 4);
    material.shear_stiffness = rounded(material.shear_stiffness, 4);
    return material;
}

SignalMotion make_motion(const scaling::Similitude& similitude) {
    const records::SyntheticSettings prototype;
    SyntheticSignal signal;
    signal.pga = round_to(similitude.acceleration() * (prototype.pga / scaling::kStandardGravity), 4) * scaling::kStandardGravity;
    signal.pgv = rounded(similitude.to_model(prototype.pgv), 4);
    signal.duration = rounded(similitude.to_model(kMotionDuration * scaling::si::seconds), 3);
    signal.dt = rounded(similitude.to_model(prototype.dt), 3);
    return {.signal = signal, .dt = {}};
}

std::vector<std::string> comment_structure(const std::string& kind) {
    const std::string block = "block: thin edge b, wide edge w, height H";
    const std::string heights =
        "height_deviation: standard deviation of your blocks' heights, e.g. \"0.1 mm\"; each seed draws other heights";
    if (kind == "tower") {
        return {block, "tiling: ring_14 has 14 blocks a layer; others are ring_18, solid_22, solid_6, solid_2, and full, the papers' 188",
                heights};
    }
    if (kind == "wall") return {block + "; w runs along x, the wall's length", heights};
    if (kind == "arch") {
        return {"radius: of the middle of the thickness; embrace: angle between the springings",
                "abutments: a block under each springing that moves with the base; false: the arch stands on the ground, or on what you "
                "place under it"};
    }
    if (kind == "drums") return {"blocks: shapes from the lowest up; two columns and a lintel: musim's examples have them"};
    if (kind == "mesh") return {"blocks: shapes from the lowest up; the stone stands on the lowest point of its file"};
    if (kind == "column" || kind == kTilt) return {block + "; b runs along x, w along y", heights};
    return {"size: edges b, w, H along the block's own axes; position: its middle, z = 0 is the ground; quaternion (w, x, y, z) turns it",
            "blocks that stand on each other just touch: no gap, no overlap"};
}

std::vector<std::string> comment_motion(const Scene& scene) {
    if (std::holds_alternative<RecordMotion>(scene.base_motion.source)) {
        return {
            "components: the record's component along x, y, z",
            "window: the part that is used, in the record's own time; time.duration is its length at the model's scale",
            "scale: the similitude between the prototype, whose record this is, and the model; leave it out for a record of your table"};
    }
    return {"a synthetic earthquake at the model's scale; another seed makes another with the same peaks",
            "your own record: { \"record\": \"FILE\", \"components\": { \"x\": \"NAME\" } }"};
}

}  // namespace

const std::vector<std::string>& new_scene_kinds() {
    static const std::vector<std::string> kKinds{"tower", "wall", "column", "blocks", "arch", "drums", "mesh", kTilt};
    return kKinds;
}

RecordScale find_scale(const NewScene& wanted) {
    const double friction = wanted.material.material.friction / kPrototypeFriction;
    return {.law = "mu", .set = {{"l", find_length(wanted)}, {"mu", friction}}};
}

Scene make_new_scene(const NewScene& wanted) {
    const scaling::Similitude similitude = make_similitude(find_scale(wanted));
    const Triple<Length> block = find_block(wanted).value_or(make_block(similitude.length()));
    Scene scene;
    scene.structure = make_structure(wanted, block, scene.shapes);
    scene.name = describe_kind(wanted) + ", " + describe_scale(similitude.length());
    scene.material = make_material(wanted, scene.shapes.empty() && wanted.kind != "arch" ? block : reference_block(scene));
    scene.time.duration = rounded(similitude.to_model(kRunDuration * scaling::si::seconds), 3);
    if (wanted.kind == kTilt) {
        TiltMotion tilt;
        tilt.rate = kTiltRate * scaling::kDegree / similitude.time() / scaling::si::seconds;
        scene.time.duration = tilt.duration();
        scene.base_motion.source = tilt;
    } else {
        scene.base_motion.source = make_motion(similitude);
    }
    if (wanted.kind == "wall") scene.time.safety = kWallSafety;
    scene.output.spine_rate = rounded(similitude.to_model(kSpineRate / scaling::si::seconds), 1);
    scene.output.frame_rate = rounded(similitude.to_model(kFrameRate / scaling::si::seconds), 1);
    check_scene(scene, "new scene");
    return scene;
}

ReadableText comment_new_scene(const NewScene& wanted, const Scene& scene) {
    ReadableText text;
    const scaling::Similitude similitude = make_similitude(find_scale(wanted));
    const MaterialPreset* const preset = find_preset(wanted.material);
    text.comments[""] = {"quantities are texts with units; a fraction may stand for a number; texts under \"comment\" are for people"};
    text.comments["/material"] = {fmt::format("{} ({}), fitted to this block: stiffness of a whole face across H", wanted.material.name,
                                              preset != nullptr ? preset->source : "own material"),
                                  "friction and restitution are those of the contact"};
    text.comments["/structure"] = comment_structure(wanted.kind);
    if (tilts(scene)) {
        text.comments["/tilt"] = {
            "about: the axis of the hinges, x or y; rate: slow beside sqrt(g/H); until: where it stops if nothing falls",
            "pivot: a point of that axis, [x, y, z]; the middle of the base without it"};
    } else {
        text.comments["/base_motion"] = comment_motion(scene);
    }
    text.comments["/time"] = {"step: auto takes `safety` times the critical step of the structure; or give a time"};
    text.comments["/output"] = {
        fmt::format("spine_rate: samples a second of the blocks along one edge ({} in the prototype); without it every step is kept",
                    scaling::format_quantity(rounded(similitude.to_prototype(scene.output.spine_rate), 2), 3)),
        "frame_rate: positions of all blocks a second, for films and the 3D view of a report; without it there are none"};
    text.kept = {"/structure/height_deviation", "/structure/seed", "/time/step", "/time/safety"};
    if (tilts(scene)) {
        text.kept.insert({"/tilt/about", "/tilt/until"});
    } else {
        text.kept.insert({"/base_motion/direction", "/base_motion/scale/law", "/base_motion/seed"});
    }
    return text;
}

}  // namespace musim::lsdem
