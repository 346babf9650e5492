#include "lsdem/run/equilibrium.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include "lsdem/block_height.hpp"
#include "lsdem/contact/area_stiffness.hpp"
#include "lsdem/solid/solid.hpp"

namespace musim::lsdem {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Sparse = Eigen::SparseMatrix<double>;

/// A block that would have to move by more than this part of its height does not stand where it is drawn [-].
constexpr double kMostShift = 0.05;

/// Newton's method gives up where so many solves do not halve what is left: where friction slides a solve takes a seventh off.
constexpr std::size_t kMostSolves = 30;

/// Newton's method ends where it gains no more: rounding of the positions is left.
constexpr double kLeastGain = 0.5;

/// Gaps from which the first stiffness of solids is taken where the least one finds nothing: those of what stands on corners or edges [-].
constexpr std::array<double, 3> kWiderGaps{0x1p-15, 0x1p-11, 0x1p-8};

/// Moves the points of a block at `arm` from its centre: a shift and a turn.
Eigen::Matrix<double, 3, 6> motion_of_points(const Vector3& arm) {
    Eigen::Matrix<double, 3, 6> moves;
    moves << Matrix3::Identity(), -cross_matrix(arm);
    return moves;
}

/// Where a block's six unknowns begin; nothing for one that is held.
struct Unknowns {
    std::vector<std::optional<Eigen::Index>> of_block;
    Eigen::Index count = 0;

    explicit Unknowns(const Model& model) {
        for (const Block& block : model.blocks) {
            of_block.push_back(block.fixed ? std::nullopt : std::optional(count));
            if (!block.fixed) count += 6;
        }
    }
};

/// Imbalance that the contacts leave of the weight of all blocks: 6 numbers for each that moves.
struct Imbalance {
    Eigen::VectorXd load;
    double largest = 0.0;  ///< see Equilibrium::residual

    Imbalance(const Simulation& simulation, const Unknowns& unknowns) : load(unknowns.count) {
        const Model& model = simulation.model();
        const double gravity = model.gravity.norm();
        for (std::size_t b = 0; b < model.blocks.size(); ++b) {
            if (!unknowns.of_block[b]) continue;
            const Block& block = model.blocks[b];
            const Vector3 force = simulation.contact_force(b) + block.mass * model.gravity;
            const Vector3 torque = block.rotation_locked ? Vector3::Zero() : simulation.contact_torque(b);
            load.segment<6>(*unknowns.of_block[b]) << force, torque;
            const double weight = block.mass * gravity;
            largest = std::max({largest, force.norm() / weight, torque.norm() / (weight * half_extents(model, block).z())});
        }
    }
};

/// The stiffness of all contacts, its lower half.
class Stiffness {
  public:
    Stiffness(const Model& model, const Unknowns& unknowns) : model_(model), unknowns_(unknowns) {}

    void add(const JointStiffness& joint) {
        const Matrix3 spring = stiffness_per_area(joint.normal, joint.along, joint.across);
        const Matrix3 turning = turning_stiffness(joint.normal, joint.second, joint.along, joint.across);
        const std::array<std::size_t, 2> block{joint.leader, joint.follower.value_or(joint.leader)};
        const std::size_t sides = joint.follower ? 2 : 1;
        for (std::size_t i = 0; i < sides; ++i) {
            for (std::size_t j = 0; j < sides; ++j) {
                const auto row = unknowns_.of_block[block[i]], column = unknowns_.of_block[block[j]];
                if (!row || !column || *row < *column) continue;
                Matrix6 part = joint.area * moves(joint, block[i]).transpose() * spring * moves(joint, block[j]);
                part.bottomRightCorner<3, 3>() += turning;
                put(i == j ? part : Matrix6(-part), *row, *column);
            }
        }
    }

    /// Solves for the motion that a load makes; nothing where some block could move without a spring that opposes it.
    std::optional<Eigen::VectorXd> solve(const Eigen::VectorXd& load) {
        hold_locked_turns();
        Sparse matrix(unknowns_.count, unknowns_.count);
        matrix.setFromTriplets(entries_.begin(), entries_.end());
        const Eigen::SimplicialLDLT<Sparse> factors(matrix);
        if (factors.info() != Eigen::Success || !(factors.vectorD().minCoeff() > 0.0)) return std::nullopt;
        return factors.solve(load);
    }

  private:
    Eigen::Matrix<double, 3, 6> moves(const JointStiffness& joint, std::size_t block) const {
        return motion_of_points(joint.middle - model_.blocks[block].position);
    }
    void put(const Matrix6& part, Eigen::Index row, Eigen::Index column) {
        for (Eigen::Index i = 0; i < 6; ++i) {
            for (Eigen::Index j = 0; j < 6; ++j) {
                if (row + i >= column + j) entries_.emplace_back(row + i, column + j, part(i, j));
            }
        }
    }
    /// Without a load nothing turns, whatever opposes it: rows and columns of blocks that do not turn keep their diagonal only.
    void hold_locked_turns() {
        std::vector<bool> locked(static_cast<std::size_t>(unknowns_.count), false);
        for (std::size_t b = 0; b < model_.blocks.size(); ++b) {
            if (!unknowns_.of_block[b] || !model_.blocks[b].rotation_locked) continue;
            for (Eigen::Index i = 3; i < 6; ++i) locked[static_cast<std::size_t>(*unknowns_.of_block[b] + i)] = true;
        }
        std::erase_if(entries_, [&](const Eigen::Triplet<double>& entry) {
            return entry.row() != entry.col() &&
                   (locked[static_cast<std::size_t>(entry.row())] || locked[static_cast<std::size_t>(entry.col())]);
        });
    }

    const Model& model_;
    const Unknowns& unknowns_;
    std::vector<Eigen::Triplet<double>> entries_;
};

/// The contacts between faces that meet as drawn, no farther apart than `gap` times a height: upper and lower ones of boxes, all of solids.
std::vector<JointStiffness> find_first_joints(const Model& drawn, double gap, double time_step, int threads) {
    Model larger = drawn;
    for (Shape& shape : larger.shapes) {
        if (!shape.solid) continue;
        shape.solid = std::make_shared<const Solid>(stretched(*shape.solid, Vector3::Constant(1.0 + gap)));
        shape.half_extents *= 1.0 + gap;
    }
    for (Block& block : larger.blocks) {
        const bool is_box = meets_by_overlap(drawn, block) && drawn.shapes[block.shape].solid == nullptr;
        if (is_box) block.height_offset += gap * 2.0 * half_extents(drawn, block).z();
    }
    return Simulation(std::move(larger), time_step, threads).joint_stiffness();
}

Vector6 motion_of(const Unknowns& unknowns, const Eigen::VectorXd& moved, std::size_t block) {
    if (!unknowns.of_block[block]) return Vector6::Zero();
    return moved.segment<6>(*unknowns.of_block[block]);
}

/// Friction that the springs of the contacts gain as the blocks move, on top of what they hold.
void load_friction(const std::vector<JointStiffness>& joints, const Unknowns& unknowns, const Eigen::VectorXd& moved, Model& model) {
    using Pair = std::pair<std::size_t, std::optional<std::size_t>>;
    std::map<Pair, Preload> held;
    for (const Preload& preload : model.preload) held[{preload.leader, preload.follower}] = preload;
    std::vector<Preload> loaded;
    for (const JointStiffness& joint : joints) {
        Preload preload{.leader = joint.leader, .follower = joint.follower};
        if (const auto found = held.find({joint.leader, joint.follower}); found != held.end()) preload = found->second;
        Vector3 slip = Vector3::Zero();
        double turn = 0.0;
        const auto add = [&](std::size_t block, double sign) {
            const Vector6 motion = motion_of(unknowns, moved, block);
            slip += sign * (motion_of_points(joint.middle - model.blocks[block].position) * motion);
            turn += sign * joint.normal.dot(motion.tail<3>());
        };
        add(joint.leader, -1.0);
        if (joint.follower) add(*joint.follower, 1.0);
        slip -= joint.normal.dot(slip) * joint.normal;
        const double polar = joint.second.trace() - joint.normal.dot(joint.second * joint.normal);
        preload.friction += joint.across * joint.area * slip;
        preload.couple -= joint.across * polar * turn;
        loaded.push_back(preload);
    }
    model.preload = std::move(loaded);
}

/// Moves the blocks; false where one would have to move too far.
bool move_blocks(const Unknowns& unknowns, const Eigen::VectorXd& moved, Model& model) {
    for (std::size_t b = 0; b < model.blocks.size(); ++b) {
        const Vector6 motion = motion_of(unknowns, moved, b);
        Block& block = model.blocks[b];
        const double height = 2.0 * half_extents(model, block).z();
        if (!(motion.head<3>().norm() < kMostShift * height && motion.tail<3>().norm() < kMostShift)) return false;
        block.position += motion.head<3>();
        const Vector3 half = 0.5 * motion.tail<3>();
        block.orientation = (Quaternion(1.0, half.x(), half.y(), half.z()) * block.orientation).normalized();
    }
    return true;
}

/// Pairs of which one carries the other: of blocks, or of a block and the ground, whose joints are more level than upright.
using BearingPairs = std::set<std::pair<std::size_t, std::optional<std::size_t>>>;

BearingPairs find_bearing_pairs(const std::vector<JointStiffness>& joints, const Vector3& gravity) {
    constexpr double kUpright = 0.6;  // of the cosine between the normal and gravity; no angle at which blocks are drawn
    BearingPairs pairs;
    for (const JointStiffness& joint : joints) {
        if (std::abs(joint.normal.dot(gravity)) > kUpright * gravity.norm()) {
            const std::size_t other = joint.follower.value_or(joint.leader);
            pairs.emplace(std::min(joint.leader, other), joint.follower ? std::optional(std::max(joint.leader, other)) : std::nullopt);
        }
    }
    return pairs;
}

/// Seeks equilibrium from where the blocks are drawn; `joints` give the first stiffness, `drawn` are the pairs that may bear.
Equilibrium seek_from(std::vector<JointStiffness> joints, const BearingPairs& drawn, double time_step, int threads, Specimen& specimen) {
    Equilibrium equilibrium;
    const Unknowns unknowns(specimen.model);
    Model model = specimen.model;
    Imbalance left(Simulation(model, time_step, threads), unknowns);
    const double residual_as_drawn = left.largest;
    equilibrium.residual = residual_as_drawn;
    double halved = left.largest;
    bool is_found = false;
    for (std::size_t waited = 0; waited < kMostSolves; ++waited) {
        Stiffness stiffness(model, unknowns);
        for (const JointStiffness& joint : joints) stiffness.add(joint);
        const std::optional<Eigen::VectorXd> moved = stiffness.solve(left.load);
        if (!moved) break;
        ++equilibrium.solves;
        load_friction(joints, unknowns, *moved, model);
        if (!move_blocks(unknowns, *moved, model)) break;
        const Simulation simulation(model, time_step, threads);
        left = Imbalance(simulation, unknowns);
        const bool ends = equilibrium.residual <= kInEquilibrium && !(left.largest < kLeastGain * equilibrium.residual);
        if (ends) break;
        equilibrium.residual = left.largest;
        if (left.largest <= 0.5 * halved) halved = left.largest, waited = 0;
        joints = simulation.joint_stiffness();
        model.preload = simulation.preloads();
        if (left.largest > kInEquilibrium) continue;
        // what a gap kept apart as drawn bears now: equilibrium is not where the blocks are drawn
        const BearingPairs now = find_bearing_pairs(joints, model.gravity);
        if (!is_found && !std::includes(drawn.begin(), drawn.end(), now.begin(), now.end())) {
            equilibrium.residual = residual_as_drawn;
            return equilibrium;
        }
        specimen.model = model;
        is_found = true;  // what follows moves blocks by rounding
    }
    return equilibrium;
}

}  // namespace

Equilibrium put_in_equilibrium(Specimen& specimen, double time_step, int threads) {
    const Model& model = specimen.model;
    const bool is_held = std::all_of(model.blocks.begin(), model.blocks.end(), [](const Block& block) { return block.fixed; });
    if (is_held || model.gravity.isZero(0.0)) return {};
    const std::vector<JointStiffness> meeting = find_first_joints(model, kEquilibriumGap, time_step, threads);
    const BearingPairs drawn = find_bearing_pairs(meeting, model.gravity);
    Equilibrium equilibrium = seek_from(meeting, drawn, time_step, threads, specimen);
    // the stiffness of corners and edges grows with their depth
    const bool has_solids =
        std::any_of(model.shapes.begin(), model.shapes.end(), [](const Shape& shape) { return shape.solid != nullptr; });
    for (const double gap : kWiderGaps) {
        if (!has_solids || equilibrium.residual <= kInEquilibrium) break;
        equilibrium = seek_from(find_first_joints(model, gap, time_step, threads), drawn, time_step, threads, specimen);
    }
    return equilibrium;
}

}  // namespace musim::lsdem
