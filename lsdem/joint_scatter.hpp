#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

namespace musim::lsdem {

/// Deviates of joints are cut off at this many standard deviations: 6 in 100,000 draws are made again.
inline constexpr double kMostJointDeviates = 4.0;

/// Scatter of the joints of a model about what their materials give them: every pair of blocks, and every block on the ground, has a
/// friction coefficient of its own,
///
///   μ_ij = μ·(1 + σ·z_ij),   z_ij normal of mean 0 and deviation 1, none beyond kMostJointDeviates,
///
/// that follows from the seed and the two blocks' numbers alone: the same in both orders, whenever the two meet, on any thread.
struct JointScatter {
    double friction = 0.0;  ///< σ, relative standard deviation of the friction coefficients, below 1/kMostJointDeviates [-]; 0: no scatter
    std::uint64_t seed = 0;  ///< of the deviates

    bool operator==(const JointScatter&) const = default;
};

/// z_ij of the joint of block `a` and block `b` (nothing: the ground) [-]. Box-Muller [BoxMuller58] on bits that are mixed as in
/// [Steele14].
double draw_joint_deviate(std::uint64_t seed, std::size_t a, const std::optional<std::size_t>& b);

/// Factor 1 + σ·z_ij of a joint's friction coefficient [-]; 1 without scatter.
inline double find_friction_factor(const JointScatter& scatter, std::size_t a, const std::optional<std::size_t>& b) {
    return scatter.friction == 0.0 ? 1.0 : 1.0 + scatter.friction * draw_joint_deviate(scatter.seed, a, b);
}

}  // namespace musim::lsdem
