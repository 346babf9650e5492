#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "lsdem/motion/simulation.hpp"
#include "lsdem/results/history.hpp"
#include "lsdem/results/time_plan.hpp"
#include "lsdem/run/simulate.hpp"
#include "records/processing/biquad.hpp"

namespace musim::lsdem {

/// Reads the sensors of a run after each of its steps, filters what they read and keeps it at their rates. What it needs to go on is in
/// the run (RunResult::sensor_memory). Formulas in docs/theory/sensors.md.
class SensorReader {
  public:
    /// Reader of a run of a specimen whose first step is to come; the first readings are taken. Filters are as if these had lasted for
    /// ever. Throws std::invalid_argument unless the plan has readings for each sensor.
    static SensorReader begin(const Simulation& simulation, const Specimen& specimen, const TimePlan& plan, RunResult& run);

    /// Reader of a run that goes on. Throws std::runtime_error when what it kept does not fit.
    static SensorReader resume(const Simulation& simulation, const Specimen& specimen, const TimePlan& plan, RunResult& run);

    bool has_sensors() const { return !specimen_->sensors.empty(); }

    /// Takes the readings of the step that has just been taken, the `step`-th of the run.
    void read(std::uint64_t step);

  private:
    /// Motion of a point, world frame [m, m/s, m/s²].
    struct PointMotion {
        Vector3 position, velocity, acceleration;
    };
    /// A body at one instant, world frame: its centre of mass, of the ground its origin.
    struct BodyState {
        Vector3 position, velocity, acceleration;
        Quaternion orientation;
        Vector3 spin, spin_rate;  ///< angular velocity [rad/s] and acceleration [rad/s²]

        /// Motion of a point that it carries; `place` in its frame [m].
        PointMotion follow(const Vector3& place) const;
    };

    SensorReader(const Simulation& simulation, const Specimen& specimen, const TimePlan& plan, RunResult& run);

    BodyState find_base() const;
    BodyState find_body(const std::optional<std::size_t>& body) const;
    /// Pose when the run began.
    BodyState find_start(const std::optional<std::size_t>& body) const;
    /// Force of the second body of a joint on the first [N].
    Vector3 find_force(const PlacedSensor& joint) const;
    /// Channels of a sensor now; none of a joint that is none.
    std::vector<double> read_now(std::size_t sensor) const;
    std::vector<double> read_joint(const PlacedSensor& joint, const SensorMemory& memory) const;
    void set_up_joint(const PlacedSensor& joint, SensorMemory& memory) const;
    /// Fetches what several sensors ask for.
    void look();

    const Simulation* simulation_;
    const Specimen* specimen_;
    const TimePlan* plan_;
    RunResult* run_;
    std::vector<std::vector<records::detail::Biquad>> filters_;  ///< sections for each sensor
    std::vector<ContactForce> forces_;                           ///< now, where there is a joint
};

}  // namespace musim::lsdem
