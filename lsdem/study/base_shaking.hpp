#pragma once

#include <array>
#include <optional>
#include <vector>

#include "lsdem/model.hpp"

namespace musim::lsdem {

/// Motion of a model's base as its prototype's: v_M(τ t) = ν v_P(t), along z with a ν of its own.
struct BaseShaking {
    std::optional<double> time;               ///< τ [-]; nothing where every component is a step, which has no time
    std::optional<double> velocity;           ///< ν of x and y [-]; nothing where neither moves
    std::optional<double> velocity_vertical;  ///< ν of z [-]; likewise
};

/// Motions whose velocities differ by more than this part of their rms are two motions [-]: records that were filtered or resampled for
/// a table stay below, other earthquakes are beyond 1.
inline constexpr double kSameShaking = 0.02;

/// Measured factors this near to what a law asks for are those [-]: files of records have six or more digits.
inline constexpr double kMeasuredFactor = 1e-4;

/// The factors between two motions of the base, up to `duration` of the prototype's [s]. τ is the ratio of sampling intervals, one of
/// `expected`, or that of the root mean square times of v²: whichever leaves the least difference. ν is by least squares over the
/// prototype's samples. Nothing when the model does not move as the prototype does: other directions, or a difference above kSameShaking.
std::optional<BaseShaking> measure_base_shaking(const BaseComponents& prototype, const BaseComponents& model, double duration,
                                                const std::vector<double>& expected);

}  // namespace musim::lsdem
