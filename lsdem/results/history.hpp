#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/block_reach.hpp"
#include "lsdem/motion/simulation.hpp"
#include "lsdem/results/base_change.hpp"
#include "lsdem/results/block_shapes.hpp"
#include "lsdem/results/rest.hpp"
#include "lsdem/results/sensor_history.hpp"
#include "lsdem/scene/spine.hpp"
#include "lsdem/types.hpp"
#include "scaling/laws/similitude.hpp"

/// Studies on scenes: single runs, paired runs at several scales, their results on disk and their picture.
namespace musim::lsdem {

/// Motion sampled at even intervals, world frame. Spine values are stored time by time: value of spine block s at sample k in [k·ns + s].
struct History {
    std::vector<double> time;             ///< [s]
    std::vector<BaseState> base;          ///< of the ground
    std::vector<Vector3> spine_position;  ///< centres of mass [m]
    std::vector<Vector3> spine_velocity;  ///< [m/s]
    std::vector<Vector3> spine_rotation;  ///< rotation vector from the start to now, seen from the base [rad]
    std::vector<Energy> energy;           ///< [J]
    std::vector<LoadState> load;          ///< load l at sample k in [k·nl + l]

    std::size_t samples() const { return time.size(); }
};

/// Poses of all blocks at chosen instants, single precision, for pictures: value of block b at frame k in [k·n + b].
struct Frames {
    std::vector<double> time;                 ///< [s]
    std::vector<Eigen::Vector3f> position;    ///< [m]
    std::vector<Eigen::Vector4f> quaternion;  ///< (w, x, y, z), body to world
    std::vector<Eigen::Vector3f> velocity;    ///< [m/s]
    /// Sum of the magnitudes of all forces with which neighbours and ground press on the block [N]; of a block in a column, twice what it
    /// bears and its weight. Empty in results of versions before it was kept.
    std::vector<float> contact_force;
};

/// When blocks fell, and where they were then (has_fallen), seen at the samples; one entry per block. Displacements are from the start,
/// seen from the base. In a later stage of a sequence the start is that of the first one (StageOrigin).
struct Falls {
    std::vector<double> time;           ///< first sample at which the block had fallen [s], ≤ 0: in an earlier stage; NaN while it stands
    std::vector<Vector3> displacement;  ///< of its centre of mass then [m]; likewise
    std::vector<Vector3> at_collapse;   ///< of all blocks at RunData::collapse_time [m]; empty before
    /// 1: the block begins in the air, not carried or thrown up, so that it cannot fall from a place; empty in results of versions before.
    std::vector<int> airborne = {};

    bool is_airborne(std::size_t block) const { return block < airborne.size() && airborne[block] != 0; }
};

/// State that a later stage of a sequence takes over from the stages before it. Falls count from here.
struct StageOrigin {
    std::size_t stage = 1;                ///< which one the run is, counted from 0
    double time = 0.0;                    ///< duration of the motions before it [s]
    Vector3 base = Vector3::Zero();       ///< displacement of the base before it [m]
    std::vector<Vector3> position;        ///< of all blocks at the start of the first stage [m]
    std::vector<Quaternion> orientation;  ///< likewise, body to world
};

/// Table of the blocks, for results on disk.
struct BlockTable {
    std::vector<Vector3> size;  ///< edge lengths of the smallest box about the body's origin and axes that holds it [m]
    std::vector<double> mass;   ///< [kg]
    std::vector<int> layer;     ///< from 1 at the base; 0: in no layer
    /// Names of listed blocks, empty for those without one; no entries for blocks of columns, towers and walls.
    std::vector<std::string> name = {};
    BlockShapes shapes = {};  ///< of blocks that are no boxes

    /// Solid of a block; none of a box or a sphere.
    const Solid* find_solid(std::size_t block) const {
        const BlockShape* shape = shapes.find(block);
        return shape != nullptr && shape->radius == 0.0 ? &shape->solid : nullptr;
    }
    /// Reach of a block in an orientation, body to world.
    BlockReach find_reach(std::size_t block, const Quaternion& orientation) const {
        return find_block_reach(find_solid(block), 0.5 * size[block], orientation.toRotationMatrix());
    }
    bool is_listed() const { return !name.empty(); }
    /// "lintel", or "block 3" for a block without a name.
    std::string label(std::size_t block) const;
    /// The same for messages: `block 3 ("lintel")`.
    std::string describe(std::size_t block) const;
    /// b: the shorter of the sides across the body's z axis [m].
    double thin_side(std::size_t block) const { return size[block].head<2>().minCoeff(); }
};

/// Beginning of a run: its structure at rest after a preparation; with its weight beginning to act, as "preparation": "none" asks; or as
/// single blocks are listed.
enum class Beginning { prepared, at_once, listed };

/// End of a run. Collapse is a result: the run goes on to its end. Divergence is a numerical failure and ends the run.
enum class RunStatus { completed, collapsed, diverged };

/// "completed", "collapsed" or "diverged".
std::string to_string(RunStatus status);

/// Data of a run, as simulate() produces and result folders keep them.
struct RunData {
    RunStatus status = RunStatus::completed;
    std::optional<double> collapse_time;  ///< first sample with enough fallen blocks [s]
    std::optional<StageOrigin> origin;    ///< of a later stage of a sequence
    BlockTable blocks;
    Spine spine;
    std::vector<std::string> loads = {};  ///< names of the loads
    History history;  ///< as read from results, energy of all springs is that of normal ones; none in results of versions without energies
    Frames frames;    ///< empty unless the scene asks for them
    Falls falls;      ///< empty in results of versions before they were kept
    std::vector<SensorHistory> sensors;                ///< in the order of the scene
    Kinematics initial;                                ///< as read from results, poses only
    Kinematics final;                                  ///< likewise, at the last sample
    std::optional<Losses> losses;                      ///< where energy was dissipated since the start [J]; likewise
    std::string state_hash;                            ///< of the final state
    Vector3 peak_base_acceleration = Vector3::Zero();  ///< PGA of each component of the motion that the base was given, absolute [m/s²]
    BaseChanges base_changes;                          ///< of that motion, against what it was made from
    scaling::Similitude similitude;                    ///< of the run to its prototype; of one that is no model every factor is 1

    /// Did the structure collapse while it was prepared (Rest::collapsed), so that it was not shaken?
    bool collapsed_before() const { return !origin && collapse_time && *collapse_time <= 0.0; }
    /// Is a block one of those that fell then?
    bool fell_before(std::size_t block) const { return collapsed_before() && block < falls.time.size() && falls.time[block] <= 0.0; }
    /// Centres of mass where falls are counted from [m].
    const std::vector<Vector3>& standing_position() const { return origin ? origin->position : initial.position; }
};

/// State of a sensor between two steps, from which it goes on to the same bits.
struct SensorMemory {
    std::vector<double> filter;  ///< two numbers for each section, channel by channel
    std::vector<double> last;    ///< filtered channels at the last step, SI
    /// Joint, fixed when the run began: the point of it in the frames of both bodies [m], and its normal and one direction across it
    /// in that of the second.
    std::array<Vector3, 2> place = {Vector3::Zero(), Vector3::Zero()};
    Vector3 normal = Vector3::Zero(), across = Vector3::Zero();
};

/// Everything one simulation produced.
struct RunResult : RunData {
    std::optional<Divergence> divergence;  ///< where and when, when the run diverged
    Beginning beginning = Beginning::listed;
    std::optional<Rest> rest;                  ///< how it settled before t = 0; nothing when it was not to
    double time_step = 0.0;                    ///< [s]
    std::optional<double> critical_time_step;  ///< of the structure as built [s]; nothing when no block can move
    std::uint64_t steps = 0;                   ///< done
    Statistics statistics;
    double energy_closure = 0.0;                       ///< see compute_energy_closure
    std::optional<double> start_reaction_over_weight;  ///< at t = 0, as below
    std::optional<double> base_reaction_over_weight;   ///< at the end, along gravity; nothing without a ground or fixed blocks, or gravity
    double wall_time = 0.0;                            ///< [s]
    std::vector<SensorMemory> sensor_memory;           ///< one for each sensor
};

/// Names of the spine's blocks: "level 5" of a layer, BlockTable::label of a listed block.
std::vector<std::string> label_spine(const RunData& run);
/// The same to begin columns of CSV with: "level5", "lintel", "block3".
std::vector<std::string> head_spine(const RunData& run);

/// Indices of the spine's blocks from the lowest at the start up; of equal heights the first listed first.
std::vector<std::size_t> sort_spine_by_height(const RunData& run);

/// Largest change of the energy balance over the largest energy in play,
///   max_t |B(t) − B(0)| / max_t (E_kin + |E_grav(t) − E_grav(0)| + E_el + W_friction + W_damping + W_preparation + |W_base| + |W_loads|),
/// both over the sampled history [-]; 0 when nothing ever moves.
double compute_energy_closure(const std::vector<Energy>& energy);

}  // namespace musim::lsdem
