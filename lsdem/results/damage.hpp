#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/results/history.hpp"

/// Damage that a motion has left behind: slip between blocks, rotations, fallen blocks.
namespace musim::lsdem {

/// Two blocks that stood on each other at the start, or a block on the ground.
struct Joint {
    std::size_t upper = 0;
    std::size_t lower = 0;  ///< meaningless on the ground
    bool on_ground = false;
    double slip = 0.0;  ///< horizontal distance, at the end, of the two points that met in the middle of the joint at the start [m]
};

/// Damage of a block at the end.
struct BlockDamage {
    bool fallen = false;
    double rotation = 0.0;  ///< residual, whole angle, relative to the start [rad]
};

/// A mean and a largest value.
struct Spread {
    double mean = 0.0;
    double max = 0.0;
};

/// The blocks of one level, and the joints on their lower side.
struct LevelDamage {
    int level = 0;  ///< from 1 at the base; 0: blocks in no layer
    std::size_t blocks = 0;
    std::size_t fallen = 0;
    Spread slip;          ///< of the joints below [m]
    Spread displacement;  ///< residual, horizontal, relative to the base [m]
    Spread initial_tilt;  ///< of the block's own z axis from the vertical, at the start [rad]
    Spread final_tilt;    ///< likewise at the end [rad]
    Spread rotation;      ///< residual, whole angle, relative to the start [rad]
    Spread turn;          ///< residual, about the vertical, relative to the start, absolute [rad]
    double index = 0.0;   ///< damage index of the level [-]
    /// Dissipated in the joints below: in those that the blocks of the level beneath lead, or with the ground below the lowest level [J].
    /// Work in the joints below the level, of the highest level also in those that it leads itself, among its own blocks. Blocks in no
    /// layer: what they lead.
    std::optional<PairWork> loss;
};

struct Damage {
    std::vector<Joint> joints;
    std::vector<BlockDamage> each;    ///< of all blocks
    std::vector<LevelDamage> levels;  ///< from the lowest up
    std::size_t blocks = 0;
    std::size_t fallen = 0;
    std::optional<PairWork> loss;  ///< dissipated in all joints [J]; nothing when the results hold no losses
    /// √(mean over blocks of D²): 0 for a structure as it was built, 1 when every block is lost [-].
    ///
    ///   D = min(1, (s + ½·d·ψ)/b);   D = 1 for a fallen block
    ///
    /// s mean slip of the block on what carried it, ψ its residual rotation, b and d the shorter side and the diagonal of its base: s + ½dψ
    /// bounds how far any corner of the base has moved on its support, and at D = ½ the middle of the block may stand over an edge. Blocks
    /// out of line are the damage that [Andrade22] and [Harmon23] describe, without a number for it.
    double index = 0.0;
};

/// Angle of a block's own z axis with the vertical [rad].
double find_tilt(const Quaternion& orientation);

/// Compares the end of a run with its start, both seen from the base: on a ground that turned, horizontal and vertical are along it and
/// across it. Blocks count as fallen by has_fallen: sunk by a quarter of their height, or tilted by 45°; or
/// when they fell before a run that was not shaken for it (RunData::fell_before). Blocks that begin in the air (Falls::airborne)
/// do not fall. Fixed blocks count like others.
Damage assess_damage(const RunData& run);

/// Part of what all joints dissipated that a level did [-]; 0 when none dissipated anything. Both must hold losses.
double find_loss_share(const LevelDamage& level, const Damage& damage);

/// level,blocks,fallen,slip_mean_m,...,damage_index,friction_loss_j,damping_loss_j,loss_share: one line per level, angles in degrees. The
/// last three are empty when the results hold no losses.
std::string make_damage_csv(const Damage& damage);

}  // namespace musim::lsdem
