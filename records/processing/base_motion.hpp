#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "records/ground_motion.hpp"
#include "records/processing/processing.hpp"

namespace musim::records {

/// Settings by which a record becomes the motion of a simulation's base. Defaults change as little as possible.
struct BaseMotionSettings {
    std::optional<TimeWindow> window = {};             ///< part of the record to use; all of it by default
    bool take_out_mean = false;                        ///< first; high-passed, an offset would ring
    std::optional<scaling::Frequency> high_pass = {};  ///< corner, of order 2 in each of two passes; none by default
    AtRest at_rest = AtRest::home;
    /// Corner with which the record's own velocity is integrated, GroundMotion::integration_corner
    std::optional<scaling::Frequency> integration_corner = {};
};

/// Taper of a record that is filtered [fraction of its length, each end]. Long enough that the filter does not ring from the ends, short
/// enough to leave the strong motion alone: PGV of the papers' Ridgecrest record moves by 0.5 % between 0.005 and 0.05.
inline constexpr double kDefaultTaper = 0.02;

/// The part of a record that a base is to make, as integrate_record() has it of the whole record: before any filter but that of an
/// uncorrected one, and before it was brought to rest. One that is used as given is seen from the base as it begins: its velocity counts
/// from its first one.
struct RecordedMotion {
    std::optional<TimeSeries> acceleration;  ///< nothing of a record of velocities or displacements
    TimeSeries velocity;
};

/// Motion of a base along an axis, or about one: of a rotation the velocity is the rate [rad/s], the displacement the angle [rad].
struct BaseMotion {
    TimeSeries velocity;             ///< linear between samples; the first is zero, and the last where the base ends at rest
    TimeSeries displacement;         ///< its exact integral from zero
    RecordedMotion record;           ///< on the same clock
    std::vector<std::string> steps;  ///< what was done, in words, for histories and reports
};

/// Filters, integrates and cuts one series to the velocity and displacement of a base.
///
/// The whole record is taken first: mean, taper and high-pass, integration from zero. A window is cut out of that velocity, so that the
/// record's own velocity at its start is known. Then the velocity is counted from its first value, and what keeps it from ending at rest is
/// taken out as the integral of an acceleration (detail::rest_correction): of a whole record α τ(1 − τ) + β τ(1 − τ)(1 − 2τ), which is zero
/// at both ends, as a record's own is; of a window α + β (1 − 2τ), the least in the mean square. τ goes from 0 to 1, β is zero for
/// AtRest::displaced. A velocity series is not integrated first; a displacement is differentiated. Angular accelerations, rates and angles
/// are treated alike. Throws ProcessingError as the single steps do, and for fewer than four samples.
BaseMotion make_base_motion(const TimeSeries& series, const BaseMotionSettings& settings = {});

/// The same for a component of a record. An uncorrected one is high-passed at its integration corner, its mean taken out before, unless
/// `settings` says otherwise.
/// Also throws ReadError for an unknown component.
BaseMotion make_base_motion(const GroundMotion& motion, std::string_view component, BaseMotionSettings settings = {});

}  // namespace musim::records
