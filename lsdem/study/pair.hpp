#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/run/simulate.hpp"
#include "lsdem/study/compare_runs.hpp"
#include "lsdem/study/pair_member.hpp"
#include "lsdem/study/twin_growth.hpp"
#include "lsdem/study/verdict.hpp"
#include "scaling/laws/similitude.hpp"
#include "scaling/structures/distortion.hpp"

namespace musim::lsdem {

/// Effect of one property of a model's own material alone.
struct LoneDistortion {
    std::string property;  ///< "friction", "normal stiffness", "shear stiffness" or "restitution"
    double factor = 1.0;   ///< the property over what similitude asks for
    RunStatus status = RunStatus::completed;
    RunDifference difference;  ///< from the prototype, scaled back
};

/// A member after its run.
struct PairedRun {
    std::string label;
    std::vector<scaling::Distortion> distortions;
    RunResult run;             ///< with its similitude
    RunDifference difference;  ///< from the prototype, scaled back
    RunTrace trace = {};
    Judgement judgement = {};                ///< against the twins
    std::string material = {};               ///< of a model of its own material: its name
    bool is_image = false;                   ///< it started from the prototype's specimen, not from one laid anew
    ModelLaw law = {};                       ///< by which it is shaken
    std::vector<std::string> asked = {};     ///< of its distortions, the groups that its law asks to be kept
    std::vector<LoneDistortion> alone = {};  ///< when asked for: each property that differs, in a model that is exact otherwise
    Materials materials = Materials::exact;
    std::optional<SecondScene> scene = {};  ///< of a model that is a scene of its own

    /// As sentences call it: its scale, or its file.
    const std::string& name() const { return scene ? scene->file : label; }
};

/// A twin after its run.
struct PairedTwin {
    TwinChoice choice;
    RunStatus status = RunStatus::completed;
    RunDifference difference;
};

/// Settings by which models are judged.
struct PairSettings {
    std::optional<std::size_t> twins = {};  ///< nothing: none when models agree within rounding, else as many as decide, 2 to kMostTwins
    std::uint64_t seed = 1;                 ///< of the twins
    bool half_step = true;                  ///< run the prototype at half its step, too
    /// Given, before progress, the part of all runs at the end that may not be needed: twins, where as many run as decide.
    std::function<void(double)> on_spare = {};
};
inline constexpr std::size_t kFewestTwins = 2, kMostTwins = 8;

/// A run at half the step has twice the steps.
inline constexpr double kHalfStepWork = 2.0;

/// The most that a pair of so many models runs, in runs of its prototype.
std::size_t count_runs(std::size_t models, const PairSettings& judging);

/// A prototype, its twins and its models.
struct PairStudy {
    RunResult prototype = {};
    std::vector<PairedTwin> twins = {};
    std::vector<RunTrace> twin_traces = {};  ///< in the order of the twins
    /// Spread of the twins for every sample and spine block, as History has them: the largest |v_twin/λ_v − v_P| of each component [m/s].
    std::vector<Vector3> twin_spread = {};
    std::optional<bool> same_bits = {};       ///< does the image at a quarter of the length agree in every bit? nothing: not run
    std::optional<PairedRun> half_step = {};  ///< the prototype at half its step
    std::vector<PairedRun> models = {};
    std::vector<RunTrace> specimen_traces = {};  ///< of other specimens of the prototype, for own models (run_other_specimens)
    std::optional<double> tolerance = {};        ///< by which a model may differ to be accepted, see judge_own [-]

    Yardstick yardstick() const { return {prototype, twin_traces}; }
    /// Agreement of the scaling itself: the image at a quarter of the length must agree in all bits, and images must not part earlier than
    /// copies.
    Agreement scaling() const;
    /// Are there models of this kind?
    bool has(Materials materials) const;
    /// Agreement of scaling and models together. Models of their own are not judged.
    Agreement agreement() const;
    /// The scaling agrees, and every model that is not one of its own.
    bool consistent() const;
    /// Some run diverged.
    bool diverged() const;
};

/// Twins to judge by: in turn images at lengths 4^u that are no powers of four (choose_models), and copies moved by a unit in the last
/// place; the first ones are the same whatever their number.
std::vector<TwinChoice> choose_twins(std::size_t twins, std::uint64_t seed);

/// Runs the prototype and the models, side by side as far as the threads allow, then twins of the prototype as far as the judgement asks
/// for them, and judges. Specimens start as they are handed over, unless they are to settle. Results do not depend on the number of
/// threads. With settings.checkpoint its file is a folder, in which every run keeps its own (run_member). `prototype.similitude` must be
/// 1:1. Throws what Simulation throws.
PairStudy run_pair(const PairMember& prototype, const std::vector<PairMember>& models, const RunSettings& settings = {},
                   const PairSettings& judging = {});

}  // namespace musim::lsdem
