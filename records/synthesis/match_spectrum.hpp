#pragma once

#include <string_view>
#include <vector>

#include "records/ground_motion.hpp"

namespace musim::records {

/// Pseudo-spectral acceleration that a motion should have.
struct TargetSpectrum {
    double damping = 0.05;                   ///< ζ, fraction of critical, 0 to below 1
    std::vector<scaling::Time> period;       ///< rising; at least four steps of the record, at most its length
    std::vector<scaling::Acceleration> psa;  ///< one for each period
};

/// When a motion counts as matched.
struct SpectrumMatchSettings {
    double tolerance = 0.05;    ///< largest |ln(PSA/target)| over all periods
    int most_iterations = 200;  ///< trials of a set of wavelets; a real record to a smooth target took 5 to 15
};

/// Distance of a spectrum from its target: |ln(PSA/target)|.
struct SpectrumMisfit {
    double largest = 0.0;
    double mean = 0.0;              ///< over the periods
    scaling::Time largest_at = {};  ///< period of the largest
};

/// A motion matched to a target.
struct SpectrumMatch {
    TimeSeries acceleration;
    double factor = 1.0;  ///< that the whole record was multiplied by before
    SpectrumMisfit before, after;
    int iterations = 0;
};

/// Changes an acceleration so that its spectrum is the target at all its periods, in the time domain [AlAtikAbrahamson10].
///
/// A motion within the tolerance stays as it is. Otherwise it is multiplied by the geometric mean of target/PSA, and then tapered cosine
/// wavelets, placed at the large swings of each period's oscillator, are added again and again, their amplitudes by damped least squares
/// (docs/theory/records.md, "Matching a spectrum"). What is added ends at rest where it began, so final velocity and displacement stay
/// those of the multiplied record. A motion and target scaled by powers of two give the scaled motion to the last bit. Throws
/// ProcessingError when the tolerance is not reached, with the misfit that was, for another quantity, a motion without motion, and targets
/// that are unusable.
SpectrumMatch match_spectrum(const TimeSeries& acceleration, const TargetSpectrum& target, const SpectrumMatchSettings& settings = {});

/// A record with one component alone, matched; the history records how.
struct MatchedRecord {
    GroundMotion motion;
    SpectrumMatch match;
};

/// The same for a component of a record; an uncorrected one is taken above its initial level. Also throws ReadError for an unknown
/// component.
MatchedRecord match_spectrum(const GroundMotion& motion, std::string_view component, const TargetSpectrum& target,
                             const SpectrumMatchSettings& settings = {});

}  // namespace musim::records
