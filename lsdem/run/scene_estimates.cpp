#include "lsdem/run/scene_estimates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "lsdem/contact_law.hpp"
#include "lsdem/scene/as_listed.hpp"
#include "lsdem/scene/reference_block.hpp"
#include "lsdem/statics/overturning.hpp"
#include "lsdem/statics/rigid_statics.hpp"
#include "scaling/quantity_text.hpp"
#include "scaling/structures/structural_speed.hpp"

namespace musim::lsdem {
namespace {

using scaling::Direction;
using scaling::StructureProperties;

/// First listed block that moves, else the first of all; nothing for other structures.
const BlockEntry* find_listed(const Scene& scene) {
    const auto* list = std::get_if<BlockList>(&scene.structure);
    if (list == nullptr) return nullptr;
    const auto moves =
        std::find_if(list->blocks.begin(), list->blocks.end(), [](const BlockEntry& block) { return block.fixed == Held::free; });
    return moves == list->blocks.end() ? &list->blocks.front() : &*moves;
}

const BlockMaterial& find_material(const BlockEntry* listed, const Scene& scene) {
    return listed == nullptr || listed->material.empty() ? scene.material : scene.materials.at(listed->material);
}

/// The block, its thinner horizontal edge first, the least friction that occurs, and the layers where the structure has any.
StructureProperties make_properties(const Scene& scene, double friction, const scaling::Acceleration& gravity) {
    const BlockEntry* const listed = find_listed(scene);
    const BlockMaterial& material = find_material(listed, scene);
    StructureProperties properties;
    properties.block = listed == nullptr ? reference_block(scene) : find_block_size(scene, *listed);
    if (properties.block[1] < properties.block[0]) std::swap(properties.block[0], properties.block[1]);
    properties.density = material.density;
    properties.friction = friction;
    properties.gravity = gravity;
    properties.normal_stiffness = material.normal_stiffness;
    properties.shear_stiffness = material.shear_stiffness;
    std::visit(
        [&](const auto& structure) {
            if constexpr (requires { structure.layers; }) properties.layers = structure.layers;
        },
        scene.structure);
    return properties;
}

template <class Quantity>
std::string write(Quantity quantity) {
    return scaling::format_quantity(quantity, 4);
}

/// An acceleration that is a multiple of the scene's gravity, in standard g as motions are.
std::string write_limit(double over_gravity, const scaling::Acceleration& gravity) {
    return fmt::format("{:.3g} g", over_gravity * gravity.value() / scaling::kStandardGravity.value());
}

/// Accelerations over gravity at which a structure overturns as one body, along x and y.
using Overturning = std::array<std::optional<double>, 2>;

/// Does it rest where it is drawn?
bool can_stand(const SceneStanding& standing) {
    return standing.begins == SceneStanding::Begins::in_equilibrium ||
           (standing.statics && standing.statics->answer == RigidStatics::Answer::can_stand);
}

/// Is nothing known against that? Laid blocks stand near to where they are drawn.
bool may_stand(const SceneStanding& standing) {
    using Answer = RigidStatics::Answer;
    if (standing.begins == SceneStanding::Begins::out_of_equilibrium) return can_stand(standing);
    return !standing.statics || standing.statics->answer != Answer::cannot_stand;
}

Overturning find_both(const Scene& scene, const Specimen& upright) {
    Overturning both;
    for (const int axis : {0, 1}) {
        both[static_cast<std::size_t>(axis)] = std::holds_alternative<BlockList>(scene.structure)
                                                   ? find_overturning(upright.model, axis)
                                                   : find_overturning_of_layers(upright.model, upright.layer, axis);
    }
    return both;
}

/// That along the world axis nearest to the thin or wide horizontal edge of the first block; nothing where that edge is upright.
std::optional<double> find_along_edge(const Specimen& upright, const Overturning& overturning, Direction direction) {
    const Block& block = upright.model.blocks.front();
    const Vector3& half = upright.model.shapes[block.shape].half_extents;
    const int edge = (half.x() <= half.y()) == (direction == Direction::thin) ? 0 : 1;
    Eigen::Index axis = 0;
    (block.orientation.toRotationMatrix().col(edge)).cwiseAbs().maxCoeff(&axis);
    return axis == 2 ? std::nullopt : overturning[static_cast<std::size_t>(axis)];
}

void add_overturning(std::vector<SceneEstimate>& estimates, const Overturning& overturning, const scaling::Acceleration& gravity) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
        if (!overturning[axis]) continue;
        const char name = axis == 0 ? 'x' : 'y';
        estimates.push_back({.key = fmt::format("overturning_{}", name),
                             .title = fmt::format("the structure overturns as one body along {} above", name),
                             .text = write_limit(*overturning[axis], gravity),
                             .value = *overturning[axis],
                             .formula = "edge - centre over its height, least above any joint: b/(N H)"});
    }
}

void add_steady(std::vector<SceneEstimate>& estimates, const Model& model, const scaling::Acceleration& gravity) {
    const std::array<Vector3, 2> axes{Vector3::UnitX(), Vector3::UnitY()};
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const std::optional<double> one = find_steady_acceleration(model, axes[axis]), other = find_steady_acceleration(model, -axes[axis]);
        if (!one || !other) continue;
        const char name = axis == 0 ? 'x' : 'y';
        const double least = std::max(0.0, std::min(*one, *other));
        estimates.push_back({.key = fmt::format("steady_{}", name),
                             .title = fmt::format("rigid blocks can bear an acceleration that is held along {} up to", name),
                             .text = write_limit(least, gravity),
                             .value = least,
                             .formula = "rigid statics, less if blocks slide while they turn"});
    }
}

/// `structure`: acceleration over gravity at which the structure overturns in this direction, as one body.
void add_rocking(std::vector<SceneEstimate>& estimates, const StructureProperties& properties, Direction direction, double pga_over_gravity,
                 const std::optional<double>& structure) {
    const std::string side(scaling::to_string(direction));
    const std::string edge = direction == Direction::thin ? "b" : "w";
    const scaling::RockingBlock block = properties.rocking_block(direction);
    const double slenderness = block.slenderness();
    estimates.push_back({.key = "rocking_" + side,
                         .title = fmt::format("a block rocks across its {} side above", side),
                         .text = write_limit(slenderness, properties.gravity),
                         .value = slenderness,
                         .formula = edge + "/H"});
    estimates.push_back({.key = "frequency_parameter_" + side,
                         .title = fmt::format("frequency parameter p across the {} side", side),
                         .text = fmt::format("{:.3g} 1/s", block.frequency_parameter(properties.gravity).value()),
                         .value = block.frequency_parameter(properties.gravity).value(),
                         .formula = fmt::format("sqrt(3g/(4R)), R = sqrt({}^2 + H^2)/2", edge)});
    if (!(pga_over_gravity > 0.0)) return;
    const bool as_one = structure && *structure < slenderness;
    const double least = as_one ? *structure : slenderness;
    estimates.push_back({.key = "first_motion_" + side,
                         .title = fmt::format("under {}, across the {} side, {}", write_limit(pga_over_gravity, properties.gravity), side,
                                              as_one ? "the structure as one body" : "a block"),
                         .text = std::string(to_string(scaling::find_first_motion(pga_over_gravity, properties.friction, least))),
                         .formula = "Shenton 1996"});
}

/// Lowest frequency of a chain of equal masses on springs that stands on the ground.
scaling::Frequency find_chain_frequency(const scaling::Stiffness& stiffness, const scaling::Mass& mass, int blocks) {
    const double root = std::sqrt(stiffness.value() / mass.value());
    return scaling::Frequency::from_value(root / std::numbers::pi * std::sin(std::numbers::pi / (4.0 * blocks + 2.0)));
}

void add_structure(std::vector<SceneEstimate>& estimates, const StructureProperties& properties) {
    const scaling::StructuralSpeeds speeds = scaling::find_structural_speeds(properties);
    const auto add = [&](const char* key, const char* title, const auto& quantity, const char* formula) {
        estimates.push_back({.key = key, .title = title, .text = write(quantity), .value = quantity.value(), .formula = formula});
    };
    add("shear_frequency", "lowest shear frequency, joints stick and blocks do not turn",
        find_chain_frequency(*properties.shear_stiffness, properties.block_mass(), properties.layers), "sqrt(k_s/m) sin(pi/(4N + 2))/pi");
    add("vertical_frequency", "lowest vertical frequency",
        find_chain_frequency(*properties.normal_stiffness, properties.block_mass(), properties.layers), "sqrt(k_n/m) sin(pi/(4N + 2))/pi");
    add("elastic_speed", "elastic structural speed c_e", *speeds.shear, "H sqrt(k_s/m)");
    add("climb_stick", "sway climbs to the top in, joints stick", *speeds.climb_stick, "N H/c_e");
    add("climb_slip", "the same, joints slip", *speeds.climb_slip, "2 N H/c_e");
    const double weight = properties.block_mass().value() * properties.gravity.value();
    const double overlap = properties.layers * weight / (properties.normal_stiffness->value() * properties.block[2].value());
    estimates.push_back({.key = "base_overlap",
                         .title = "overlap of the lowest faces under dead weight, over H",
                         .text = fmt::format("{:.2g}", overlap),
                         .value = overlap,
                         .formula = "N m g/(k_n H)"});
}

}  // namespace

double find_least_friction(const Model& model, int levels) {
    const std::vector<Block>& blocks = model.blocks;
    const std::size_t material = blocks.front().material;
    const bool on_ground = model.ground.present;
    double least = on_ground ? find_joint(model, material, std::nullopt).friction : model.materials[material].friction;
    if (on_ground && levels <= 1) return least;
    for (std::size_t b = 1; b < blocks.size(); ++b) least = std::min(least, find_joint(model, material, blocks[b].material).friction);
    return least;
}

std::vector<SceneEstimate> estimate_scene(const Scene& given, double friction, const Specimen& upright,
                                          const std::vector<MotionSummary>& motions, const SceneStanding& standing) {
    const Scene scene = as_listed(given);
    const auto gravity =
        scaling::Acceleration::from_value(std::hypot(scene.gravity[0].value(), scene.gravity[1].value(), scene.gravity[2].value()));
    const bool is_vertical = scene.gravity[0].value() == 0.0 && scene.gravity[1].value() == 0.0 && scene.gravity[2].value() < 0.0;
    if (std::holds_alternative<SphereShape>(scene.shape) || !is_vertical) return {};
    const StructureProperties properties = make_properties(scene, friction, gravity);
    double pga = 0.0;
    for (const MotionSummary& motion : motions) {
        for (const AxisMotion& axis : motion.axes) pga = axis.axis == 'z' ? pga : std::max(pga, axis.pga);
    }
    std::vector<SceneEstimate> estimates;
    const Overturning overturning = may_stand(standing) ? find_both(scene, upright) : Overturning{};
    for (const Direction direction : {Direction::thin, Direction::wide})
        add_rocking(estimates, properties, direction, pga / gravity.value(), find_along_edge(upright, overturning, direction));
    add_overturning(estimates, overturning, gravity);
    if (can_stand(standing)) add_steady(estimates, upright.model, gravity);
    estimates.push_back({.key = "sliding",
                         .title = "a block slides above",
                         .text = write_limit(properties.friction, gravity),
                         .value = properties.friction,
                         .formula = upright.model.scatter.friction > 0.0 ? "least friction coefficient, without its scatter"
                                                                         : "least friction coefficient"});
    const double contact = std::sqrt(properties.normal_stiffness->value() / properties.block_mass().value()) / (2.0 * std::numbers::pi);
    estimates.push_back({.key = "contact_frequency",
                         .title = "a block on one face, up and down",
                         .text = write(scaling::Frequency::from_value(contact)),
                         .value = contact,
                         .formula = "sqrt(k_n/m)/(2 pi)"});
    if (!std::holds_alternative<BlockList>(scene.structure)) add_structure(estimates, properties);
    return estimates;
}

}  // namespace musim::lsdem
