#pragma once

#include <cstdint>
#include <string>

#include "lsdem/model.hpp"
#include "lsdem/motion/simulation.hpp"

namespace musim::lsdem {

/// Settings that a user can trade for run time.
struct AccuracySetting {
    double safety = 0.8;  ///< time step over the critical one
    FaceContact faces = FaceContact::overlap;
    int nodes_per_face = 44;                    ///< of FaceContact::nodes and grids
    ContactNodes sides = ContactNodes::leader;  ///< likewise
    double voxel = 0.0;                         ///< spacing of a grid level set over the thin side of the block; 0: box in closed form [-]

    bool operator==(const AccuracySetting&) const = default;
};

/// Result of a setting for one problem.
struct AccuracyOutcome {
    double error = 0.0;             ///< relative, as the problem defines it; infinite when the run did not get there [-]
    std::uint64_t steps = 0;        ///< of all its runs
    std::uint64_t block_steps = 0;  ///< moving blocks times steps
    double seconds = 0.0;           ///< processor time of the stepping thread [s]
};

/// Box of edge lengths `size` [m] with the level set and nodes of a setting. `whole` is the block whose face carries the setting's number
/// of nodes, and whose node spacing other sizes keep. Throws std::invalid_argument as make_node_lattice does.
Shape make_shape(const AccuracySetting& setting, const Vector3& size, const Vector3& whole);

/// Puts the choices of a setting that concern contacts into a model. Time at rest is not passed over: every step is to cost what it costs.
void apply(const AccuracySetting& setting, Model& model);

/// Processor time this thread has used [s]: unlike wall time it does not count what other programs take.
double read_thread_time();

/// A simulation on the calling thread that adds up what its stepping costs.
class MeteredSimulation {
  public:
    /// `time_step` [s].
    MeteredSimulation(const Model& model, double time_step);
    /// A time step of setting.safety times the critical one.
    MeteredSimulation(const Model& model, const AccuracySetting& setting);

    Simulation& simulation() { return simulation_; }
    const Simulation& simulation() const { return simulation_; }

    /// Adds steps, block steps and seconds since the construction to an outcome.
    void add_to(AccuracyOutcome& outcome) const;

  private:
    Simulation simulation_;
    std::uint64_t moving_ = 0;
    double start_ = 0.0;
};

}  // namespace musim::lsdem
