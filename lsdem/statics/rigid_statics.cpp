#include "lsdem/statics/rigid_statics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "lsdem/block_height.hpp"
#include "lsdem/statics/linear_program.hpp"
#include "lsdem/statics/rigid_joints.hpp"

namespace musim::lsdem {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// Residual that may be left on a block, see RigidStatics::residual: ten times what the solver takes for zero.
constexpr double kBalanced = 1e-6;

/// Joints that lean by less are level to friction: its first direction is then along x [-].
constexpr double kLevel = 0x1p-6;

/// Parts of a load below this are rounding, by which the solver would scale rows [-].
constexpr double kRounding = 1e-12;

/// Weight of the heaviest loose block over that of the lightest [-]: from 1e8 on the solver's zero is no longer little to both.
constexpr double kMostUneven = 1e6;

constexpr int kMostIterations = 200000;

/// Polygons inside Coulomb's circle, and around it.
enum class Friction { inside, around };

/// The force that a joint may bear in one direction at one corner, on its block and on the other.
struct Ray {
    std::size_t joint = 0;
    Vector3 force;  ///< for a unit of the unknown [N]
    Vector3 at;     ///< [m]
};

/// Directions of forces at the edge of the friction cone of a joint, with a normal part of one.
std::vector<Vector3> find_directions(const RigidJoint& joint, const Vector3& down, Friction friction) {
    if (joint.friction == 0.0) return {joint.normal};
    const Vector3& n = joint.normal;
    Vector3 first = down - down.dot(n) * n;
    if (first.norm() < kLevel) first = (Vector3::UnitX() - n.x() * n).norm() > 0.5 ? Vector3::UnitX() : Vector3::UnitY();
    first = (first - first.dot(n) * n).normalized();
    const Vector3 second = n.cross(first);
    constexpr double kStep = 2.0 * std::numbers::pi / static_cast<double>(kFrictionDirections);
    const double reach = friction == Friction::inside ? joint.friction : joint.friction / std::cos(0.5 * kStep);
    std::vector<Vector3> directions;
    for (std::size_t k = 0; k < kFrictionDirections; ++k) {
        const double angle = kStep * static_cast<double>(k);
        directions.emplace_back(n + reach * (std::cos(angle) * first + std::sin(angle) * second));
    }
    return directions;
}

/// The blocks that are to be in equilibrium, six rows each: forces over the block's weight, moments over that and half its diagonal.
class Balance {
  public:
    Balance(const Model& model, const std::vector<RigidJoint>& joints, std::vector<std::size_t> blocks, Friction friction)
        : model_(model), gravity_(model.gravity.norm()), blocks_(std::move(blocks)), row_(model.blocks.size(), kHeld) {
        for (std::size_t k = 0; k < blocks_.size(); ++k) row_[blocks_[k]] = 6 * k;
        for (std::size_t j = 0; j < joints.size(); ++j) {
            const RigidJoint& joint = joints[j];
            // of the lighter one, so that what the solver takes for zero is little to it
            double unit = std::numeric_limits<double>::infinity();
            if (is_asked(joint.block)) unit = weight(joint.block);
            if (joint.other && is_asked(*joint.other)) unit = std::min(unit, weight(*joint.other));
            if (std::isinf(unit)) continue;
            for (const Vector3& direction : find_directions(joint, down(), friction)) {
                for (const Vector3& corner : joint.corners) rays_.push_back({j, unit * direction, corner});
            }
        }
        joints_ = &joints;
    }

    std::size_t rows() const { return 6 * blocks_.size(); }
    Vector3 down() const { return model_.gravity / gravity_; }

    void put_rays(LinearProgram& program) const {
        for (const Ray& ray : rays_) {
            const RigidJoint& joint = (*joints_)[ray.joint];
            put(ray, joint.block, 1.0, program);
            if (joint.other) put(ray, *joint.other, -1.0, program);
            program.end_column(0.0);
        }
    }
    void put_weight(LinearProgram& program) const {
        for (std::size_t k = 0; k < blocks_.size(); ++k) {
            for (Eigen::Index i = 0; i < 3; ++i) program.right[6 * k + static_cast<std::size_t>(i)] = -down()[i];
        }
    }
    /// Help in all directions, at a price of its part of the mean weight.
    void put_help(LinearProgram& program) const {
        double mean = 0.0;
        for (const std::size_t block : blocks_) mean += weight(block) / static_cast<double>(blocks_.size());
        for (std::size_t k = 0; k < blocks_.size(); ++k) {
            for (std::size_t i = 0; i < (model_.blocks[blocks_[k]].rotation_locked ? 3U : 6U); ++i) {
                for (const double sign : {1.0, -1.0}) {
                    program.put(6 * k + i, sign);
                    program.end_column(weight(blocks_[k]) / mean);
                }
            }
        }
    }
    /// A steady acceleration of gravity times the unknown, as the blocks feel it.
    void put_acceleration(const Vector3& towards, double most, LinearProgram& program) const {
        for (std::size_t k = 0; k < blocks_.size(); ++k) {
            for (Eigen::Index i = 0; i < 3; ++i) {
                if (towards[i] != 0.0) program.put(6 * k + static_cast<std::size_t>(i), -towards[i]);
            }
        }
        program.end_column(-1.0, most);
    }

    /// Rest that the forces in the joints leave of every block's weight, and of `acceleration` over gravity.
    std::vector<Vector6> find_left(const std::vector<double>& x, const Vector3& acceleration) const {
        Vector6 alone = Vector6::Zero();
        alone.head<3>() = down() - acceleration;
        std::vector<Vector6> left(blocks_.size(), alone);
        for (std::size_t r = 0; r < rays_.size(); ++r) {
            // the solver leaves what is below its zero
            const double amount = std::max(x[r], 0.0);
            const RigidJoint& joint = (*joints_)[rays_[r].joint];
            if (is_asked(joint.block)) left[row_[joint.block] / 6] += amount * on(rays_[r], joint.block);
            if (joint.other && is_asked(*joint.other)) left[row_[*joint.other] / 6] -= amount * on(rays_[r], *joint.other);
        }
        return left;
    }

    double half_diagonal(std::size_t k) const { return half_extents(model_, model_.blocks[blocks_[k]]).norm(); }
    const std::vector<std::size_t>& blocks() const { return blocks_; }

  private:
    static constexpr std::size_t kHeld = static_cast<std::size_t>(-1);

    bool is_asked(std::size_t block) const { return row_[block] != kHeld; }
    double weight(std::size_t block) const { return model_.blocks[block].mass * gravity_; }
    Vector6 on(const Ray& ray, std::size_t b) const {
        const Block& block = model_.blocks[b];
        const Vector3 force = ray.force / weight(b);
        const Vector3 moment = (ray.at - block.position).cross(force) / half_extents(model_, block).norm();
        Vector6 both;
        both << force, block.rotation_locked ? Vector3(Vector3::Zero()) : moment;
        return both;
    }
    void put(const Ray& ray, std::size_t block, double sign, LinearProgram& program) const {
        if (!is_asked(block)) return;
        const Vector6 load = on(ray, block);
        for (Eigen::Index i = 0; i < 6; ++i) {
            if (std::abs(load[i]) > kRounding * load.norm()) program.put(row_[block] + static_cast<std::size_t>(i), sign * load[i]);
        }
    }

    const Model& model_;
    double gravity_;
    std::vector<std::size_t> blocks_, row_;
    std::vector<Ray> rays_;
    const std::vector<RigidJoint>* joints_ = nullptr;
};

double find_largest(const std::vector<Vector6>& left) {
    double largest = 0.0;
    for (const Vector6& of_block : left) largest = std::max({largest, of_block.head<3>().norm(), of_block.tail<3>().norm()});
    return largest;
}

/// Help that blocks need beyond the forces in their joints, where the least is added to these; nothing where the solver gave up.
std::optional<std::vector<Vector6>> find_least_help(const Balance& balance) {
    LinearProgram program(balance.rows());
    balance.put_weight(program);
    balance.put_rays(program);
    balance.put_help(program);
    const std::optional<std::vector<double>> x = find_least_cost(program, kMostIterations);
    if (!x) return std::nullopt;
    return balance.find_left(*x, Vector3::Zero());
}

/// Those blocks that need help, the one that needs the most first.
std::vector<BlockHelp> list_needs(const Balance& balance, const std::vector<Vector6>& left) {
    std::vector<BlockHelp> needs;
    for (std::size_t k = 0; k < left.size(); ++k) {
        const double force = left[k].head<3>().norm(), moment = left[k].tail<3>().norm();
        if (std::max(force, moment) > kBalanced) needs.push_back({balance.blocks()[k], force, moment * balance.half_diagonal(k)});
    }
    return needs;
}

std::string find_objection(const Model& model, const std::vector<std::size_t>& loose) {
    if (!has_linear_programs()) return "musim was built without CLP";
    if (!is_of_flat_sides(model)) return "there are round blocks";
    if (model.gravity.isZero(0.0)) return "there is no gravity";
    if (loose.empty()) return "all blocks are held in place";
    const auto [lightest, heaviest] = std::minmax_element(
        loose.begin(), loose.end(), [&](std::size_t l, std::size_t r) { return model.blocks[l].mass < model.blocks[r].mass; });
    const double uneven = model.blocks[*heaviest].mass / model.blocks[*lightest].mass;
    return uneven > kMostUneven ? fmt::format("its heaviest block weighs {:.2g} times its lightest, more than {:g}", uneven, kMostUneven)
                                : "";
}

std::string find_objection(const std::vector<RigidJoint>& joints, std::size_t most) {
    std::size_t rays = 0;
    for (const RigidJoint& joint : joints) rays += joint.corners.size() * kFrictionDirections;
    return rays > most ? fmt::format("its joints have {} unknowns, more than {}", rays, most) : "";
}

std::vector<std::size_t> find_loose(const Model& model) {
    std::vector<std::size_t> loose;
    for (std::size_t b = 0; b < model.blocks.size(); ++b) {
        if (!model.blocks[b].fixed) loose.push_back(b);
    }
    return loose;
}

/// Those that cannot stand though all others are held.
std::vector<BlockHelp> find_needs_alone(const Model& model, const std::vector<RigidJoint>& joints, const std::vector<std::size_t>& loose) {
    std::vector<std::vector<RigidJoint>> own(model.blocks.size());
    for (const RigidJoint& joint : joints) {
        own[joint.block].push_back(joint);
        if (joint.other) own[*joint.other].push_back(joint);
    }
    std::vector<BlockHelp> needs;
    for (const std::size_t block : loose) {
        const Balance around(model, own[block], {block}, Friction::around), balance(model, own[block], {block}, Friction::inside);
        const std::optional<std::vector<Vector6>> least = find_least_help(around);
        if (!least || find_largest(*least) <= kBalanced) continue;
        // not with all friction that there may be; by how much, with what is sure
        const std::optional<std::vector<Vector6>> left = find_least_help(balance);
        if (!left) continue;
        for (BlockHelp help : list_needs(balance, *left)) {
            help.touches = !own[block].empty();
            needs.push_back(help);
        }
    }
    return needs;
}

void sort_needs(const Model& model, std::vector<BlockHelp>& needs) {
    const auto amount = [&](const BlockHelp& help) {
        return std::max(help.force, help.arm / half_extents(model, model.blocks[help.block]).norm());
    };
    std::stable_sort(needs.begin(), needs.end(), [&](const BlockHelp& l, const BlockHelp& r) { return amount(l) > amount(r); });
}

}  // namespace

RigidStatics ask_rigid_statics(const Model& model) {
    using Answer = RigidStatics::Answer;
    RigidStatics statics;
    const std::vector<std::size_t> loose = find_loose(model);
    statics.why = find_objection(model, loose);
    if (!statics.why.empty()) return statics;
    const auto [joints, leaves_out_edges] = find_rigid_joints(model, kRigidGap);
    statics.joints = joints.size();
    statics.why = find_objection(joints, kMostRays);
    if (!statics.why.empty()) return statics;
    for (const Friction friction : {Friction::inside, Friction::around}) {
        const Balance balance(model, joints, loose, friction);
        const std::optional<std::vector<Vector6>> left = find_least_help(balance);
        if (!left) {
            statics.why = "its linear program was not solved";
            return statics;
        }
        statics.residual = find_largest(*left);
        if (statics.residual <= kBalanced) {
            statics.answer = friction == Friction::inside ? Answer::can_stand : Answer::undecided;
            statics.needs.clear();
            return statics;
        }
        if (friction == Friction::inside) statics.needs = list_needs(balance, *left);
    }
    if (leaves_out_edges) {
        statics.answer = Answer::undecided;
        statics.why = "blocks meet edge along edge, where forces have no plane";
        statics.needs.clear();
        return statics;
    }
    statics.answer = Answer::cannot_stand;
    std::vector<BlockHelp> alone = find_needs_alone(model, joints, loose);
    statics.each_alone = !alone.empty();
    if (statics.each_alone) statics.needs = std::move(alone);
    sort_needs(model, statics.needs);
    return statics;
}

std::optional<double> find_steady_acceleration(const Model& model, const Vector3& towards) {
    const std::vector<std::size_t> loose = find_loose(model);
    if (!find_objection(model, loose).empty()) return std::nullopt;
    const std::vector<RigidJoint> joints = find_rigid_joints(model, kRigidGap).joints;
    if (!find_objection(joints, kMostSteadyRays).empty()) return std::nullopt;
    const Balance balance(model, joints, loose, Friction::inside);
    LinearProgram program(balance.rows());
    balance.put_weight(program);
    balance.put_rays(program);
    balance.put_acceleration(towards, kMostAcceleration, program);
    const std::optional<std::vector<double>> x = find_least_cost(program, kMostIterations);
    if (!x || !(x->back() < kMostAcceleration)) return std::nullopt;
    if (find_largest(balance.find_left(*x, x->back() * towards)) > kBalanced) return std::nullopt;
    return x->back();
}

}  // namespace musim::lsdem
