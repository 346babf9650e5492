#include "lsdem/results/damage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "lsdem/fallen.hpp"
#include "lsdem/results/base_frame.hpp"
#include "scaling/angle.hpp"

namespace musim::lsdem {
namespace {

/// Largest distance of the lower face of a block from what carries it at the start [heights of the block]: blocks of a specimen lean and
/// differ in height by some hundredths.
constexpr double kJointGap = 0.1;

/// A block at the start: its centre of mass and how far it reaches from there along the world's axes.
struct Standing {
    Vector3 center;
    BlockReach reach;

    Vector3 extent() const { return reach.extent(); }
    double low(int axis) const { return center[axis] - reach.below[axis]; }
    double high(int axis) const { return center[axis] + reach.above[axis]; }
    double top() const { return high(2); }
    double bottom() const { return low(2); }
};

std::vector<Standing> find_standing(const RunData& run) {
    std::vector<Standing> standing;
    for (std::size_t b = 0; b < run.blocks.size.size(); ++b) {
        standing.push_back({run.initial.position[b], run.blocks.find_reach(b, run.initial.orientation[b])});
    }
    return standing;
}

/// Where a point that belongs to a block at the start lies at the end, `base` turned back.
Vector3 carry(const RunData& run, const BaseState& base, std::size_t block, const Vector3& point) {
    const Vector3 body = run.initial.orientation[block].conjugate() * (point - run.initial.position[block]);
    return turn_back(base, run.final.position[block]) + turn_back(base, run.final.orientation[block]) * body;
}

/// The middle of the part of two faces that lies on both; nothing when they do not meet.
bool find_meeting(const Standing& upper, const Standing& lower, Vector3& middle) {
    for (int axis = 0; axis < 2; ++axis) {
        const double low = std::max(upper.low(axis), lower.low(axis)), high = std::min(upper.high(axis), lower.high(axis));
        // an edge that only touches carries nothing
        if (high - low < kJointGap * std::min(upper.extent()[axis], lower.extent()[axis])) return false;
        middle[axis] = 0.5 * (low + high);
    }
    middle.z() = 0.5 * (upper.bottom() + lower.top());
    return true;
}

std::vector<Joint> find_joints(const RunData& run, const std::vector<Standing>& standing, const BaseState& base) {
    const double ground = run.origin ? run.origin->base.z() : 0.0;
    // tops in order, so that only those at the right height are looked at
    std::vector<std::pair<double, std::size_t>> tops;
    for (std::size_t b = 0; b < standing.size(); ++b) tops.emplace_back(standing[b].top(), b);
    std::sort(tops.begin(), tops.end());

    std::vector<Joint> joints;
    for (std::size_t upper = 0; upper < standing.size(); ++upper) {
        const Standing& block = standing[upper];
        const double gap = kJointGap * block.extent().z();
        auto at = std::lower_bound(tops.begin(), tops.end(), std::pair(block.bottom() - gap, std::size_t{0}));
        const std::size_t before = joints.size();
        for (; at != tops.end() && at->first <= block.bottom() + gap; ++at) {
            Vector3 middle;
            if (at->second == upper || !find_meeting(block, standing[at->second], middle)) continue;
            const Vector3 apart = carry(run, base, upper, middle) - carry(run, base, at->second, middle);
            joints.push_back({upper, at->second, false, apart.head<2>().norm()});
        }
        if (joints.size() == before && std::abs(block.bottom() - ground) <= gap) {
            const Vector3 middle(block.center.x(), block.center.y(), block.bottom());
            joints.push_back({upper, 0, true, (carry(run, base, upper, middle) - middle - base.displacement).head<2>().norm()});
        }
    }
    return joints;
}

/// Adds up values of one level.
class SpreadSum {
  public:
    void add(double value) {
        sum_ += value;
        max_ = std::max(max_, value);
        ++count_;
    }
    Spread spread() const { return {count_ > 0 ? sum_ / static_cast<double>(count_) : 0.0, max_}; }

  private:
    double sum_ = 0.0, max_ = 0.0;
    std::size_t count_ = 0;
};

struct LevelSums {
    SpreadSum slip, displacement, initial_tilt, final_tilt, rotation, turn;
    std::size_t blocks = 0, fallen = 0;
    double squares = 0.0;  ///< Σ D²
};

LevelDamage make_level(int level, const LevelSums& sums) {
    return {.level = level,
            .blocks = sums.blocks,
            .fallen = sums.fallen,
            .slip = sums.slip.spread(),
            .displacement = sums.displacement.spread(),
            .initial_tilt = sums.initial_tilt.spread(),
            .final_tilt = sums.final_tilt.spread(),
            .rotation = sums.rotation.spread(),
            .turn = sums.turn.spread(),
            .index = std::sqrt(sums.squares / static_cast<double>(sums.blocks)),
            .loss = {}};
}

/// Books what was dissipated under the levels above the leading blocks.
void add_losses(const RunData& run, Damage& damage) {
    if (!run.losses || damage.levels.empty()) return;
    std::vector<LevelDamage>& levels = damage.levels;
    for (LevelDamage& level : levels) level.loss = PairWork{};
    const auto find_level = [&](int layer) {
        return std::lower_bound(levels.begin(), levels.end(), layer, [](const LevelDamage& l, int wanted) { return l.level < wanted; });
    };
    for (std::size_t b = 0; b < run.losses->block.size(); ++b) {
        auto level = find_level(run.blocks.layer[b]);
        if (level->level > 0 && std::next(level) != levels.end()) ++level;
        *level->loss += run.losses->block[b];
    }
    // the lowest level that is one, or else the blocks in no layer
    auto lowest = find_level(1);
    if (lowest == levels.end()) lowest = levels.begin();
    *lowest->loss += run.losses->ground;
    damage.loss = run.losses->total();
}

}  // namespace

double find_loss_share(const LevelDamage& level, const Damage& damage) {
    return damage.loss->total() > 0.0 ? level.loss->total() / damage.loss->total() : 0.0;
}

double find_tilt(const Quaternion& orientation) {
    const Vector3 up = orientation * Vector3::UnitZ();
    return std::atan2(up.head<2>().norm(), up.z());
}

Damage assess_damage(const RunData& run) {
    const std::vector<Standing> standing = find_standing(run);
    const BaseState& base = run.history.base.back();
    Damage damage;
    damage.joints = find_joints(run, standing, base);
    damage.blocks = standing.size();
    std::vector<SpreadSum> slip(standing.size());
    for (const Joint& joint : damage.joints) slip[joint.upper].add(joint.slip);

    std::map<int, LevelSums> levels;
    double squares = 0.0;
    for (std::size_t b = 0; b < standing.size(); ++b) {
        const Vector3 moved = find_moved(base, run.initial.position[b], run.final.position[b]);
        const Quaternion at_end = turn_back(base, run.final.orientation[b]);
        const Eigen::AngleAxisd rotation(at_end * run.initial.orientation[b].conjugate());
        const bool fallen = run.fell_before(b) || (!run.falls.is_airborne(b) &&
                                                   has_fallen(standing[b].extent().z(), run.initial.orientation[b].toRotationMatrix(),
                                                              at_end.toRotationMatrix(), -moved.z()));
        const Vector3 extent = standing[b].extent();
        const double side = std::min(extent.x(), extent.y());
        const double corner = 0.5 * std::hypot(extent.x(), extent.y()) * rotation.angle();
        const double index = fallen ? 1.0 : std::min(1.0, (slip[b].spread().mean + corner) / side);

        damage.each.push_back({fallen, rotation.angle()});
        LevelSums& sums = levels[run.blocks.layer[b]];
        ++sums.blocks;
        sums.fallen += fallen ? 1 : 0;
        sums.squares += index * index;
        sums.displacement.add(moved.head<2>().norm());
        sums.initial_tilt.add(find_tilt(run.initial.orientation[b]));
        sums.final_tilt.add(find_tilt(at_end));
        sums.rotation.add(rotation.angle());
        sums.turn.add(std::abs(rotation.angle() * rotation.axis().z()));
        squares += index * index;
        damage.fallen += fallen ? 1 : 0;
    }
    for (const Joint& joint : damage.joints) levels[run.blocks.layer[joint.upper]].slip.add(joint.slip);
    for (const auto& [level, sums] : levels) damage.levels.push_back(make_level(level, sums));
    add_losses(run, damage);
    if (damage.blocks > 0) damage.index = std::sqrt(squares / static_cast<double>(damage.blocks));
    return damage;
}

std::string make_damage_csv(const Damage& damage) {
    std::string csv =
        "level,blocks,fallen,slip_mean_m,slip_max_m,displacement_mean_m,displacement_max_m,initial_tilt_mean_deg,initial_tilt_max_deg,"
        "final_tilt_mean_deg,final_tilt_max_deg,rotation_mean_deg,rotation_max_deg,turn_mean_deg,turn_max_deg,damage_index,"
        "friction_loss_j,damping_loss_j,loss_share\n";
    using scaling::kDegree;
    for (const LevelDamage& l : damage.levels) {
        fmt::format_to(std::back_inserter(csv), "{},{},{}", l.level, l.blocks, l.fallen);
        for (const Spread& s : {l.slip, l.displacement}) fmt::format_to(std::back_inserter(csv), ",{},{}", s.mean, s.max);
        for (const Spread& s : {l.initial_tilt, l.final_tilt, l.rotation, l.turn}) {
            fmt::format_to(std::back_inserter(csv), ",{},{}", s.mean / kDegree, s.max / kDegree);
        }
        fmt::format_to(std::back_inserter(csv), ",{}", l.index);
        if (l.loss) {
            fmt::format_to(std::back_inserter(csv), ",{},{},{}\n", l.loss->friction, l.loss->damping, find_loss_share(l, damage));
        } else {
            csv += ",,,\n";
        }
    }
    return csv;
}

}  // namespace musim::lsdem
