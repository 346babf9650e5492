#pragma once

#include <cstdint>
#include <optional>

#include "records/ground_motion.hpp"

namespace musim::records {

/// Wishes for a synthetic record. The defaults are the peaks of the papers' Ridgecrest record, China Lake 360 [Andrade22, Table 1].
struct SyntheticSettings {
    scaling::Acceleration pga = 0.511 * scaling::kStandardGravity;   ///< peak acceleration
    scaling::Velocity pgv = 0.424 * scaling::si::meters_per_second;  ///< peak velocity
    scaling::Time dt = 0.005 * scaling::si::seconds;
    scaling::Time duration = 40.0 * scaling::si::seconds;  ///< rounded to whole steps
    std::uint64_t seed = 1;                                ///< another seed, another motion with the same peaks
    std::optional<scaling::Time> d5_95 = {};               ///< significant duration, below about 0.7 of the duration; free by default
};

/// Nearness to a wanted D5-95 [fraction of it].
inline constexpr double kDurationTolerance = 0.01;

/// A made acceleration record, one component "1", that has both peaks at once and ends at rest.
///
/// White noise passes a ground filter (Kanai-Tajimi [Tajimi60], second-order, frequency ω_g), a low-pass, an envelope in time
/// ([Jennings68]-like: quadratic rise, plateau, quadratic fall) and a high-pass [CloughPenzien93]; what is left of velocity and
/// displacement at the end is taken out as in make_base_motion(). PGV/PGA depends on ω_g alone, which bisection finds; then all samples are
/// multiplied to the PGA. Both peaks are met to 1e-9. A wanted D5-95 is met to kDurationTolerance by bisection for the width of the
/// envelope, with both peaks met at every width. docs/theory/records.md gives the constants, all of them multiples of PGA/PGV or of the
/// duration.
///
/// Only + − × ÷ are used, so every IEEE machine makes the same bits, and settings scaled by powers of two make the scaled record exactly.
/// Throws ProcessingError when a setting is not positive and finite, when the record has fewer than 64 steps or more than 10^8, when no ω_g
/// gives the wanted PGV/PGA (too short, too coarse), or no envelope the wanted D5-95.
GroundMotion make_synthetic_record(const SyntheticSettings& settings = {});

}  // namespace musim::records
