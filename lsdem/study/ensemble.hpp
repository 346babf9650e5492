#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/response/response.hpp"
#include "lsdem/results/history.hpp"
#include "lsdem/study/ensemble_members.hpp"
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

/// End of a member. Only `completed` and `collapsed` are results; `unsettled` did not come to rest before t = 0, `failed` has none.
enum class MemberStatus { completed, collapsed, diverged, unsettled, failed };

/// "completed", "collapsed", "diverged", "unsettled" or "failed".
std::string to_string(MemberStatus status);

/// One member in the summary.
struct MemberResult {
    std::string name;
    std::uint64_t seed = 0;
    MemberStatus status = MemberStatus::failed;
    std::string reason;                   ///< why it is no result; empty when it is one
    std::optional<double> collapse_time;  ///< [s]
    std::string state_hash;               ///< of the final state; empty when it failed
    std::optional<Response> response;     ///< of a result; speeds along the ensemble's axis
};

/// One level of the spine over the members that completed. Components x, y, z; displacements relative to the base.
struct LevelMoments {
    int level = 0;
    SampleMoments height{1};                 ///< of the centre at the start [m]
    SampleMoments peak_velocity{3};          ///< [m/s]
    SampleMoments peak_displacement{3};      ///< [m]
    SampleMoments residual_displacement{3};  ///< [m]
    SampleMoments rotation{4};               ///< in-plane peak and residual, about the vertical peak and residual [rad]
};

/// Speeds of one method over the completed members that have one.
struct SpeedMoments {
    std::string method;
    SampleMoments speed{1};  ///< [m/s]
};

/// Summary of an ensemble.
struct EnsembleSummary {
    std::string name;                   ///< of the scene
    int axis = 0;                       ///< 0, 1, 2: x, y, z of the main motion
    std::optional<SpeedScales> scales;  ///< of the first member that is a result
    std::vector<MemberResult> members;
    Bands bands;  ///< of completed members, and of collapsed ones before their collapse
    std::vector<LevelMoments> levels;
    std::vector<SpeedMoments> speeds;
    SampleMoments damage{1};  ///< damage index [-]

    int count(MemberStatus status) const;
};

/// Reads the members' results one after another, in the order of their seeds, and adds them up: the summary depends on nothing but the
/// results, not on when or where they were computed. `axis`: nothing for that along which the base of the first result moves most.
/// A member whose report has an error, or whose results cannot be read or belong to another scene, is `failed` with the reason.
EnsembleSummary summarize_ensemble(const std::filesystem::path& directory, const std::vector<EnsembleMember>& members,
                                   const std::vector<MemberReport>& reports, std::optional<int> axis = {});

}  // namespace musim::lsdem
