#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lsdem/study/compare_runs.hpp"
#include "lsdem/study/simulate.hpp"
#include "scaling/distortion.hpp"
#include "scaling/similitude.hpp"

namespace musim::lsdem::study {

/// The folder of a model's results: its label, ':' written '-'.
std::string name_folder(std::string label);

/// Whether a model's material is the prototype's, scaled so that every group is equal, or its own measured one.
enum class Materials { exact, own };

/// "exact" or "own".
std::string to_string(Materials materials);

/// A run to be compared with its prototype's.
struct PairMember {
    std::string label;  ///< "1:107"; also names its folder, ':' written '-'
    Specimen specimen;
    TimePlan plan;                                      ///< with the prototype's sample counts
    scaling::Similitude similitude;                     ///< of this specimen to the prototype
    std::vector<scaling::Distortion> distortions = {};  ///< requirements the specimen does not meet
};

/// What one property of a model's own material does alone.
struct LoneDistortion {
    std::string property;  ///< "friction", "normal stiffness", "shear stiffness" or "restitution"
    double factor = 1.0;   ///< the property over what similitude asks for
    RunStatus status = RunStatus::completed;
    RunDifference difference;  ///< from the prototype, scaled back
};

/// A member after its run.
struct PairedRun {
    std::string label;
    scaling::Similitude similitude;
    std::vector<scaling::Distortion> distortions;
    RunResult run;
    RunDifference difference;                ///< from the prototype, scaled back
    bool consistent = false;                 ///< see is_consistent; always true of the shadow
    std::vector<LoneDistortion> alone = {};  ///< when asked for: each property that differs, in a model that is exact otherwise
};

/// A prototype, its shadow and its models.
struct PairStudy {
    Materials materials = Materials::exact;
    RunResult prototype;
    PairedRun shadow;
    std::vector<PairedRun> models;

    /// Every model agrees with the prototype as far as the yardstick allows. Models of their own material are not held to it.
    bool consistent() const;
    /// Some run diverged.
    bool diverged() const;
};

/// Below this rms difference [-] two runs agree whatever the shadow does: rounding that has grown for the whole of a run that only slides
/// stays a thousand times smaller. Dimensionless, hence the same at every scale. Raising it would let real differences pass.
inline constexpr double kRoundingLevel = 1e-9;

/// A run may lie this many times as far from the prototype as its shadow: both start from one rounding error per block, grow by the same
/// instability, and differ in which errors they make (contracts: 3).
inline constexpr double kShadowFactor = 3.0;

/// The yardstick: rms < kShadowFactor · rms of the shadow, or rms < kRoundingLevel.
bool is_consistent(const RunDifference& difference, const RunDifference& shadow);

/// Runs the prototype, its shadow and the models, side by side as far as the threads allow, and compares. Results do not depend on the
/// number of threads. `prototype.similitude` must be 1:1. Throws what Simulation throws.
PairStudy run_pair(const PairMember& prototype, const std::vector<PairMember>& models, Materials materials,
                   const RunSettings& settings = {});

}  // namespace musim::lsdem::study
