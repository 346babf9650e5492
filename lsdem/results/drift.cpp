#include "lsdem/results/drift.hpp"

#include <algorithm>
#include <limits>

#include "lsdem/results/base_frame.hpp"

namespace musim::lsdem {
namespace {

/// Least rise between two blocks, as a part of the lower of their heights: half of what two levels differ by at least (find_levels), since
/// blocks of a specimen have settled.
constexpr double kLeastRise = 0.25;

/// Least overlap of plans, as a part of the shorter of two blocks: blocks beside each other touch.
constexpr double kLeastRoom = 0.01;

/// A block of the spine at the start, with how far it reaches along the world's axes.
struct SpineBox {
    Vector3 center;
    BlockReach reach;

    double bottom() const { return center.z() - reach.below.z(); }
};

SpineBox find_box(const RunData& run, std::size_t s) {
    const std::size_t block = run.spine.block[s];
    return {run.history.spine_position[s], run.blocks.find_reach(block, run.initial.orientation[block])};
}

bool lies_under(const SpineBox& lower, const SpineBox& upper) {
    const Vector3 apart = upper.center - lower.center, extent = upper.reach.extent().cwiseMin(lower.reach.extent());
    const Vector3 room = (upper.reach.above + lower.reach.below + apart).cwiseMin(lower.reach.above + upper.reach.below - apart);
    const Vector3 least_room = kLeastRoom * extent;
    const bool overlaps = room.x() > least_room.x() && room.y() > least_room.y();
    const double least = kLeastRise * extent.z();
    return overlaps && upper.center.z() - lower.center.z() >= least;
}

std::vector<DriftPair> pair_listed(const RunData& run, const std::vector<std::size_t>& order) {
    std::vector<SpineBox> boxes;
    double underside = std::numeric_limits<double>::infinity();
    for (std::size_t s = 0; s < run.spine.size(); ++s) {
        boxes.push_back(find_box(run, s));
        underside = std::min(underside, boxes[s].bottom());
    }
    std::vector<DriftPair> pairs;
    for (auto upper = order.begin(); upper != order.end(); ++upper) {
        if (run.falls.is_airborne(run.spine.block[*upper])) continue;
        DriftPair pair{.upper = *upper, .lower = {}, .rise = boxes[*upper].center.z() - underside};
        for (auto lower = order.begin(); lower != upper; ++lower) {
            if (run.spine.level[*lower] >= run.spine.level[*upper] || !lies_under(boxes[*lower], boxes[*upper])) continue;
            pair.lower = *lower;
            pair.rise = boxes[*upper].center.z() - boxes[*lower].center.z();
        }
        pairs.push_back(pair);
    }
    return pairs;
}

}  // namespace

std::vector<DriftPair> find_drift_pairs(const RunData& run) {
    const std::vector<std::size_t> order = sort_spine_by_height(run);
    if (order.empty() || run.blocks.is_listed()) return pair_listed(run, order);
    const std::vector<Vector3>& start = run.history.spine_position;
    // the base ends where the lowest block begins
    const std::size_t lowest = run.spine.block[order.front()];
    const bool is_solid = run.blocks.find_solid(lowest) != nullptr;
    const double below = is_solid ? find_box(run, order.front()).reach.below.z() : 0.5 * run.blocks.size[lowest].z();
    const double base = start[order.front()].z() - below;
    std::vector<DriftPair> pairs;
    for (std::size_t k = 0; k < order.size(); ++k) {
        DriftPair pair{.upper = order[k], .lower = {}, .rise = start[order[k]].z() - (k > 0 ? start[order[k - 1]].z() : base)};
        if (k > 0) pair.lower = order[k - 1];
        if (pair.rise > 0.0) pairs.push_back(pair);
    }
    return pairs;
}

Drift find_drift(const RunData& run, const std::vector<DriftPair>& pairs, std::size_t sample) {
    Drift largest;
    for (const DriftPair& pair : pairs) {
        const Vector3 below = pair.lower ? find_shift(run, *pair.lower, sample) : Vector3(Vector3::Zero());
        const double drift = (find_shift(run, pair.upper, sample) - below).norm() / pair.rise;
        if (drift > largest.value) largest = {drift, pair.upper};
    }
    return largest;
}

Vector3 find_shift(const RunData& run, std::size_t spine_block, std::size_t sample) {
    Vector3 shift = find_moved(run, spine_block, sample);
    shift.z() = 0.0;
    return shift;
}

}  // namespace musim::lsdem
