#include "lsdem/run/settle.hpp"

#include <algorithm>
#include <cmath>

#include "lsdem/block_height.hpp"
#include "scaling/interruption.hpp"

namespace musim::lsdem {
namespace {

/// Steps between two checks at energy and reaction, which cost about a step each.
constexpr std::uint64_t kLookInterval = 64;

/// The largest v²/(2 g H) of a block, spin included: J ω²/m [-].
double find_liveliest(const Simulation& simulation) {
    const Model& model = simulation.model();
    double liveliest = 0.0;
    for (std::size_t i = 0; i < model.blocks.size(); ++i) {
        const Block& block = model.blocks[i];
        if (block.fixed) continue;
        const Vector3 spin = simulation.orientation(i).conjugate() * simulation.angular_velocity(i);
        const double twice = simulation.velocity(i).squaredNorm() + inertia_over_mass(model, block).dot(spin.cwiseAbs2());
        liveliest = std::max(liveliest, twice / (4.0 * half_extents(model, block).z()));
    }
    return liveliest / model.gravity.norm();
}

}  // namespace

CarriedWeight::CarriedWeight(const Model& model) : gravity_(model.gravity) {
    for (std::size_t b = 0; b < model.blocks.size(); ++b) {
        if (model.blocks[b].fixed) {
            if (!model.blocks[b].with_base) fixed_.push_back(b);  // the base bears what moves with it
        } else {
            mass_ += model.blocks[b].mass;
        }
    }
}

double CarriedWeight::find_borne(const Simulation& simulation) const {
    Vector3 reaction = simulation.base_reaction();
    // what presses on a fixed block is what it bears
    for (const std::size_t b : fixed_) reaction -= simulation.contact_force(b);
    return -reaction.dot(gravity_) / (gravity_.squaredNorm() * mass_);
}

double choose_damping_rate(const Vector3& size, double gravity) {
    const double thin = std::min(size.x(), size.y());
    return 0.5 * std::sqrt(0.75 * gravity / (0.5 * std::hypot(thin, size.z())));
}

Rest settle(SettlingSimulation& settling_simulation, const Settling& settling, const SettlingWatch& watch, SettlingState state) {
    const Simulation& simulation = settling_simulation.state();
    const CarriedWeight weight(simulation.model());
    Rest rest;
    if (!weight.exists()) return rest;
    double part = 0.0;
    const double most_steps = settling.patience / (settling.damping_rate * simulation.time_step());
    while (static_cast<double>(state.steps) < most_steps) {
        settling_simulation.advance(kLookInterval);
        if (simulation.divergence()) break;
        state.steps += kLookInterval;
        rest.kinetic = find_liveliest(simulation);
        rest.reaction_over_weight = weight.find_borne(simulation);
        const bool at_rest = rest.kinetic <= settling.rest && std::abs(rest.reaction_over_weight - 1.0) <= settling.reaction;
        state.checks_at_rest = at_rest ? state.checks_at_rest + 1 : 0;
        state.liveliest = std::max(state.liveliest, rest.kinetic);
        if (state.liveliest > settling.rest) {
            part = std::clamp(std::log(rest.kinetic / state.liveliest) / std::log(settling.rest / state.liveliest), part, 1.0);
            if (watch.on_progress) watch.on_progress(part, state.steps);
        }
        if (watch.give_up && watch.give_up()) break;
        rest.at_rest = state.checks_at_rest == kChecksInARow;
        if (rest.at_rest) break;
        if (watch.on_state) watch.on_state(state);
        scaling::stop_if_interrupted();
    }
    rest.steps = state.steps;
    if (watch.on_progress) watch.on_progress(1.0, state.steps);
    return rest;
}

}  // namespace musim::lsdem
