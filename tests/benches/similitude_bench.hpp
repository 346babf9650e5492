#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/benches/similitude_cases.hpp"

namespace musim::lsdem {

/// Response of a run in the prototype's units: times over λ_t, lengths over λ_l, velocities over λ_v, angles over λ_θ.
struct ScaledResponse {
    std::vector<double> time;   ///< since the base began to move [s]
    std::vector<double> value;  ///< how far the highest block of the spine is behind the base [m]; of `rock` its tilt [rad]
    std::vector<double> speed;  ///< of that block behind the base [m/s]
};

/// √(Σ(x_M − x_P)²/Σ x_P²) of the value or of the speed, whichever is greater [-]. Throws std::invalid_argument unless both have as many
/// samples.
double compare_responses(const ScaledResponse& prototype, const ScaledResponse& model);

/// The measure of a response, from the parabola through its greatest sample and the two beside it.
double measure(const ScaledResponse& response, Measure which);

/// Result of a case.
struct SimilitudeOutcome {
    SimilitudeCase wanted;
    double ratio = 0.0;       ///< measured, model over prototype
    double difference = 0.0;  ///< of the curves, compare_responses
    double yardstick = 0.0;   ///< up to which two curves are one: three times the copy's, kRoundingLevel at least
    bool diverged = false;
    ScaledResponse prototype, model;

    /// Equal groups: one curve. Else: the ratio as predicted, and two curves where that is not 1.
    bool holds() const;
};

bool all_hold(const std::vector<SimilitudeOutcome>& outcomes);

/// Runs every prototype, its copy with its blocks moved by a last place, and every model. `threads`
/// runs side by side (0: all cores), each on one thread; results do not depend on it.
std::vector<SimilitudeOutcome> run_similitude_cases(const std::vector<SimilitudeCase>& cases, int threads = 0,
                                                    const std::function<void(double)>& on_progress = {});

/// One line per case: law, scene, length (of widths), friction, gravity, density, acceleration, heights (over widths), broken, factor,
/// measure, predicted, tolerance, measured, difference, yardstick, holds. Numbers are the shortest text that reads back the same.
std::string make_similitude_csv(const std::vector<SimilitudeOutcome>& outcomes);

}  // namespace musim::lsdem
