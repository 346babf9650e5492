#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "lsdem/results/history.hpp"
#include "lsdem/study/sample_moments.hpp"

namespace musim::lsdem {

/// Mean and scatter of the spine's velocity over members, world frame. Value of level s at sample k in [k·ns + s], as in History.
struct Bands {
    std::vector<double> time;     ///< [s]
    std::vector<BaseState> base;  ///< the same for all members
    std::vector<int> level;
    std::vector<int> count;     ///< members that reached sample k standing
    std::vector<Vector3> mean;  ///< [m/s]; NaN where no member counts
    std::vector<Vector3> sd;    ///< [m/s]; NaN where fewer than two do

    std::size_t samples() const { return time.size(); }
    std::size_t levels() const { return level.size(); }
};

/// Adds up members one at a time; only one history need be in memory.
class BandSum {
  public:
    /// Takes a member's samples, those before its collapse. Throws std::invalid_argument when levels or sampling times differ from those of
    /// the members before by more than 1e-9 of the sampling interval.
    void add(const History& history, const Spine& spine, std::optional<double> collapse_time);

    Bands bands() const;

  private:
    void take_times(const History& history);

    std::vector<int> level_;
    std::vector<double> time_;
    std::vector<BaseState> base_;
    std::vector<SampleMoments> velocity_;  ///< per sample, three components per level
};

}  // namespace musim::lsdem
