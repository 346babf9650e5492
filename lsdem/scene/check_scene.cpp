#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <type_traits>
#include <variant>

#include "lsdem/scene/as_listed.hpp"
#include "lsdem/scene/block_heights.hpp"
#include "lsdem/scene/detail/each_structure.hpp"
#include "lsdem/scene/detail/require.hpp"
#include "lsdem/scene/detail/wall_courses.hpp"
#include "lsdem/scene/scene_error.hpp"
#include "lsdem/scene/scene_key.hpp"
#include "scaling/angle.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "scaling/laws/scale_law_catalogue.hpp"
#include "scaling/nearest_name.hpp"
#include "scaling/quantity_text.hpp"

namespace musim::lsdem {

namespace {

using detail::check_name;
using detail::describe;
using detail::fail;
using detail::JsonPlace;
using detail::Range;
using detail::require;
using detail::require_fields;

void check_restitution(double restitution, const JsonPlace& place) {
    if (restitution > 0.0 && restitution <= 1.0) return;
    fail(place, fmt::format("{} (a coefficient of restitution lies above 0 and is at most 1); correct the number", describe(restitution)));
}

void check(const BlockMaterial& material, const JsonPlace& place) {
    require_fields(material, place);
    check_restitution(material.restitution, place.at("restitution"));
}

/// That a name of a pair means one material of the scene, or its ground.
void check_pair_name(const std::string& name, const JsonPlace& place, const Scene& scene) {
    const bool has_meaning = name == kOwnMaterialName || name == kGroundName;
    if (has_meaning && scene.materials.contains(name)) {
        fail(place, fmt::format("\"{}\" is {}, and a key of /materials as well; give that material another name", name,
                                name == kGroundName ? "the plane" : "the scene's own material"));
    }
    if (name == kGroundName && !scene.ground.present) {
        fail(place, "there is no ground to meet (/ground/present is false); leave the pair out");
    }
    if (has_meaning || scene.materials.contains(name)) return;
    std::vector<std::string> known{kOwnMaterialName, kGroundName};
    for (const auto& [key, unused] : scene.materials) known.push_back(key);
    fail(place, fmt::format("\"{}\" is not among the scene's materials; {}", name, scaling::suggest_name(name, known)));
}

void check_pairs(const Scene& scene, const JsonPlace& place) {
    for (std::size_t k = 0; k < scene.pairs.size(); ++k) {
        const PairEntry& pair = scene.pairs[k];
        for (std::size_t i = 0; i < 2; ++i) check_pair_name(pair.of[i], place.at(k).at("of").at(i), scene);
        if (pair.of[0] == pair.of[1]) {
            fail(place.at(k).at("of"),
                 fmt::format("\"{}\" twice (a material meets its like with its own properties); name two", pair.of[0]));
        }
        require_fields(pair, place.at(k));
        if (pair.restitution) check_restitution(*pair.restitution, place.at(k).at("restitution"));
        PairEntry nothing;
        nothing.of = pair.of;
        if (pair == nothing) fail(place.at(k), "no property of the pair is given; give its \"friction\", or leave it out");
        for (std::size_t before = 0; before < k; ++before) {
            const auto& [a, b] = scene.pairs[before].of;
            if ((a != pair.of[0] || b != pair.of[1]) && (a != pair.of[1] || b != pair.of[0])) continue;
            fail(place.at(k).at("of"),
                 fmt::format("\"{}\" and \"{}\" are a pair already, in {} (their order means nothing); keep one of the two", pair.of[0],
                             pair.of[1], place.at(before).text));
        }
    }
}

void check(const BlockEntry& block, const JsonPlace& place, const Scene& scene) {
    if (block.shape.empty() && !std::holds_alternative<SphereShape>(scene.shape)) require(block.size, Range::positive, place.at("size"));
    require_fields(block, place);
    detail::require_rotation(block.quaternion, place.at("quaternion"));
    if (!block.material.empty() && !scene.materials.contains(block.material)) {
        fail(place.at("material"), fmt::format("\"{}\" is not among the scene's materials; add it under /materials", block.material));
    }
}

void check(const BlockList& list, const JsonPlace& place, const Scene& scene) {
    if (list.blocks.empty()) fail(place.at("blocks"), "no block (nothing to simulate); add one");
    std::map<std::string, std::size_t> names;
    for (std::size_t k = 0; k < list.blocks.size(); ++k) {
        const JsonPlace here = place.at("blocks").at(k);
        check(list.blocks[k], here, scene);
        const std::string& name = list.blocks[k].name;
        if (name.empty()) continue;
        check_name(name, here.at("name"));
        const auto [first, is_new] = names.emplace(name, k);
        if (!is_new)
            fail(here.at("name"), fmt::format("block {} is called \"{}\" as well; give each a name of its own", first->second, name));
    }
}

/// Places and names of structures, and that names of blocks that follow from these differ.
void check_assembly(const Assembly& assembly, const Scene& scene, const JsonPlace& place) {
    if (assembly.structures.empty()) fail(place, "no structure (nothing to simulate); add one");
    std::map<std::string, std::size_t> names;
    for (std::size_t k = 0; k < assembly.structures.size(); ++k) {
        const PlacedStructure& placed = assembly.structures[k];
        require_fields(placed, place.at(k));
        if (placed.name.empty()) continue;
        check_name(placed.name, place.at(k).at("name"));
        const auto [first, is_new] = names.emplace(placed.name, k);
        if (!is_new) {
            fail(place.at(k).at("name"),
                 fmt::format("structure {} is called \"{}\" as well; give each a name of its own", first->second, placed.name));
        }
    }
    std::set<std::string> blocks;
    const Scene listed = as_listed(scene);
    for (const BlockEntry& block : std::get<BlockList>(listed.structure).blocks) {
        if (!blocks.insert(block.name).second) fail(place, fmt::format("two blocks are called \"{}\"; rename a structure", block.name));
    }
}

void check_pitch(const std::optional<scaling::Length>& pitch, const Triple<scaling::Length>& block, const JsonPlace& place) {
    const scaling::Length p = pitch.value_or(default_pitch(block));
    if (!(block[0] <= p && block[1] <= 2.0 * p)) {
        fail(place.at("block"),
             fmt::format("blocks of {} x {} overlap their neighbors at a pitch of {} (needs b <= p and w <= 2p); make the "
                         "block smaller or the pitch larger",
                         describe(block[0]), describe(block[1]), describe(p)));
    }
}

void check_heights(scaling::Length deviation, scaling::Length height, const JsonPlace& place) {
    // a similar twin of the limit is at the limit too, up to rounding
    constexpr double kRounding = 1e-12;
    if (deviation > (1.0 + kRounding) * kMostHeightDeviation * height) {
        fail(place,
             fmt::format("{} (more than a twentieth of the height {}: blocks of the far tail would be a fifth too tall); use at most {}",
                         describe(deviation), describe(height), describe(kMostHeightDeviation * height)));
    }
}

void check(const ShapeColumn& /*column*/, const JsonPlace& /*place*/, const Scene& /*scene*/) {}
void check(const Arch& /*arch*/, const JsonPlace& /*place*/, const Scene& /*scene*/) {}

void check(const Column& column, const JsonPlace& place, const Scene& /*scene*/) {
    require_fields(column, place);
    check_heights(column.height_deviation, column.block[2], place.at("height_deviation"));
}

void check(const Tower& tower, const JsonPlace& place, const Scene& /*scene*/) {
    require_fields(tower, place);
    check_pitch(tower.pitch, tower.block, place);
    if (!tower.shape.empty() && tower.height_deviation.value() != 0.0) {
        fail(place.at("height_deviation"), "only boxes are taller or shorter than drawn (the blocks have a \"shape\"); leave it out");
    }
    check_heights(tower.height_deviation, tower.block[2], place.at("height_deviation"));
}

void require_not_negative(int count, const JsonPlace& place) {
    if (count < 0 || count > detail::kLargestCount)
        fail(place, fmt::format("{} (must be from 0 to {}); correct the number", count, detail::kLargestCount));
}

/// Keys of a wall that count from 0.
void check_counts(const Wall& wall, const JsonPlace& place) {
    for (std::size_t k = 0; k < wall.openings.size(); ++k)
        require_not_negative(wall.openings[k].sill, place.at("openings").at(k).at("sill"));
    if (wall.leaves) require_not_negative(wall.leaves->headers_every, place.at("leaves").at("headers_every"));
    if (!wall.returns) return;
    require_not_negative(wall.returns->left, place.at("returns").at("left"));
    require_not_negative(wall.returns->right, place.at("returns").at("right"));
}

void check_lintel(const Wall& wall, const JsonPlace& place, const Scene& scene) {
    if (!wall.lintel) return;
    if (wall.openings.empty()) fail(place, "there is no opening to cross; give the wall \"openings\", or leave it out");
    if (!wall.lintel->material.empty() && !scene.materials.contains(wall.lintel->material)) {
        fail(place.at("material"),
             fmt::format("\"{}\" is not among the scene's materials; add it under /materials", wall.lintel->material));
    }
}

void check(const Wall& wall, const JsonPlace& place, const Scene& scene) {
    require_fields(wall, place);
    check_counts(wall, place);
    check_lintel(wall, place.at("lintel"), scene);
    check_heights(wall.height_deviation, wall.block[2], place.at("height_deviation"));
    const scaling::Length p = wall.pitch.value_or(default_pitch(wall.block));
    if (!(wall.block[1] <= 2.0 * p && wall.block[1] > p)) {
        fail(place.at("pitch"), fmt::format("{} does not suit blocks of width {} (needs p < w <= 2p); choose a pitch a little above w/2",
                                            describe(p), describe(wall.block[1])));
    }
    detail::lay_wall(wall, place);
}

/// Refuses a base that turns farther than upside down.
void require_angle(scaling::Ratio angle, const JsonPlace& place) {
    if (!(angle.value() <= std::numbers::pi))
        fail(place, fmt::format("{:.6g} deg (a base that turns by more than 180 deg carries nothing); correct the angle",
                                angle.value() / scaling::kDegree));
}

void check(const RecordMotion& motion, const JsonPlace& place) {
    if (std::none_of(motion.components.begin(), motion.components.end(), [](const auto& name) { return name.has_value(); })) {
        fail(place.at("components"), "no component is used (the base would not move); name one for x, y, z, rx, ry or rz");
    }
    require_fields(motion, place);
    if (motion.window) {
        const auto& [from, to] = *motion.window;
        if (!(from < to)) {
            fail(place.at("window"), fmt::format("{} to {} is empty; write the earlier time first", describe(from), describe(to)));
        }
    }
    if (motion.scale) {
        try {
            make_similitude(*motion.scale);
        } catch (const scaling::SimilitudeError& error) {
            fail(place.at("scale"), error.worded(scene_key));
        }
    }
}

void check(const SignalMotion& motion, const JsonPlace& place) {
    std::visit([&](const auto& signal) { require_fields(signal, place); }, motion.signal);
    require_fields(motion, place);
    const auto* const rocking = std::get_if<RockingSignal>(&motion.signal);
    if (rocking == nullptr) return;
    require_angle(rocking->angle, place.at("angle"));
    if (!(rocking->cycles >= 2.0)) {
        fail(place.at("cycles"),
             fmt::format("{} (the first cycle grows and the last one fades); give at least 2", describe(rocking->cycles)));
    }
}

void check(const TiltMotion& motion, const JsonPlace& place) {
    require_fields(motion, place);
    require_angle(motion.until, place.at("until"));
}

void check(const Preparation& preparation, const JsonPlace& place, const Scene& scene) {
    require(preparation.damping_rate, Range::positive, place.at("damping_rate"));
    const bool listed = is_listed(scene);
    const auto* tower = std::get_if<Tower>(&scene.structure);
    if (tower != nullptr && !tower->shape.empty() && preparation.placing.value_or(BlockPlacing::as_drawn) != BlockPlacing::as_drawn)
        fail(place.at("placing"), "only boxes are laid in layers (the tower's blocks have a \"shape\"); use \"as_drawn\"");
    if (listed && preparation.placing.value_or(BlockPlacing::as_drawn) != BlockPlacing::as_drawn)
        fail(place.at("placing"), "only columns, towers and walls have layers to be placed (these are single blocks); use \"as_drawn\"");
    if (listed && preparation.specimen && !scene.scatter) {
        fail(place.at("specimen"),
             "only columns, towers and walls, and single blocks with a \"scatter\", are made from specimens; leave it out");
    }
    if (preparation.specimen && preparation.placing) fail(place.at("placing"), "a specimen is placed already; leave one of the two out");
}

void check(const Scatter& scatter, const JsonPlace& place) {
    require_fields(scatter, place);
    constexpr double kMostFriction = 0.2;
    if (scatter.friction > kMostFriction) {
        fail(place.at("friction"),
             fmt::format("{} (a part of the mean; beyond {} joints of the far tail would have none left); use at most {}",
                         describe(scatter.friction), kMostFriction, kMostFriction));
    }
}

void check(std::monostate /*still*/, const JsonPlace& /*place*/) {}

void check(const SceneMotion& motion, const JsonPlace& place, const Scene& scene) {
    std::visit([&](const auto& source) { check(source, place); }, motion.source);
    require_fields(motion.factors, place.at("factors"));
    require_fields(motion, place);
    if (!scene.ground.present && !std::holds_alternative<std::monostate>(motion.source)) {
        fail(place, "there is no ground to move (/ground/present is false); leave one of the two out");
    }
}

/// More repetitions are a slip of the keyboard.
constexpr int kMostRepetitions = 1000;

void check_motions(const Scene& scene, const JsonPlace& place) {
    if (!std::holds_alternative<std::monostate>(scene.base_motion.source)) {
        fail(place, "there is a \"base_motion\" as well (it would be left unused); leave one of the two out");
    }
    for (std::size_t k = 0; k < scene.motions.size(); ++k) {
        const MotionEntry& entry = scene.motions[k];
        if (std::holds_alternative<std::monostate>(entry.base_motion.source))
            fail(place.at(k).at("base_motion"), "no motion (a \"record\" or a \"signal\" is wanted); add one");
        check(entry.base_motion, place.at(k).at("base_motion"), scene);
        require_fields(entry, place.at(k));
        if (entry.repeat < 1 || entry.repeat > kMostRepetitions) {
            fail(place.at(k).at("repeat"), fmt::format("{} (must be from 1 to {}); correct the number", entry.repeat, kMostRepetitions));
        }
        if (k == 0 && !entry.settle && entry.repeat == 1) {
            fail(place.at(k).at("settle"), "no motion comes before the first one (how it begins is up to \"preparation\"); leave it out");
        }
    }
}

}  // namespace

scaling::Length default_pitch(const Triple<scaling::Length>& block) {
    constexpr double kPitchOverWidth = 1.435 / 2.82;
    return block[1] * kPitchOverWidth;
}

const ShapeEntry* Scene::find_shape(const BlockEntry& block) const {
    const auto found = shapes.find(block.shape);
    return found == shapes.end() ? nullptr : &found->second;
}

bool Scene::is_sphere(const BlockEntry& block) const {
    const ShapeEntry* named = find_shape(block);
    return named != nullptr ? named->is_sphere() : std::holds_alternative<SphereShape>(shape);
}

bool Scene::has_contact_nodes() const {
    bool has_spheres = false;
    detail::for_each_structure(*this, JsonPlace{}, [&](const auto& one, const JsonPlace& /*place*/) {
        if constexpr (std::is_same_v<decltype(one), const BlockList&>) {
            has_spheres |= std::any_of(one.blocks.begin(), one.blocks.end(), [&](const BlockEntry& block) { return is_sphere(block); });
        }
    });
    return face_contact != FaceContact::overlap || !std::holds_alternative<BoxShape>(shape) || has_spheres;
}

scaling::Similitude make_similitude(const RecordScale& scale) {
    std::vector<scaling::GivenFactor> given;
    for (const auto& [name, factor] : scale.set) given.push_back({name, factor});
    return scaling::make_similitude(scaling::solve_law(scaling::load_scale_law(scale.law), given));
}

void check_scene(const Scene& scene, const std::string& origin) {
    const JsonPlace root{origin + ": /"};
    require(scene.gravity, Range::finite, root.at("gravity"));
    std::visit([&](const auto& shape) { require_fields(shape, root.at("shape")); }, scene.shape);
    detail::for_each_structure(scene, root, [&](const auto& structure, const JsonPlace& /*place*/) {
        if constexpr (requires { structure.height_deviation; }) {
            if (!std::holds_alternative<SphereShape>(scene.shape)) return;
            fail(root.at("shape").at("kind"),
                 "spheres cannot be stacked as a column, tower or wall; use \"box\", or a structure of kind \"blocks\"");
        }
    });
    detail::check_shapes(scene, root);
    detail::check_kinds(scene, root);
    detail::for_each_structure(scene, root, [&](const auto& structure, const JsonPlace& place) { check(structure, place, scene); });
    if (const auto* assembly = std::get_if<Assembly>(&scene.structure)) check_assembly(*assembly, scene, root.at("structures"));
    if (scene.scatter) check(*scene.scatter, root.at("scatter"));
    check(scene.material, root.at("material"));
    for (const auto& [name, material] : scene.materials) check(material, root.at("materials").at(name));
    check_pairs(scene, root.at("pairs"));

    detail::check_loads(scene, root.at("loads"));
    check(scene.base_motion, root.at(tilts(scene) ? "tilt" : "base_motion"), scene);
    if (!scene.motions.empty()) check_motions(scene, root.at("motions"));
    require_fields(scene.ground, root.at("ground"));

    if (scene.preparation) check(*scene.preparation, root.at("preparation"), scene);

    if (scene.motions.empty() || scene.time.duration.value() != 0.0) {
        require(scene.time.duration, Range::positive, root.at("time").at("duration"));
    }
    require(scene.time.step, Range::positive, root.at("time").at("step"));
    require(scene.time.safety, Range::positive, root.at("time").at("safety"));
    if (scene.time.safety > 1.0) {
        fail(root.at("time").at("safety"),
             fmt::format("{} (steps above the critical one are unstable); use at most 1", describe(scene.time.safety)));
    }
    require_fields(scene.output, root.at("output"));
    detail::check_sensors(scene, root.at("sensors"));
}

}  // namespace musim::lsdem
