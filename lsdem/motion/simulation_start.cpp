#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "lsdem/block_height.hpp"
#include "lsdem/motion/preloads.hpp"
#include "lsdem/motion/simulation_core.hpp"
#include "lsdem/rotation.hpp"

/// Start of a simulation: its model is checked, and the first forces are found.
namespace musim::lsdem {
namespace {

/// Energy that needs no explanation, as a fraction of weight times smallest block edge: lets the noise of a stack at rest pass.
constexpr double kEnergyFloor = 1e-3;

/// The same without weight: the spring energy, k_n (ε L)², of overlaps that are the rounding of a position L away, times this.
constexpr double kRoundingFloor = 64.0;

/// Blocks that make a second thread worth its two meetings a step. Affects speed only.
constexpr std::size_t kBlocksPerThread = 256;

void check_model(const Model& model, double time_step) {
    require(std::isfinite(time_step) && time_step > 0.0, "Simulation: the time step must be positive and finite");
    require(model.gravity.allFinite(), "Simulation: gravity is not finite");
    check_velocity_damping(model.velocity_damping, time_step);
    for (const Block& block : model.blocks) {
        require(block.shape < model.shapes.size(), "Simulation: a block names a shape that does not exist");
        require(block.material < model.materials.size(), "Simulation: a block names a material that does not exist");
        const Shape& shape = model.shapes[block.shape];
        require(block.height_offset == 0.0 || shape.faceted, "Simulation: only a box can be taller or shorter than its shape");
        require(std::isfinite(block.height_offset) && block.height_offset > -2.0 * shape.half_extents.z(),
                "Simulation: a block's height offset must be finite and leave it some height");
        require(std::isfinite(block.mass) && block.mass > 0.0, "Simulation: a block's mass must be positive and finite");
        require(block.position.allFinite() && block.velocity.allFinite() && block.angular_velocity.allFinite() &&
                    block.orientation.coeffs().allFinite(),
                "Simulation: a block's initial state is not finite");
        require(std::abs(block.orientation.norm() - 1.0) < 1e-9, "Simulation: a block's quaternion must have unit length");
    }
    for (const MaterialPair& pair : model.pairs) {
        require(pair.first < model.materials.size() && pair.second.value_or(0) < model.materials.size(),
                "Simulation: a pair names a material that does not exist");
    }
    require(model.scatter.friction >= 0.0 && kMostJointDeviates * model.scatter.friction < 1.0,
            "Simulation: the scatter of friction must not be negative, and small enough to leave every joint some");
    for (const Preload& preload : model.preload) {
        require(preload.leader < model.blocks.size() && preload.follower.value_or(0) < model.blocks.size(),
                "Simulation: a preload names a block that does not exist");
        require(preload.is_finite(), "Simulation: friction and couple of a preload must be finite");
    }
}

void check_loads(const Model& model) {
    for (const Load& load : model.loads) {
        require(load.block < model.blocks.size(), "Simulation: a load names a block that does not exist");
        require(load.point.allFinite() && std::isfinite(load.force) && std::isfinite(load.displacement) && std::isfinite(load.stiffness),
                "Simulation: a load is not finite");
        require(std::abs(load.direction.norm() - 1.0) < 1e-9, "Simulation: a load's direction must have unit length");
        require(load.start >= 0.0 && load.rise > 0.0 && std::isfinite(load.start + load.rise),
                "Simulation: a load must not begin before the run, and must take some time to grow");
        require(load.is_actuator() || load.force > 0.0, "Simulation: a load must have a force, or an actuator's stiffness");
    }
}

int choose_threads(int wanted, std::size_t blocks) {
    const int useful = static_cast<int>(std::min<std::size_t>(blocks / kBlocksPerThread + 1, 1024));
    return std::clamp(wanted, 1, useful);
}

/// Spring energy of overlaps that are the rounding of the largest coordinate [J].
double find_rounding_energy(const Model& model) {
    double extent = 0.0, stiffest = 0.0, largest_face = 0.0;
    for (const Block& block : model.blocks) {
        const Shape& shape = model.shapes[block.shape];
        extent = std::max(extent, block.position.norm() + half_extents(model, block).norm());
        stiffest = std::max(stiffest, model.materials[block.material].normal_stiffness * shape.face_area);
        largest_face = std::max(largest_face, shape.face_area);
    }
    for (const MaterialPair& pair : model.pairs) stiffest = std::max(stiffest, pair.joint.normal_stiffness * largest_face);
    const double rounding = std::numeric_limits<double>::epsilon() * extent;
    return kRoundingFloor * static_cast<double>(model.blocks.size()) * stiffest * rounding * rounding;
}

/// The blocks that are held to the base.
std::vector<std::size_t> find_carried(const Model& model) {
    std::vector<std::size_t> carried;
    for (std::size_t i = 0; i < model.blocks.size(); ++i) {
        if (model.blocks[i].fixed && model.blocks[i].with_base) carried.push_back(i);
    }
    return carried;
}

/// Model that has passed its checks; everything else may rely on it.
Model checked(Model model, double time_step) {
    check_model(model, time_step);
    check_loads(model);
    return model;
}

}  // namespace

void require(bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(what);
}

void check_velocity_damping(double rate, double time_step) {
    require(rate >= 0.0 && rate * time_step <= 1.0, "Simulation: the rate of the velocity damping must lie between 0 and 1/time step");
}

Simulation::Implementation::Implementation(Model given, double time_step, int threads)
    : model(checked(std::move(given), time_step)),
      dt(time_step),
      bodies(model),
      base(model.ground.motion, find_carried(model)),
      search(model),
      loads(model),
      preparation{.damping_rate = model.velocity_damping},
      work(choose_threads(threads, model.blocks.size())) {
    balance.finished.block.resize(model.blocks.size());
    for (int thread = 0; thread < work.team.size(); ++thread) work.batches.emplace_back(bodies, list);
    smallest_edge = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < bodies.size(); ++i) smallest_edge = std::min(smallest_edge, 2.0 * bodies.pose[i].half.minCoeff());
    for (const Block& block : model.blocks) balance.weight_times_edge += block.mass * model.gravity.norm() * smallest_edge;
    balance.floor = kEnergyFloor * balance.weight_times_edge + find_rounding_energy(model);
}

void Simulation::Implementation::start() {
    base.put_ground(0.0, bodies);
    bodies.start_position.back() = bodies.pose.back().position;
    bodies.start_orientation.back() = bodies.orientation.back();
    bodies.drawn_up = bodies.up();
    rebuild();
    note_leaving();
    // where everything was one step ago, as the initial velocities have it
    const double h = substep_length();
    base.put_ground(-h, bodies);
    base.move_ground(0.0, h, bodies);
    base.push_carried(bodies);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        bodies.pose[i].step.shift = h * bodies.velocity[i];
        if (bodies.fixed[i] != 0) continue;
        const Quaternion before = rotate_freely(bodies.orientation[i], bodies.momentum[i], bodies.inverse_inertia[i], -h);
        bodies.pose[i].step.turn = bodies.orientation[i] * before.conjugate();
    }
    preload_contacts(model.preload, bodies, list);
    update_contacts();
    loads.restart(bodies);
    update_loads(0.0);
    share_work();  // now that it is known what touches
    list.first_step = false;
    clear_losses(list);  // what the step before the start would have dissipated
    balance.start_energy = stored_and_kinetic();

    // momenta of step −1/2, so that every step is the same
    const detail::VelocityDecay half = decay_over(0.5 * h);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies.fixed[i] != 0) continue;
        const detail::TouchList::Load load = work.touches.sum(i, list.forces);
        bodies.velocity[i] -= half.push * (load.force * bodies.inverse_mass[i] + model.gravity);
        bodies.velocity[i] /= half.keep;
        if (bodies.inverse_inertia[i].isZero(0.0)) continue;
        bodies.momentum[i] -= half.push * load.torque;
        bodies.momentum[i] /= half.keep;
        // that half lies before the start
        bodies.preparation_loss[i] = -half_preparation_loss(i);
    }
    balance.start = find_exact_energy().balance();
}

}  // namespace musim::lsdem
