#include "lsdem/run/drawn_places.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "lsdem/block_height.hpp"
#include "lsdem/fallen.hpp"
#include "lsdem/scene/carriers.hpp"

namespace musim::lsdem {
namespace {

bool is_listed(const Specimen& specimen) {
    return std::all_of(specimen.layer.begin(), specimen.layer.end(), [](int layer) { return layer == 0; });
}

/// Where a point that belonged to a drawn box is now.
Vector3 carry(const BoxPose& drawn, const Kinematics& now, std::size_t block, const Vector3& point) {
    return now.position[block] + now.orientation[block] * (drawn.orientation.conjugate() * (point - drawn.position));
}

/// Distance by which a joint has slipped or opened [m].
double find_left(const std::vector<BoxPose>& drawn, const Kinematics& now, std::size_t block, const Carrier& carrier) {
    const Vector3 below = carrier.block ? carry(drawn[*carrier.block], now, *carrier.block, carrier.meeting) : carrier.meeting;
    Vector3 apart = carry(drawn[block], now, block, carrier.meeting) - below;
    if (apart.z() < 0.0) apart.z() = std::min(0.0, apart.z() + carrier.gap);
    return apart.norm();
}

/// Angle by which a block has turned against what carries it [rad].
double find_turn(const std::vector<BoxPose>& drawn, const Kinematics& now, std::size_t block, const Carrier& carrier) {
    const auto since = [&](std::size_t b) { return Quaternion(now.orientation[b] * drawn[b].orientation.conjugate()); };
    return since(block).angularDistance(carrier.block ? since(*carrier.block) : Quaternion::Identity());
}

/// Distance that every block can sink until it rests [m]; infinite where that is not known.
std::vector<double> find_sinks(const std::vector<BoxPose>& drawn, const std::vector<std::vector<Carrier>>& carriers) {
    std::vector<std::size_t> upward(drawn.size());
    std::iota(upward.begin(), upward.end(), std::size_t{0});
    std::stable_sort(upward.begin(), upward.end(),
                     [&](std::size_t a, std::size_t b) { return drawn[a].position.z() < drawn[b].position.z(); });
    std::vector<double> sinks(drawn.size(), std::numeric_limits<double>::infinity());
    for (const std::size_t b : upward) {
        if (carriers[b].empty()) continue;
        sinks[b] = 0.0;
        for (const Carrier& carrier : carriers[b])
            sinks[b] = std::max(sinks[b], carrier.gap + (carrier.block ? sinks[*carrier.block] : 0.0));
    }
    return sinks;
}

std::vector<int> find_airborne(const Specimen& specimen, const std::vector<std::vector<Carrier>>& carriers,
                               const std::vector<Vector3>& velocity) {
    const Model& model = specimen.model;
    std::vector<int> airborne(model.blocks.size(), 0);
    if (!is_listed(specimen)) return airborne;
    for (std::size_t b = 0; b < airborne.size(); ++b) {
        if (model.blocks[b].fixed) continue;
        const double up = velocity[b].z(), height = 2.0 * half_extents(model, model.blocks[b]).z();
        const bool thrown = up > 0.0 && up * up > 2.0 * model.gravity.norm() * kFallenDrop * height;
        airborne[b] = carriers[b].empty() || thrown ? 1 : 0;
    }
    return airborne;
}

}  // namespace

std::vector<BoxPose> find_boxes(const Model& model) {
    std::vector<BoxPose> boxes;
    for (const Block& block : model.blocks)
        boxes.push_back({2.0 * half_extents(model, block), block.position, block.orientation, model.shapes[block.shape].solid});
    return boxes;
}

std::vector<MovedBlock> find_fallen(const Specimen& specimen, const Kinematics& now) {
    const std::vector<BoxPose>& drawn = specimen.drawn;
    const Model& model = specimen.model;
    const std::vector<std::vector<Carrier>> carriers = find_carriers(drawn, model.ground.present);
    const std::vector<double> sinks = find_sinks(drawn, carriers);
    std::vector<Vector3> velocity;
    for (const Block& block : model.blocks) velocity.push_back(block.velocity);
    const std::vector<int> airborne = drawn.empty() ? std::vector<int>{} : find_airborne(specimen, carriers, velocity);
    std::vector<MovedBlock> fallen;
    for (std::size_t b = 0; b < drawn.size(); ++b) {
        if (model.blocks[b].fixed || airborne[b] != 0) continue;
        const double sunk = drawn[b].position.z() - now.position[b].z() - sinks[b];
        double left = carriers[b].empty() ? 0.0 : std::numeric_limits<double>::infinity(), turn = left;
        for (const Carrier& carrier : carriers[b]) {
            left = std::min(left, find_left(drawn, now, b, carrier));
            turn = std::min(turn, find_turn(drawn, now, b, carrier));
        }
        // what is listed with a velocity is meant to leave its place
        const bool is_pushed = !velocity[b].isZero(0.0) || !model.blocks[b].angular_velocity.isZero(0.0);
        if (is_pushed) left = turn = 0.0;
        const bool stands = left <= kLeftPlace * drawn[b].size.minCoeff() && turn <= kLeftTurn &&
                            !has_fallen(drawn[b].reach().extent().z(), drawn[b].orientation.toRotationMatrix(),
                                        now.orientation[b].toRotationMatrix(), sunk);
        if (stands) continue;
        const double turned = now.orientation[b].angularDistance(drawn[b].orientation);
        fallen.push_back({.block = b, .drawn = drawn[b].position, .now = now.position[b], .turned = turned});
    }
    return fallen;
}

std::vector<int> find_airborne(const Specimen& specimen, const Kinematics& start) {
    if (!is_listed(specimen)) return std::vector<int>(specimen.model.blocks.size(), 0);
    std::vector<BoxPose> boxes = find_boxes(specimen.model);
    for (std::size_t b = 0; b < boxes.size(); ++b) boxes[b].position = start.position[b], boxes[b].orientation = start.orientation[b];
    return find_airborne(specimen, find_carriers(boxes, specimen.model.ground.present), start.velocity);
}

void note_fallen(const Specimen& specimen, const Kinematics& now, Rest& rest) {
    rest.fallen = find_fallen(specimen, now);
    const auto fallen = static_cast<double>(rest.fallen.size()), blocks = static_cast<double>(specimen.model.blocks.size());
    rest.collapsed = is_listed(specimen) ? fallen > 0.0 : fallen > 0.0 && fallen >= kCollapsedFraction * blocks;
}

}  // namespace musim::lsdem
