#include "lsdem/scene/carriers.hpp"

#include <algorithm>
#include <utility>

#include "lsdem/fallen.hpp"
#include "lsdem/scene/detail/overlap.hpp"

namespace musim::lsdem {
namespace {

/// A block with its bounding box along the world's axes.
struct Bounded {
    detail::Body body;
    BlockReach reach;

    explicit Bounded(const BoxPose& box)
        : body{.half = 0.5 * box.size,
               .center = box.position,
               .axes = box.orientation.toRotationMatrix(),
               .round = false,
               .fixed = false,
               .solid = box.solid.get()},
          reach(box.reach()) {}
    double low(int axis) const { return body.center[axis] - reach.below[axis]; }
    double high(int axis) const { return body.center[axis] + reach.above[axis]; }
    double bottom() const { return low(2); }
    double top() const { return high(2); }
    double drop() const { return kFallenDrop * reach.extent().z(); }
};

bool overlap_in_plan(const Bounded& a, const Bounded& b) {
    const Vector3 apart = a.body.center - b.body.center;
    const Vector3 room = (a.reach.above + b.reach.below + apart).cwiseMin(b.reach.above + a.reach.below - apart);
    return (room.head<2>().array() > 0.0).all();
}

/// The joint of a block with the one below, when it carries it.
std::optional<Carrier> find_joint(const Bounded& upper, const Bounded& lower, std::size_t index) {
    if (!overlap_in_plan(upper, lower)) return std::nullopt;
    detail::Body lowered = upper.body;
    lowered.center.z() -= upper.drop();
    const double edge = 2.0 * std::min(upper.body.half.minCoeff(), lower.body.half.minCoeff());
    if (!(detail::compute_overlap(lowered, lower.body) > kLeastBearing * edge)) return std::nullopt;
    Carrier carrier{.block = index, .gap = std::max(0.0, upper.bottom() - lower.top())};
    for (int axis = 0; axis < 2; ++axis) {
        const double low = std::max(upper.low(axis), lower.low(axis)), high = std::min(upper.high(axis), lower.high(axis));
        carrier.meeting[axis] = 0.5 * (low + high);
    }
    // inclined faces meet somewhere between the lowest point of the one and the highest of the other
    carrier.meeting.z() = 0.5 * (upper.bottom() + std::max(upper.bottom(), lower.top()));
    return carrier;
}

}  // namespace

std::vector<std::vector<Carrier>> find_carriers(const std::vector<BoxPose>& boxes, bool ground) {
    std::vector<Bounded> bounded(boxes.begin(), boxes.end());
    std::vector<std::pair<double, std::size_t>> by_height;
    double tallest = 0.0;
    for (std::size_t b = 0; b < bounded.size(); ++b) {
        by_height.emplace_back(bounded[b].body.center.z(), b);
        tallest = std::max(tallest, bounded[b].reach.above.z());
    }
    std::sort(by_height.begin(), by_height.end());
    std::vector<std::vector<Carrier>> carriers(boxes.size());
    for (std::size_t b = 0; b < bounded.size(); ++b) {
        const Bounded& box = bounded[b];
        // centres of what can carry it
        const double lowest = box.bottom() - box.drop() - tallest;
        for (auto at = std::lower_bound(by_height.begin(), by_height.end(), std::pair(lowest, std::size_t{0}));
             at != by_height.end() && at->first < box.body.center.z(); ++at) {
            if (const auto joint = find_joint(box, bounded[at->second], at->second)) carriers[b].push_back(*joint);
        }
        if (ground && box.bottom() < box.drop()) {
            const Vector3 meeting(box.body.center.x(), box.body.center.y(), box.bottom());
            carriers[b].push_back({.block = {}, .gap = std::max(0.0, box.bottom()), .meeting = meeting});
        }
    }
    return carriers;
}

}  // namespace musim::lsdem
