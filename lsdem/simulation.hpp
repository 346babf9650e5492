#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/model.hpp"
#include "lsdem/types.hpp"

namespace musim::lsdem {

/// Energy ledger at one instant [J]. Up to the closure error:
///   kinetic + gravitational + elastic_normal + elastic_shear + friction_loss + damping_loss = initial total + base_work.
struct Energy {
    double kinetic = 0.0;         ///< time-centred: Σ ½ m v(t−dt/2)·v(t+dt/2), and likewise for the spin
    double gravitational = 0.0;   ///< −Σ m g·(x − x_start)
    double elastic_normal = 0.0;  ///< Σ ½ K_n A d²
    double elastic_shear = 0.0;   ///< Σ ½ K_s A |ξ|²
    double friction_loss = 0.0;   ///< work of slip against the Coulomb limit since the start
    double damping_loss = 0.0;    ///< work of the dashpots since the start
    double base_work = 0.0;       ///< work done by the moving base since the start

    double mechanical() const { return kinetic + gravitational + elastic_normal + elastic_shear; }
    double balance() const { return mechanical() + friction_loss + damping_loss - base_work; }
};

/// Time-centred kinematics of all blocks at one instant, structure of arrays, world frame.
struct Kinematics {
    double time = 0.0;                      ///< [s]
    std::vector<Vector3> position;          ///< centres of mass [m]
    std::vector<Quaternion> orientation;    ///< body to world
    std::vector<Vector3> velocity;          ///< [m/s]
    std::vector<Vector3> angular_velocity;  ///< [rad/s]
};

/// Motion of the base at one instant, world frame.
struct BaseState {
    Vector3 displacement = Vector3::Zero();  ///< [m]
    Vector3 velocity = Vector3::Zero();      ///< [m/s]
    Vector3 acceleration = Vector3::Zero();  ///< [m/s²], the value that holds just after this instant
};

/// A numerical failure is a value, not an exception.
struct Divergence {
    enum class Kind {
        non_finite,            ///< a position or momentum is not a number
        energy_out_of_bounds,  ///< more energy than was ever put in, or a ledger that does not close
        too_fast               ///< a block crosses more than half of the smallest edge in one step: it could pass through another unseen
    };
    Kind kind = Kind::non_finite;
    std::size_t block = 0;  ///< the block that is not finite, the one with the most kinetic energy, or the fastest one
    double time = 0.0;      ///< [s]
};

/// Counters and extremes since the start.
struct Statistics {
    std::uint64_t steps = 0;               ///< time over time step
    std::uint64_t skipped = 0;             ///< of these, passed over because nothing moved
    std::size_t pairs = 0;                 ///< in the neighbor list now
    std::size_t contact_nodes = 0;         ///< touching now
    std::uint64_t rebuilds = 0;            ///< of the neighbor list
    double max_overlap_over_height = 0.0;  ///< largest node overlap ever, over the height of the shape of the block that owns the node
};

/// Seconds of wall time spent per phase since the start.
struct PhaseTimes {
    double neighbors = 0.0, contacts = 0.0, motion = 0.0;
};

/// Explicit LS-DEM simulation with a fixed time step. Results are the same bits for any number of threads.
class Simulation {
  public:
    /// Starts at t = 0 with the state in `model`; evaluates the first forces. `time_step` [s] must be positive and finite;
    /// `threads` = 0 means all cores. Throws std::invalid_argument on a model that is inconsistent (indices, non-positive mass, ...).
    Simulation(Model model, double time_step, int threads = 1);
    ~Simulation();
    Simulation(Simulation&&) noexcept;
    Simulation& operator=(Simulation&&) noexcept;

    /// Advances by `steps` time steps, or until the run diverges. Neither allocates nor throws in steady state.
    void advance(std::uint64_t steps = 1);

    double time() const;         ///< n·dt [s]
    double time_step() const;    ///< [s]
    const Model& model() const;  ///< as given at the start
    int threads() const;

    Kinematics kinematics() const;              ///< of all blocks, time-centred
    Vector3 position(std::size_t block) const;  ///< [m]
    Quaternion orientation(std::size_t block) const;
    Vector3 velocity(std::size_t block) const;          ///< time-centred [m/s]
    Vector3 angular_velocity(std::size_t block) const;  ///< time-centred [rad/s]
    BaseState base() const;
    Vector3 base_reaction() const;                   ///< force of the ground on the blocks now [N]
    Vector3 contact_force(std::size_t block) const;  ///< sum of all contact forces on a block now [N]

    Energy energy() const;
    Statistics statistics() const;
    PhaseTimes phase_times() const;
    std::optional<Divergence> divergence() const;

    /// 64-bit FNV-1a hash of positions, orientations and momenta of all blocks, as 16 hexadecimal digits.
    std::string state_hash() const;

    /// Fraction of blocks that have fallen: sunk by more than a quarter of their height, or tilted by more than 45° from the start.
    double fallen_fraction() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace musim::lsdem
