#pragma once

namespace musim::lsdem::detail {

/// Friction coefficient at which no joint of a chain slips: shear forces are some hundred weights at most [-].
inline constexpr double kNoSlip = 1e9;

}  // namespace musim::lsdem::detail
