#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "records/ground_motion.hpp"
#include "records/processing/processing.hpp"

namespace musim::records {

/// How a record becomes the motion of a simulation's base. Defaults change as little as possible.
struct BaseMotionSettings {
    std::optional<TimeWindow> window = {};             ///< part of the record to use; all of it by default
    bool take_out_mean = false;                        ///< first; high-passed, an offset would ring
    std::optional<scaling::Frequency> high_pass = {};  ///< corner, of order 2 in each of two passes; none by default
};

/// Taper of a record that is cut or filtered [fraction of its length, each end]. Long enough to hide the cut's jump, short enough to leave
/// the strong motion alone: PGV of the papers' Ridgecrest record, cut to its strong part, moves by 0.5 % between 0.005 and 0.05.
inline constexpr double kDefaultTaper = 0.02;

/// Motion of a base that starts and ends at rest.
struct BaseMotion {
    TimeSeries velocity;             ///< linear between samples; first and last are exactly zero
    TimeSeries displacement;         ///< its exact integral from zero
    scaling::Length residual;        ///< displacement of the last sample: rounding only, below 1e-9 of the largest
    std::vector<std::string> steps;  ///< what was done, in words, for histories and reports
};

/// Cuts, corrects, tapers, filters and integrates one series to a velocity and a displacement that both end at rest.
///
/// The order is window, mean, taper, high-pass, integration from zero, and a last correction: the acceleration
/// α τ(1 − τ) + β τ(1 − τ)(1 − 2τ), τ from 0 to 1 over the record, whose integrals carry the final velocity and displacement, is
/// subtracted. It is zero at both ends and as slow as the record is long. A velocity series is not integrated first; a displacement is
/// differentiated. Throws ProcessingError as the single steps do, and for fewer than four samples.
BaseMotion make_base_motion(const TimeSeries& series, const BaseMotionSettings& settings = {});

/// The same for a component of a record. An uncorrected one is high-passed at its integration corner, its mean taken out before, unless
/// `settings` says otherwise.
/// Also throws ReadError for an unknown component.
BaseMotion make_base_motion(const GroundMotion& motion, std::string_view component, BaseMotionSettings settings = {});

}  // namespace musim::records
