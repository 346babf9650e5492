#include "lsdem/scene/detail/lower_loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "lsdem/scene/detail/overlap.hpp"
#include "lsdem/scene/detail/require.hpp"
#include "lsdem/solid/outline.hpp"
#include "scaling/nearest_name.hpp"

namespace musim::lsdem::detail {
namespace {

/// The block that a load names, by its name or its number.
std::size_t find_loaded_block(const std::string& wanted, const std::vector<Placement>& blocks, const JsonPlace& place) {
    const auto named = std::find_if(blocks.begin(), blocks.end(), [&](const Placement& block) { return block.name == wanted; });
    if (named != blocks.end() && !wanted.empty()) return static_cast<std::size_t>(named - blocks.begin());
    const bool is_number = !wanted.empty() && wanted.size() < 10 && wanted.find_first_not_of("0123456789") == std::string::npos;
    if (is_number) {
        if (const std::size_t number = std::stoul(wanted); number < blocks.size()) return number;
        fail(place, fmt::format("there is no block {} (they count from 0 to {}); correct the number", wanted, blocks.size() - 1));
    }
    std::vector<std::string> known;
    for (const Placement& block : blocks) {
        if (!block.name.empty()) known.push_back(block.name);
    }
    if (known.empty()) fail(place, fmt::format("no block is called \"{}\" (these have numbers, from 0); give the number", wanted));
    fail(place, fmt::format("no block is called \"{}\"; {}", wanted, scaling::suggest_name(wanted, known)));
}

/// Distance of a point, in the body frame, from a block; negative inside [m].
double find_distance(const Model& model, const Placement& placed, const Block& block, const Vector3& point) {
    const Shape& shape = model.shapes[block.shape];
    if (!shape.faceted) return point.norm() - shape.half_extents.x();
    return find_gap(Outline{0.5 * placed.own_size(), shape.solid.get()}, point);
}

Load lower_load(const LoadEntry& entry, const std::vector<Placement>& blocks, const Model& model, const JsonPlace& place) {
    Load load;
    load.block = find_loaded_block(entry.block, blocks, place.at("block"));
    const Block& block = model.blocks[load.block];
    if (block.fixed) fail(place.at("block"), fmt::format("\"{}\" is held (no load moves it); name one that can move", entry.block));
    if (entry.point) {
        load.point = block.orientation.conjugate() * (to_vector(*entry.point) - block.position);
        const double distance = find_distance(model, blocks[load.block], block, load.point);
        if (distance > kTouchingTolerance * blocks[load.block].own_size().minCoeff()) {
            fail(place.at("point"), fmt::format("it lies {} away from block \"{}\" (a load acts on a point of its block); move it there",
                                                describe(scaling::Length::from_value(distance)), entry.block));
        }
    }
    load.start = entry.start.value();
    load.rise = entry.rise.value();
    const Vector3 whole = entry.force ? to_vector(*entry.force) : to_vector(*entry.displacement);
    load.direction = whole.normalized();
    if (entry.force) {
        load.force = whole.norm();
        return load;
    }
    load.displacement = whole.norm();
    const double of_face = model.materials[block.material].normal_stiffness * model.shapes[block.shape].face_area;
    load.stiffness = entry.stiffness ? entry.stiffness->value() : kActuatorPart * of_face;
    return load;
}

}  // namespace

std::vector<Load> lower_loads(const Scene& scene, const std::vector<Placement>& blocks, const Model& model) {
    const JsonPlace place = JsonPlace{scene.place() + ": /"}.at("loads");
    std::vector<Load> loads;
    for (std::size_t k = 0; k < scene.loads.size(); ++k) loads.push_back(lower_load(scene.loads[k], blocks, model, place.at(k)));
    return loads;
}

}  // namespace musim::lsdem::detail
