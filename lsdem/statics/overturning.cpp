#include "lsdem/statics/overturning.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

#include "lsdem/block_height.hpp"
#include "lsdem/statics/rigid_joints.hpp"
#include "lsdem/statics/rigid_statics.hpp"

namespace musim::lsdem {
namespace {

/// A joint that leans by less is level [-].
constexpr double kLevelCosine = 1.0 - 1e-6;

/// Part that stands on one level: its mass, and where it is borne along the axis.
struct Body {
    double mass = 0.0;
    Vector3 moment = Vector3::Zero();  ///< mass times place [kg m]
    double low = std::numeric_limits<double>::infinity(), high = -low;
    bool is_level = true;

    void add(const Block& block) {
        mass += block.mass;
        moment += block.mass * block.position;
    }
    void bear(double at) {
        low = std::min(low, at);
        high = std::max(high, at);
    }
    /// See find_overturning; nothing of a body that nothing bears.
    std::optional<double> limit(int axis, double level) const {
        if (!is_level || !(low <= high)) return std::nullopt;
        const Vector3 centre = moment / mass;
        return std::max(0.0, std::min(high - centre[axis], centre[axis] - low) / (centre.z() - level));
    }
};

/// Bodies of blocks that are joined, above one level after another.
class Levels {
  public:
    Levels(const Model& model, int axis)
        : model_(model), axis_(axis), joints_(find_rigid_joints(model, kRigidGap).joints), root_(model.blocks.size()) {
        double least = std::numeric_limits<double>::infinity();
        for (const Block& block : model.blocks) least = std::min(least, 2.0 * half_extents(model, block).z());
        tolerance_ = kRigidGap * least;
    }

    std::optional<double> find_least() {
        std::optional<double> least;
        for (const double level : find_heights()) {
            for (const std::optional<double>& limit : find_limits(level)) {
                if (limit) least = std::min(*limit, least.value_or(*limit));
            }
        }
        return least;
    }

  private:
    static bool is_level(const RigidJoint& joint) { return std::abs(joint.normal.z()) > kLevelCosine; }
    bool is_above(std::size_t block, double level) const {
        return !model_.blocks[block].fixed && model_.blocks[block].position.z() > level;
    }
    std::size_t find_root(std::size_t block) {
        while (root_[block] != block) block = root_[block] = root_[root_[block]];
        return block;
    }

    std::vector<double> find_heights() const {
        std::vector<double> heights;
        for (const RigidJoint& joint : joints_) {
            if (is_level(joint)) heights.push_back(joint.corners.front().z());
        }
        std::sort(heights.begin(), heights.end());
        const auto same = [&](double l, double r) { return r - l <= tolerance_; };
        heights.erase(std::unique(heights.begin(), heights.end(), same), heights.end());
        return heights;
    }

    std::vector<std::optional<double>> find_limits(double level) {
        std::iota(root_.begin(), root_.end(), std::size_t{0});
        for (const RigidJoint& joint : joints_) {
            if (joint.other && is_above(joint.block, level) && is_above(*joint.other, level)) {
                root_[find_root(joint.block)] = find_root(*joint.other);
            }
        }
        std::vector<Body> bodies(model_.blocks.size());
        for (std::size_t b = 0; b < model_.blocks.size(); ++b) {
            if (is_above(b, level)) bodies[find_root(b)].add(model_.blocks[b]);
        }
        for (const RigidJoint& joint : joints_) {
            const bool above = is_above(joint.block, level), other_above = joint.other && is_above(*joint.other, level);
            if (above == other_above) continue;
            Body& body = bodies[find_root(above ? joint.block : *joint.other)];
            body.is_level = body.is_level && is_level(joint) && std::abs(joint.corners.front().z() - level) <= tolerance_;
            for (const Vector3& corner : joint.corners) body.bear(corner[axis_]);
        }
        std::vector<std::optional<double>> limits;
        for (const Body& body : bodies) limits.push_back(body.limit(axis_, level));
        return limits;
    }

    const Model& model_;
    int axis_;
    std::vector<RigidJoint> joints_;
    std::vector<std::size_t> root_;
    double tolerance_ = 0.0;
};

}  // namespace

std::optional<double> find_overturning(const Model& model, int axis) { return Levels(model, axis).find_least(); }

std::optional<double> find_overturning_of_layers(const Model& model, const std::vector<int>& layer, int axis) {
    Body body;
    for (std::size_t b = 0; b < model.blocks.size(); ++b) {
        const Block& block = model.blocks[b];
        body.add(block);
        if (layer[b] != 1) continue;
        const double reach = block.orientation.toRotationMatrix().row(axis).cwiseAbs().dot(half_extents(model, block));
        body.bear(block.position[axis] - reach);
        body.bear(block.position[axis] + reach);
    }
    return body.limit(axis, 0.0);
}

}  // namespace musim::lsdem
