#pragma once

#include <cstdint>
#include <functional>

#include "lsdem/motion/settling_simulation.hpp"
#include "lsdem/results/rest.hpp"

namespace musim::lsdem {

/// Damping rate in which blocks come to rest soonest: half their frequency parameter p = √(3g/(4R)) about the longer lower edge
/// [Housner63].
///
/// Damping rate α [1/s] at which a structure comes to rest soon. What takes longest is a block that tips from nearly balanced to its
/// resting face, and the sway of all. The former grows as exp(s t), s = √(p² + α²/4) − α/2: 0.62 p at α = p, 0.78 p at half of it, and like
/// p²/α with α ≫ p. The papers' c_v = 0.002 per step, α = 192 1/s for wood against p = 18.8 1/s [Harmon23, eq. 12], is eight times slower.
/// Sway decays with α/2 up to twice its own frequency, 8 rad/s in a tower of 38 such layers, and slower beyond. `size`: of a block;
/// `gravity` [m/s²].
double choose_damping_rate(const Vector3& size, double gravity);

/// Reports and questions while a simulation comes to rest, at every check, in this order; any may be empty.
struct SettlingWatch {
    /// Given a guess of the part that is done, 0 to 1, never less than before, and the steps taken.
    std::function<void(double, std::uint64_t)> on_progress = {};
    std::function<bool()> give_up = {};                       ///< ends the settling, not at rest, when it says so
    std::function<void(const SettlingState&)> on_state = {};  ///< given the state, unless it has ended
};

/// Looks in a row at which a structure must be at rest: a swing passes through rest, and the base bears the weight twice a cycle.
inline constexpr int kChecksInARow = 4;

/// The weight of the blocks that can move, and how much of it is borne.
class CarriedWeight {
  public:
    explicit CarriedWeight(const Model& model);

    bool exists() const { return mass_ * gravity_.norm() > 0.0; }
    /// Force along gravity with which ground and fixed blocks bear the others, over their weight [-].
    double find_borne(const Simulation& simulation) const;

  private:
    Vector3 gravity_;
    double mass_ = 0.0;               ///< of the blocks that can move [kg]
    std::vector<std::size_t> fixed_;  ///< blocks
};

/// Brings a simulation to rest, or carries that on from `state`. The part that is done is guessed from the decay of the liveliest block's
/// energy. Ends early, not at rest, when the simulation diverges. Throws scaling::Interrupted when the program is asked to stop, after
/// telling where it stands.
Rest settle(SettlingSimulation& settling_simulation, const Settling& settling, const SettlingWatch& watch = {}, SettlingState state = {});

}  // namespace musim::lsdem
