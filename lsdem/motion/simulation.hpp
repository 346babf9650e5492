#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/finite_turn.hpp"
#include "lsdem/losses.hpp"
#include "lsdem/model.hpp"
#include "lsdem/types.hpp"

namespace musim::lsdem {

/// Energy balance at one instant [J]. Up to the closure error:
///   kinetic + gravitational + elastic_normal + elastic_shear + friction_loss + damping_loss + preparation_loss
///     = initial total + base_work + load_work.
struct Energy {
    double kinetic = 0.0;           ///< time-centred: Σ ½ m v(t−h/2)·v(t+h/2), h the last substep, and likewise for the spin
    double gravitational = 0.0;     ///< −Σ m g·(x − x_start)
    double elastic_normal = 0.0;    ///< Σ ½ K_n A d²
    double elastic_shear = 0.0;     ///< Σ ½ K_s A |ξ|²
    double friction_loss = 0.0;     ///< work of slip against the Coulomb limit since the start
    double damping_loss = 0.0;      ///< work of the dashpots since the start
    double base_work = 0.0;         ///< work done by the moving base since the start
    double preparation_loss = 0.0;  ///< work of the velocity damping since the start
    double load_work = 0.0;         ///< work done by loads on their blocks since the start

    double mechanical() const { return kinetic + gravitational + elastic_normal + elastic_shear; }
    double balance() const { return mechanical() + friction_loss + damping_loss + preparation_loss - base_work - load_work; }
};

/// Time-centred kinematics of all blocks at one instant, structure of arrays, world frame.
struct Kinematics {
    double time = 0.0;                      ///< [s]
    std::vector<Vector3> position;          ///< centres of mass [m]
    std::vector<Quaternion> orientation;    ///< body to world
    std::vector<Vector3> velocity;          ///< [m/s]
    std::vector<Vector3> angular_velocity;  ///< [rad/s]
};

/// Motion of the base at one instant, world frame: of the point about which it turns, and its turn.
struct BaseState {
    Vector3 displacement = Vector3::Zero();    ///< that of the motion, which begins at t = 0 [m]
    Vector3 velocity = Vector3::Zero();        ///< [m/s]
    Vector3 acceleration = Vector3::Zero();    ///< [m/s²], the value that holds just after this instant
    Quaternion turn = Quaternion::Identity();  ///< since the motion began
    TurnRates turn_rates = {};                 ///< likewise just after this instant
    Vector3 pivot = Vector3::Zero();           ///< where that point is without its displacement; zero of a base that does not turn [m]

    /// Where a point at `x` now would be, had it moved with the base since the motion began and the base then not moved:
    /// pivot + turn⁻¹ (x − displacement − pivot) [m].
    Vector3 seen_from_base(const Vector3& x) const {
        const Vector3 unshifted = x - displacement, arm = unshifted - pivot;
        return unshifted + (turn.conjugate() * arm - arm);
    }
    /// Velocity of the point of the base that is at `x` now [m/s].
    Vector3 velocity_at(const Vector3& x) const { return velocity + turn_rates.velocity.cross(x - displacement - pivot); }
    /// Acceleration of the point of the base that is at `x` now [m/s²].
    Vector3 acceleration_at(const Vector3& x) const {
        const Vector3 arm = x - displacement - pivot;
        return acceleration + turn_rates.acceleration.cross(arm) + turn_rates.velocity.cross(turn_rates.velocity.cross(arm));
    }
};

/// A numerical failure is a value, not an exception.
struct Divergence {
    enum class Kind {
        non_finite,            ///< a position or momentum is not a number
        energy_out_of_bounds,  ///< more energy than was ever put in, or an energy balance that does not close
        too_fast               ///< a block crosses more than half of the smallest edge in one step: it could pass through another unseen
    };
    Kind kind = Kind::non_finite;
    std::size_t block = 0;  ///< the block that is not finite, the one with the most kinetic energy, or the fastest one
    double time = 0.0;      ///< [s]
};

/// A block whose contacts use more of the time step's limit than it has.
struct Overstiff {
    std::size_t block = 0;
    double time = 0.0;  ///< [s]
    double used = 0.0;  ///< see StiffnessWatch [-]
};

/// The first block that left its place: it turned by more than 39° from its upright in the model, or was clear of everything by a sixteenth
/// of its smallest edge. From then on any of its faces may land, and steps are taken in so many substeps.
struct Leaving {
    std::size_t block = 0;
    double time = 0.0;           ///< [s]
    std::uint64_t substeps = 1;  ///< 2^compute_landing_halvings
};

/// Counters and extremes since the start.
struct Statistics {
    std::uint64_t steps = 0;               ///< time over time step
    std::uint64_t skipped = 0;             ///< of these, passed over because nothing moved
    std::uint64_t substeps = 0;            ///< in which the others were taken; as many as these while all blocks are in their places
    std::optional<Leaving> leaving;        ///< nothing while all blocks are in their places
    std::size_t pairs = 0;                 ///< in the neighbor list now
    std::size_t apart = 0;                 ///< of these, known to be apart: a step passes over them
    std::size_t contacts = 0;              ///< pairs that touch now
    std::size_t contact_nodes = 0;         ///< touching now, of pairs that meet by nodes
    std::uint64_t rebuilds = 0;            ///< of the neighbor list
    std::optional<Overstiff> overstiff;    ///< the worst, looked at every 64 steps
    double max_overlap_over_height = 0.0;  ///< largest depth ever, over the height of the leader's shape
};

/// Seconds of wall time spent per phase.
struct PhaseTimes {
    double neighbors = 0.0, contacts = 0.0, motion = 0.0;
};

/// Force that one block bears from another, or from the ground.
struct ContactForce {
    std::size_t leader = 0;
    std::optional<std::size_t> follower;  ///< nothing: the ground
    Vector3 force = Vector3::Zero();      ///< on the leader, world frame [N]
    double energy = 0.0;                  ///< of its normal springs [J]
};

/// Stiffness of a pair that touches by its overlap against small motions of its blocks: springs over the area where its faces face each
/// other.
struct JointStiffness {
    std::size_t leader = 0;
    std::optional<std::size_t> follower;  ///< nothing: the ground
    double along = 0.0, across = 0.0;     ///< the normal, per area [Pa/m]
    double area = 0.0;                    ///< [m²]
    Vector3 normal = Vector3::Zero();     ///< in which the follower is pushed, world frame
    Vector3 middle = Vector3::Zero();     ///< of the area, world frame [m]
    Matrix3 second = Matrix3::Zero();     ///< moments of the area about its middle [m⁴]
};

/// Explicit LS-DEM simulation with a fixed time step. Once a block has left its place each step is taken in 2^n equal substeps, n of the
/// model and poses alone (compute_landing_halvings); times and counts are of whole steps. Results are the same bits for any number of
/// threads.
class Simulation {
  public:
    /// Starts at t = 0 with the state in `model`; evaluates the first forces. `time_step` [s] must be positive and finite;
    /// it uses `threads` at most. Throws std::invalid_argument on a model that is inconsistent (indices, non-positive mass, ...).
    Simulation(Model model, double time_step, int threads = 1);
    ~Simulation();
    Simulation(Simulation&&) noexcept;
    Simulation& operator=(Simulation&&) noexcept;

    /// Advances by `steps` time steps, or until the run diverges. Neither allocates nor throws in steady state.
    void advance(std::uint64_t steps = 1);

    /// Changes the rate of the velocity damping from now on, see Model::velocity_damping [1/s]; 0 ends it. The energy balance stays closed.
    /// Throws std::invalid_argument unless 0 ≤ rate ≤ 1/dt.
    void set_velocity_damping(double rate);
    double velocity_damping() const;  ///< [1/s]

    /// Writes the state, from which `restore` continues to the same bits as if there had been no interruption, with any number of threads;
    /// about 2 KB per block, in binary form, for machines of the same byte order. Throws std::ios_base::failure if the stream fails.
    void save(std::ostream& out) const;

    /// The simulation that `save` wrote, of the same model and time step; reads no further than its end. Throws std::runtime_error, which
    /// says what is wrong, for anything else: no state, one cut off or damaged, one of another model (down to the last bit of any number in
    /// it) or written by another version; std::invalid_argument as the constructor does. One that was saved while it settled goes on as
    /// a SettlingSimulation.
    static Simulation restore(Model model, std::istream& in, int threads = 1);
    /// Makes the neighbor list anew, as it is by itself after some motion. Changes no bit of what follows.
    void renew_neighbors();

    /// Ends the present motion of the base: another one begins. The state becomes the start of another run: time is zero, damping off;
    /// energy balance, counters and extremes begin anew. The base goes on from where it is: its displacement is continuous and base()
    /// counts it anew. Its velocity becomes that of the new motion at once; whoever wants no jump lets both motions meet. Loads begin anew.
    /// Velocities of blocks, contacts and their histories are kept; model() has the new motion. Throws std::invalid_argument, and changes
    /// nothing, when a sample is not finite or a sample interval not positive.
    void begin_motion(const BaseComponents& motion);

    double time() const;         ///< n·dt [s]
    double time_step() const;    ///< dt, whole, whatever substeps it is taken in [s]
    const Model& model() const;  ///< as given at the start, but for the motion of the base (begin_motion)
    int threads() const;

    Kinematics kinematics() const;              ///< of all blocks, time-centred
    Vector3 position(std::size_t block) const;  ///< [m]
    Quaternion orientation(std::size_t block) const;
    Vector3 velocity(std::size_t block) const;          ///< time-centred [m/s]
    Vector3 angular_velocity(std::size_t block) const;  ///< time-centred [rad/s]
    BaseState base() const;
    /// Largest absolute acceleration of each component of the base from the start of its motion until now [m/s²].
    Vector3 peak_base_acceleration() const;
    Vector3 base_reaction() const;                     ///< force of the base on the blocks now [N]
    Vector3 base_couple() const;                       ///< of the base on the blocks now, about its pivot [N·m]
    Vector3 contact_force(std::size_t block) const;    ///< sum of all contact forces and loads on a block now [N]
    Vector3 contact_torque(std::size_t block) const;   ///< of these about its centre of mass, world frame [N·m]
    std::vector<ContactForce> contact_forces() const;  ///< of all pairs that touch now, in the order of their blocks' numbers

    /// Stiffnesses of all pairs that touch now and meet by their overlap.
    std::vector<JointStiffness> joint_stiffness() const;

    /// Friction of all contacts that touch now, as Model::preload of a structure that is to begin where this one is.
    std::vector<Preload> preloads() const;

    /// Completes the elastic energies of overlaps, which steps leave rough: not for two threads at a time.
    Energy energy() const;
    Losses losses() const;                 ///< where friction and dashpots dissipated energy [J]
    std::vector<LoadState> loads() const;  ///< of Model::loads now
    Statistics statistics() const;
    PhaseTimes phase_times() const;  ///< since the start, or since the state was restored
    std::optional<Divergence> divergence() const;

    /// 64-bit FNV-1a hash of positions, orientations and momenta of all blocks, as 16 hexadecimal digits.
    std::string state_hash() const;

    /// Has a block fallen since the start? See lsdem/fallen.hpp.
    bool has_fallen(std::size_t block) const;

  private:
    friend class SettlingSimulation;
    struct Implementation;
    explicit Simulation(std::unique_ptr<Implementation> implementation);
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace musim::lsdem
