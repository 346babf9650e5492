#include "lsdem/scene/build_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "lsdem/bodies.hpp"
#include "lsdem/contact_law.hpp"
#include "lsdem/scene/as_listed.hpp"
#include "lsdem/scene/base_components.hpp"
#include "lsdem/scene/detail/lower_loads.hpp"
#include "lsdem/scene/detail/overlap.hpp"
#include "lsdem/scene/detail/placement.hpp"
#include "lsdem/scene/detail/scene_fields.hpp"
#include "lsdem/scene/reference_block.hpp"
#include "lsdem/scene/scene_error.hpp"
#include "lsdem/time_step.hpp"
#include "scaling/quantity_text.hpp"

namespace musim::lsdem {

namespace {

using detail::Placement;

/// A block as messages call it: its place in an explicit list, its number and name, or its number and layer.
std::string name_block(const Scene& scene, const std::vector<Placement>& blocks, std::size_t index) {
    const std::string& name = blocks[index].name;
    if (std::holds_alternative<BlockList>(scene.structure))
        return fmt::format("/structure/blocks/{}{}", index, name.empty() ? name : fmt::format(" (\"{}\")", name));
    if (is_listed(scene)) return fmt::format("block {} (\"{}\")", index, name);
    return fmt::format("block {} (layer {})", index, blocks[index].layer);
}

std::string format_length(double meters) { return scaling::format_quantity(scaling::Length::from_value(meters)); }

/// Box lattice with the scene's nodes on a whole face; a half block keeps the spacing of a whole one.
NodeLattice make_lattice(const Placement& block, int nodes_per_face) {
    NodeLattice lattice = make_node_lattice(block.whole_size, nodes_per_face);
    if (block.size == block.whole_size) return lattice;
    const auto spread = [](int nodes, double part) { return std::max(2, static_cast<int>(std::lround((nodes - 1) * part)) + 1); };
    const double across = block.size.x() / block.whole_size.x(), along = block.size.y() / block.whole_size.y();
    const bool is_half = along < 0.5 && along > 0.375;
    lattice.nx = spread(lattice.nx, across);
    lattice.ny = is_half ? lattice.ny / 2 + 1 : spread(lattice.ny, along);
    return lattice;
}

/// Boxes that meet without nodes have them at their corners only.
Shape make_shape(const BoxShape& settings, const Placement& block, bool has_contact_nodes) {
    return make_box_shape(block.size, has_contact_nodes ? make_lattice(block, settings.nodes_per_face) : NodeLattice{2, 2, 2});
}

Shape make_shape(const GridShape& settings, const Placement& block, bool /*has_contact_nodes*/) {
    return make_grid_box_shape(block.size, make_lattice(block, settings.nodes_per_face), settings.voxel.value());
}

Shape make_shape(const SphereShape& settings, const Placement& /*block*/, bool /*has_contact_nodes*/) {
    return make_sphere_shape(settings.radius.value(), static_cast<std::size_t>(settings.nodes), settings.voxel.value());
}

/// Shape of a block: a solid, a sphere that it names, or as the scene has it for all.
Shape make_shape(const Scene& scene, const Placement& block) {
    if (block.solid) return *block.solid;
    const bool has_nodes = scene.has_contact_nodes();
    if (!block.shape.empty()) return make_shape(std::get<SphereShape>(scene.shapes.at(block.shape).form), block, has_nodes);
    return std::visit([&](const auto& settings) { return make_shape(settings, block, has_nodes); }, scene.shape);
}

double lower(scaling::Stiffness stiffness, double face_area) { return stiffness.value() / face_area; }
double lower(double number, double /*face_area*/) { return number; }

/// Calls `visit(field)` for every property of contact.
template <class Visit>
void for_each_contact_field(const Visit& visit) {
    std::apply([&](const auto&... field) { (visit(field), ...); }, detail::kContactFields);
}

Material make_material(const BlockMaterial& material, double face_area) {
    Material made;
    for_each_contact_field([&](const auto& field) { made.*field.lowered = lower(material.*field.of_material, face_area); });
    return made;
}

/// Point of the plane in the middle of the extent of all blocks along x and y [m].
Vector3 find_middle_of_base(const Model& model) {
    const Bodies bodies(model);
    Vector3 middle = Vector3::Zero();
    for (const int axis : {0, 1}) {
        const Vector3 along = Vector3::Unit(axis);
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            const double at = bodies.pose[i].position[axis];
            low = std::min(low, at - bodies.find_reach(i, -along)), high = std::max(high, at + bodies.find_reach(i, along));
        }
        if (low < high) middle[axis] = 0.5 * (low + high);
    }
    return middle;
}

/// Adds blocks to a model; equal blocks share their shape and their material.
class ModelBuilder {
  public:
    /// The stiffnesses of all materials are those of `face_area` [m²].
    ModelBuilder(const Scene& scene, double face_area, Model& model) : scene_(scene), face_area_(face_area), model_(model) {}

    void add(const Placement& placement) {
        Block block;
        block.shape = find_or_add_shape(placement);
        block.material = find_or_add_material(placement);
        block.height_offset = placement.height_offset;
        const Shape& shape = model_.shapes[block.shape];
        const double density = placement.density.value_or(material_of(placement).density.value());
        block.mass = placement.mass.value_or(density * (shape.volume + shape.face_area * block.height_offset));
        block.position = placement.position;
        block.orientation = placement.orientation;
        block.velocity = placement.velocity;
        block.angular_velocity = placement.angular_velocity;
        block.fixed = placement.fixed;
        block.with_base = placement.with_base;
        block.rotation_locked = placement.rotation_locked;
        model_.blocks.push_back(block);
    }

    /// Adds pairs of materials that blocks have, and of those with a ground that has a friction of its own.
    void add_pairs() {
        for (const PairEntry& pair : scene_.pairs) {
            const bool ground_first = pair.of[0] == kGroundName;
            const std::optional<std::size_t> a = find_material(pair.of[ground_first ? 1 : 0]),
                                             b = find_material(pair.of[ground_first ? 0 : 1]);
            const bool on_ground = ground_first || pair.of[1] == kGroundName;
            if (a && (b || on_ground)) add_pair(*a, b, pair);
        }
        if (!scene_.ground.friction || !scene_.ground.present) return;
        for (std::size_t m = 0; m < model_.materials.size(); ++m) {
            const auto is_known = [&](const MaterialPair& pair) { return pair.is_of(m, std::nullopt); };
            if (std::none_of(model_.pairs.begin(), model_.pairs.end(), is_known)) add_pair(m, std::nullopt, {});
        }
    }

  private:
    /// Index of a material that a pair names; nothing where no block has it, and for the ground.
    std::optional<std::size_t> find_material(const std::string& name) const {
        const auto found = materials_.find(name == kOwnMaterialName ? "" : name);
        return found == materials_.end() ? std::nullopt : std::optional(found->second);
    }

    /// `second`: nothing for the ground.
    void add_pair(std::size_t first, std::optional<std::size_t> second, const PairEntry& given) {
        Material joint = find_joint(model_, first, second);
        if (!second) joint.friction = scene_.ground.friction.value_or(joint.friction);
        for_each_contact_field([&](const auto& field) {
            if (const auto& own = given.*field.of_pair) joint.*field.lowered = lower(*own, face_area_);
        });
        model_.pairs.push_back({first, second, joint});
    }

    const BlockMaterial& material_of(const Placement& placement) const {
        return placement.material.empty() ? scene_.material : scene_.materials.at(placement.material);
    }

    std::size_t find_or_add_shape(const Placement& placement) {
        const std::pair key{placement.shape, std::array{placement.size.x(), placement.size.y(), placement.size.z()}};
        const auto [entry, is_new] = shapes_.try_emplace(key, model_.shapes.size());
        if (is_new) model_.shapes.push_back(make_shape(scene_, placement));
        return entry->second;
    }

    std::size_t find_or_add_material(const Placement& placement) {
        const auto [entry, is_new] = materials_.try_emplace(placement.material, model_.materials.size());
        if (is_new) model_.materials.push_back(make_material(material_of(placement), face_area_));
        return entry->second;
    }

    const Scene& scene_;
    double face_area_;
    Model& model_;
    std::map<std::pair<std::string, std::array<double, 3>>, std::size_t> shapes_;  ///< by name, and by size of boxes
    std::map<std::string, std::size_t> materials_;
};

void refuse_overlaps(const Scene& scene, const std::vector<Placement>& blocks) {
    const std::vector<detail::Body> bodies = detail::make_bodies(scene, blocks);
    if (const auto overlap = detail::find_deepest_overlap(bodies)) {
        throw SceneError(fmt::format("{}: {} and {} overlap by {} at the start (blocks may touch, not overlap); move them apart",
                                     scene.place(), name_block(scene, blocks, overlap->first), name_block(scene, blocks, overlap->second),
                                     format_length(overlap->depth)));
    }
    if (!scene.ground.present) return;
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        const detail::Body& body = bodies[k];
        if (body.fixed) continue;
        const double depth = detail::compute_depth_in_ground(body);
        if (depth > detail::kTouchingTolerance * 2.0 * body.half.minCoeff()) {
            throw SceneError(fmt::format("{}: {} reaches {} below the ground at the start (the ground is the plane z = 0); lift it",
                                         scene.place(), name_block(scene, blocks, k), format_length(depth)));
        }
    }
}

}  // namespace

BuiltModel build_model(const Scene& scene) {
    check_scene(scene, scene.place());
    const detail::Arrangement arrangement = detail::arrange(scene);
    refuse_overlaps(scene, arrangement.blocks);

    BuiltModel built;
    Model& model = built.model;
    const double face_area = reference_area(scene).value();
    ModelBuilder builder(scene, face_area, model);
    model.blocks.reserve(arrangement.blocks.size());
    try {
        for (const Placement& placement : arrangement.blocks) builder.add(placement);
    } catch (const std::invalid_argument& error) {
        throw SceneError(fmt::format("{}: /shape: {}", scene.place(), error.what()));
    }

    model.ground.present = scene.ground.present;
    model.ground.material = make_material(scene.material, face_area);
    model.ground.material.friction = scene.ground.friction.value_or(scene.material.friction);
    builder.add_pairs();
    model.ground.motion = make_base_components(scene.base_motion, scene.place() + ": /base_motion");
    if (model.ground.motion.turns() && !scene.base_motion.pivot) model.ground.motion.pivot = find_middle_of_base(model);
    model.gravity = detail::to_vector(scene.gravity);
    model.loads = detail::lower_loads(scene, arrangement.blocks, model);
    if (scene.scatter && scene.scatter->friction != 0.0) model.scatter = {scene.scatter->friction, scene.scatter->seed};
    model.numerics.contact_nodes = scene.contact_nodes;
    model.numerics.face_contact = scene.face_contact;

    built.structure.spine = arrangement.spine;
    for (std::size_t k = 0; k < scene.loads.size(); ++k) built.structure.load.push_back(scene.loads[k].label(k));
    for (const Placement& placement : arrangement.blocks) {
        built.structure.layer.push_back(placement.layer);
        built.structure.level.push_back(placement.level);
        if (placement.layer == 0) built.structure.name.push_back(placement.name);
    }
    return built;
}

Model make_model(const Scene& scene) { return build_model(scene).model; }

scaling::Time compute_time_step(const Scene& scene, const Model& model) {
    const auto is_held = [](const Block& block) { return block.fixed; };
    if (!scene.time.step && std::all_of(model.blocks.begin(), model.blocks.end(), is_held)) {
        throw SceneError(scene.place() + ": /structure: all blocks are held in place (nothing can move); leave \"fixed\" out of one");
    }
    if (!scene.time.step) return scaling::Time::from_value(scene.time.safety * compute_critical_time_step(model));
    const std::optional<double> critical = find_critical_time_step(model);
    if (critical && scene.time.step->value() > kLargestStep * *critical) {
        throw SceneError(
            fmt::format("{}: the \"step\" {:.4g} s is {:.3g} times the critical one, {:.4g} s (blocks that can turn are stable up to {} "
                        "times); take at most {:.4g} s, or \"auto\"",
                        scene.place(), scene.time.step->value(), scene.time.step->value() / *critical, *critical, kLargestStep,
                        TimeSettings{}.safety * *critical));
    }
    return *scene.time.step;
}

}  // namespace musim::lsdem
