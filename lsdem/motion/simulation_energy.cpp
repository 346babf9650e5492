#include <algorithm>
#include <cmath>

#include "lsdem/contact/overlap_pairs.hpp"
#include "lsdem/motion/simulation_core.hpp"

/// The energy balance of a simulation, and when it counts as diverged.
namespace musim::lsdem {
namespace {

/// Kinetic plus elastic energy may exceed what was put in by this factor before the run counts as diverged: far above any closure error,
/// and passed within a few steps once a mode grows exponentially.
constexpr double kEnergyFactor = 4.0;

/// Part of all energy that was put in by which the energy balance may be off. Touching and parting within a step cost less than a percent;
/// an unstable mode that dashpots and parting keep small passes it.
constexpr double kBalanceBound = 0.1;

/// The same in the longer steps that mass scaling allows: touching and parting cost (ω dt)², up to sixteen times as much in steps four
/// times as long.
constexpr double kMassScalingBalanceBound = 1.0;

/// A block may cross this part of the smallest edge in one step.
constexpr double kMaxStride = 0.5;

}  // namespace

double Simulation::Implementation::kinetic() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies.fixed[i] != 0) continue;
        sum += 0.5 * bodies.mass[i] * bodies.velocity[i].squaredNorm();
        sum += 0.5 * bodies.momentum[i].dot(bodies.spin(i, bodies.momentum[i]));
    }
    return sum;
}

double Simulation::Implementation::stored_and_kinetic() const {
    const ContactTotals contacts = sum_contacts(list);
    return kinetic() + contacts.elastic_normal + contacts.elastic_shear;
}

/// The state now becomes the one that energies are counted from.
void Simulation::Implementation::restart_balance() {
    bodies.start_position = bodies.positions();
    bodies.start_position.push_back(bodies.pose.back().position);
    bodies.start_orientation = bodies.orientation;
    clear_losses(list);
    balance.finished = Losses{.block = std::vector<PairWork>(bodies.size()), .ground = {}};
    std::fill(bodies.preparation_loss.begin(), bodies.preparation_loss.end(), 0.0);
    loads.forget_work();
    balance.start = find_exact_energy().balance();
    balance.start_energy = stored_and_kinetic();
}

double Simulation::Implementation::gravitational() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies.fixed[i] != 0) continue;
        sum -= bodies.mass[i] * model.gravity.dot(bodies.pose[i].position - bodies.start_position[i]);
    }
    return sum;
}

std::size_t Simulation::Implementation::fastest_block() const {
    std::size_t fastest = 0;
    double most = -1.0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const double energy =
            bodies.mass[i] * bodies.velocity[i].squaredNorm() + bodies.momentum[i].dot(bodies.spin(i, bodies.momentum[i]));
        if (energy > most) most = energy, fastest = i;
    }
    return fastest;
}

double Simulation::Implementation::half_preparation_loss(std::size_t i) const {
    if (preparation.damping_rate == 0.0 && !preparation.mass_scaling.is_active()) return 0.0;
    const detail::VelocityDecay decay = decay_over(bodies.elapsed);
    const detail::TouchList::Load load = work.touches.sum(i, list.forces);
    const Vector3& velocity = bodies.velocity[i];
    const Vector3& momentum = bodies.momentum[i];
    const double h = bodies.elapsed;
    const Vector3 kick = h * (load.force * bodies.inverse_mass[i] + model.gravity), twist = h * load.torque;
    const Vector3 impulse_per_mass = (velocity_after(decay, i, load.force) - velocity) - kick;
    const Vector3 twist_impulse = (momentum_after(decay, i, load.torque) - momentum) - twist;
    return -0.5 * (bodies.mass[i] * impulse_per_mass.dot(velocity) + twist_impulse.dot(bodies.spin(i, momentum)));
}

Energy Simulation::Implementation::find_energy() const {
    Energy energy;
    const detail::VelocityDecay decay = decay_over(bodies.elapsed);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies.fixed[i] != 0) continue;
        const detail::TouchList::Load load = work.touches.sum(i, list.forces);
        const Vector3& velocity = bodies.velocity[i];
        const Vector3& momentum = bodies.momentum[i];
        const Vector3 spin = bodies.spin(i, momentum);
        const Vector3 next_velocity = velocity_after(decay, i, load.force);
        const Vector3 next_momentum = momentum_after(decay, i, load.torque);
        energy.kinetic += 0.5 * bodies.mass[i] * velocity.dot(next_velocity);
        energy.kinetic += 0.5 * spin.dot(next_momentum);
        energy.preparation_loss += half_preparation_loss(i);
    }
    for (const double loss : bodies.preparation_loss) energy.preparation_loss += loss;
    const ContactTotals contacts = sum_contacts(list);
    energy.elastic_normal = contacts.elastic_normal;
    energy.elastic_shear = contacts.elastic_shear;
    energy.gravitational = gravitational();
    const PairWork before = balance.finished.total();
    energy.friction_loss = before.friction + contacts.work.friction;
    energy.damping_loss = before.damping + contacts.work.damping;
    energy.base_work = base.work();
    energy.load_work = loads.work();
    return energy;
}

Energy Simulation::Implementation::find_exact_energy() {
    refine_overlap_energies(bodies, list);
    return find_energy();
}

void Simulation::Implementation::find_non_finite() {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const bool good = bodies.pose[i].position.allFinite() && bodies.velocity[i].allFinite() && bodies.momentum[i].allFinite() &&
                          bodies.pose[i].rotation.allFinite();
        if (good) continue;
        health.divergence = Divergence{Divergence::Kind::non_finite, i, static_cast<double>(steps.done) * dt};
        return;
    }
}

void Simulation::Implementation::check_health() {
    find_non_finite();
    if (health.divergence) return;
    const double time = static_cast<double>(steps.done) * dt;
    const double put_in = balance.start_energy + std::max(0.0, -gravitational()) + std::abs(base.work()) + std::abs(loads.work());
    const double allowed = kEnergyFactor * put_in + balance.floor;
    const double balance_bound = preparation.mass_scaling.is_active() ? kMassScalingBalanceBound : kBalanceBound;
    const auto out_of_bounds = [&] {
        const bool unbalanced = std::abs(find_energy().balance() - balance.start) > balance_bound * put_in + balance.floor;
        return unbalanced || stored_and_kinetic() > allowed;
    };
    // what a step knows of the energy of a corner or an edge is rough: before it condemns a run it is found exactly
    if (out_of_bounds()) {
        refine_overlap_energies(bodies, list);
        if (out_of_bounds()) health.divergence = Divergence{Divergence::Kind::energy_out_of_bounds, fastest_block(), time};
    }
    // blocks with mass scaling have what their contacts ask for
    if (!preparation.mass_scaling.is_active()) {
        const StiffestBlock stiffest = health.stiffness_watch.find_stiffest(bodies, list, health.overstiff ? health.overstiff->used : 1.0);
        if (stiffest.used > 0.0) health.overstiff = Overstiff{stiffest.block, time, stiffest.used};
    }
    for (std::size_t i = 0; i < bodies.size() && !health.divergence; ++i) {
        if (bodies.velocity[i].norm() * bodies.elapsed > kMaxStride * smallest_edge)
            health.divergence = Divergence{Divergence::Kind::too_fast, i, time};
    }
}

}  // namespace musim::lsdem
