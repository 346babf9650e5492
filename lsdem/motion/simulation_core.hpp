#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "lsdem/archive.hpp"
#include "lsdem/bodies.hpp"
#include "lsdem/contact/contacts.hpp"
#include "lsdem/contact/overlap_pairs.hpp"
#include "lsdem/contact/stiffness_watch.hpp"
#include "lsdem/detail/shared_work.hpp"
#include "lsdem/detail/velocity_decay.hpp"
#include "lsdem/motion/applied_loads.hpp"
#include "lsdem/motion/carrying_base.hpp"
#include "lsdem/motion/mass_scaling.hpp"
#include "lsdem/motion/motion_kernel.hpp"
#include "lsdem/motion/neighbors.hpp"
#include "lsdem/motion/settling_simulation.hpp"
#include "lsdem/thread_team.hpp"

/// Parts of a simulation. Its functions are in simulation_start.cpp, simulation_step.cpp, simulation_energy.cpp and
/// simulation_state.cpp; what users see of it, in simulation.cpp and settling_simulation.cpp.
namespace musim::lsdem {

/// Throws std::invalid_argument with the message unless `holds`.
void require(bool holds, const char* what);

/// Refuses rates that make no sense with the time step. Throws std::invalid_argument.
void check_velocity_damping(double rate, double time_step);

/// While a structure is prepared the base stands, velocities decay, and blocks may have more inertia than their own.
struct PreparationAids {
    bool active = false;
    double damping_rate = 0.0;  ///< of velocities [1/s]
    detail::MassScaling mass_scaling = {};
};

/// Where the simulation is in time, in steps.
struct StepCount {
    std::uint64_t done = 0;
    std::uint64_t skipped = 0;   ///< passed over, since nothing moved
    std::uint64_t substeps = 0;  ///< of those that were computed
    std::uint64_t rest_end = 0;  ///< the step up to which nothing moves
    int checks_at_rest = 0;      ///< in a row at which nothing moved
    std::uint64_t rebuilds = 0;  ///< of the list of pairs
    std::optional<Leaving> leaving = {};
};

/// Origin of the energy balance.
struct EnergyBase {
    double start_energy = 0.0;       ///< kinetic plus elastic at t = 0 [J]
    double start = 0.0;              ///< of the balance at t = 0 [J]
    Losses finished = {};            ///< up to the last rebuild of the list
    double floor = 0.0;              ///< energy that needs no explanation [J]
    double weight_times_edge = 0.0;  ///< [J]
};

/// Findings of the checks.
struct Health {
    std::optional<Divergence> divergence;
    StiffnessWatch stiffness_watch;
    std::optional<Overstiff> overstiff;  ///< the worst so far
};

/// Who does what in a step, and what each thread leaves.
struct StepWork {
    explicit StepWork(int threads)
        : drift(static_cast<std::size_t>(threads), 0.0), overlap(static_cast<std::size_t>(threads), 0.0), team(threads) {}

    detail::TouchList touches;         ///< what pushes each body
    std::size_t end_of_loose = 0;      ///< from this block on all are held
    detail::SharedWork pairs;          ///< of the list
    std::deque<OverlapBatch> batches;  ///< per thread
    std::vector<double> drift;         ///< per thread, largest of its blocks [m]
    std::vector<double> overlap;       ///< per thread, largest overlap over height ever
    PhaseTimes times;
    ThreadTeam team;
};

struct Simulation::Implementation {
    Model model;
    double dt;  ///< length of a step [s]; that of the last substep is Bodies::elapsed
    Bodies bodies;
    CarryingBase base;
    NeighborSearch search;
    ContactList list;
    double smallest_edge = 0.0;  ///< of all blocks [m]
    AppliedLoads loads;
    PreparationAids preparation;
    StepCount steps;
    EnergyBase balance;
    Health health;
    StepWork work;

    Implementation(Model given, double time_step, int threads);

    /// The first forces, from the model's initial state.
    void start();
    /// Hands the whole state to an archive, or takes it from there.
    void exchange(Archive& archive);
    /// One step, of one substep or of more. Ends early with a divergence.
    void step();
    std::uint64_t substeps_per_step() const;
    double substep_length() const { return dt / static_cast<double>(substeps_per_step()); }  ///< [s]
    /// Moves all by `h` [s], to the time at which the base is where its motion has it then.
    void move(double h, double time);
    void update_contacts();
    /// Forces of the loads at a time, unless the structure is being prepared.
    void update_loads(double time);
    /// Looks for a block that has left its place, unless one has.
    void note_leaving();
    void rebuild();
    void release(const Release& given);
    void restart();
    void restart_balance();
    void share_work();
    /// Load of all contacts on a block. Throws std::out_of_range where there is none.
    detail::TouchList::Load load_on(std::size_t block) const;
    detail::VelocityDecay decay_over(double h) const { return {preparation.damping_rate, h}; }
    /// Velocity after a time of decay [m/s].
    Vector3 velocity_after(const detail::VelocityDecay& decay, std::size_t i, const Vector3& force) const {
        return decay.keep * bodies.velocity[i] + decay.push * bodies.free[i] * (force * bodies.inverse_mass[i] + model.gravity);
    }
    void check_health();
    double kinetic() const;
    /// The energy balance from what steps leave; find_exact_energy computes first what they leave out.
    Energy find_energy() const;
    Energy find_exact_energy();
    /// Angular momentum after a time of decay [kg·m²/s].
    Vector3 momentum_after(const detail::VelocityDecay& decay, std::size_t i, const Vector3& torque) const {
        return decay.keep * bodies.momentum[i] + decay.push * bodies.free[i] * torque;
    }
    /// Work [J] that the impulse of the damping and of mass scaling on block i at this step does on the velocity before it.
    double half_preparation_loss(std::size_t i) const;
    std::uint64_t find_steps_at_rest();
    double stored_and_kinetic() const;
    double gravitational() const;
    void find_non_finite();
    std::size_t fastest_block() const;
};

}  // namespace musim::lsdem
