#include "lsdem/motion/settling_simulation.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "lsdem/motion/simulation_core.hpp"

namespace musim::lsdem {

void release_block(const Release& release, Model& model) {
    Block& block = model.blocks.at(release.block);
    block.fixed = false;
    block.position = release.position;
    block.orientation = release.orientation;
    block.velocity = release.velocity;
}

SettlingSimulation::SettlingSimulation(Simulation simulation, double damping_rate, Inertia inertia) : simulation_(std::move(simulation)) {
    set_damping_rate(damping_rate);
    Simulation::Implementation& s = *simulation_.implementation_;
    s.preparation.active = true;
    if (inertia == Inertia::as_stable) s.preparation.mass_scaling.begin(s.model, s.dt, s.list);
    s.steps.rest_end = s.steps.done;
}

SettlingSimulation::SettlingSimulation(Simulation restored) : simulation_(std::move(restored)) {
    if (!simulation_.implementation_->preparation.active) {
        throw std::runtime_error("saved state: it is of a run, not of a structure that comes to rest before one");
    }
}

void Simulation::Implementation::release(const Release& given) {
    release_block(given, model);
    const std::size_t i = given.block;
    const Block& block = model.blocks[i];
    bodies.pose[i].step.travel += (block.position - bodies.pose[i].position).norm() + search.reference().diameter[i];
    bodies.release(i, model);
    bodies.pose[i].step.shift = bodies.elapsed * block.velocity;
    bodies.pose[i].step.turn.setIdentity();
    const detail::VelocityDecay half = decay_over(0.5 * bodies.elapsed);
    bodies.velocity[i] = (bodies.velocity[i] - half.push * model.gravity) / half.keep;
    balance.start_energy += 0.5 * block.mass * block.velocity.squaredNorm();
}

void SettlingSimulation::release(const std::vector<Release>& blocks) {
    Simulation::Implementation& s = *simulation_.implementation_;
    std::vector<std::uint8_t> named(s.bodies.size(), 0);
    for (const Release& given : blocks) {
        require(given.block < s.bodies.size() && s.bodies.fixed[given.block] != 0, "Simulation: only a held block can be released");
        require(named[given.block]++ == 0, "Simulation: a block is released twice");
        require(given.position.allFinite() && given.velocity.allFinite() && std::abs(given.orientation.norm() - 1.0) < 1e-9,
                "Simulation: a released block's state is not finite, or its quaternion not of unit length");
    }
    const double before = s.find_exact_energy().balance();
    for (const Release& given : blocks) s.release(given);
    s.rebuild();
    s.balance.start += s.find_exact_energy().balance() - before;
    s.steps.rest_end = s.steps.done;
    s.steps.checks_at_rest = 0;
}

Simulation SettlingSimulation::finish() && {
    simulation_.implementation_->restart();
    return std::move(simulation_);
}

}  // namespace musim::lsdem
