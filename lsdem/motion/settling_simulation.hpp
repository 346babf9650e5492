#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lsdem/motion/simulation.hpp"

namespace musim::lsdem {

/// A held block (Block::fixed), put in its place and let go.
struct Release {
    std::size_t block = 0;
    Vector3 position = Vector3::Zero();               ///< centre of mass, world frame [m]
    Quaternion orientation = Quaternion::Identity();  ///< body to world
    Vector3 velocity = Vector3::Zero();               ///< world frame [m/s]
};

/// Puts a held block of a model in its place and lets it go, as SettlingSimulation::release does with its own.
void release_block(const Release& release, Model& model);

/// Inertia of blocks while a specimen is prepared.
enum class Inertia {
    own,       ///< that of their mass
    as_stable  ///< so much more, as long as their contacts ask for it, that they are stable at whatever time step; see
               ///< docs/theory/preparation.md
};

/// A simulation that comes to rest before it is shaken: the base stands, and velocities decay, as when blocks are laid by hand. When it has
/// settled it becomes the simulation of a run. See docs/theory/preparation.md.
class SettlingSimulation {
  public:
    /// From where `simulation` is, with velocities that decay at `damping_rate` [1/s]. Throws std::invalid_argument unless
    /// 0 ≤ rate ≤ 1/dt.
    SettlingSimulation(Simulation simulation, double damping_rate, Inertia inertia = Inertia::own);
    /// Goes on from a state that was saved while it settled (Simulation::save, restore), to the same bits. Throws std::runtime_error for
    /// another one.
    explicit SettlingSimulation(Simulation restored);

    void advance(std::uint64_t steps = 1) { simulation_.advance(steps); }

    /// Puts held blocks in their places and lets them go, each at its velocity. What they bring in gravitational and kinetic energy counts
    /// as there from the start. Throws std::invalid_argument for a block that is not held, or is
    /// named twice, and for a state that is not finite.
    void release(const std::vector<Release>& blocks);

    /// As Simulation::set_velocity_damping.
    void set_damping_rate(double rate) { simulation_.set_velocity_damping(rate); }

    /// Where it is now.
    const Simulation& state() const { return simulation_; }

    /// Ends it: the state becomes the start of the run. Time is zero again, the base free to move, damping off; energy balance, counters
    /// and extremes begin anew. Contacts keep their history.
    Simulation finish() &&;

  private:
    Simulation simulation_;
};

}  // namespace musim::lsdem
