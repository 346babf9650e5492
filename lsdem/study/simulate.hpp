#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "lsdem/model.hpp"
#include "lsdem/study/checkpoint.hpp"
#include "lsdem/study/history.hpp"
#include "lsdem/study/settle.hpp"
#include "lsdem/study/time_plan.hpp"

namespace musim::lsdem::study {

/// A model with the places in it that results speak of.
struct Specimen {
    Model model;
    Spine spine;
    std::vector<int> layer;            ///< of every block, from 1 at the base; 0: in no layer
    std::optional<Settling> settling;  ///< how it comes to rest before t = 0; nothing: it starts as it is
};

/// How to carry out a run; none of it changes the results.
struct RunSettings {
    int threads = 1;                                    ///< 0: all cores
    std::function<void(double)> on_progress = {};       ///< called now and then with the fraction done, 0 to 1, from the thread that runs
    std::optional<CheckpointSettings> checkpoint = {};  ///< none: a run that is killed is lost
};

/// A structure has collapsed when this fraction of its blocks has fallen (Simulation::fallen_fraction). One in twenty: a few blocks may
/// leave the free edges of a tower that stands; with fewer than 20 blocks it means any one of them. Changes the label only.
inline constexpr double kCollapsedFraction = 0.05;

/// Lets a specimen come to rest, when it asks for that, and runs it to the end of its plan, or until it diverges. Time, ledger and
/// rotations count from rest. Throws std::invalid_argument as Simulation does.
RunResult simulate(const Specimen& specimen, const TimePlan& plan, const RunSettings& settings = {});

/// Carries a run on from a checkpoint to the end of its plan; all results but the wall time, which adds up, are the bits of a run without
/// interruption, with any number of threads. Throws std::runtime_error when the checkpoint is of another specimen.
RunResult resume(const Specimen& specimen, Checkpoint checkpoint, const RunSettings& settings = {});

/// The specimen for a shadow run: of every block, the coordinate of largest magnitude moved up by one unit in its last place. The largest,
/// because at a coordinate of zero that unit would be the smallest double and change nothing.
Specimen make_shadow(Specimen specimen);

}  // namespace musim::lsdem::study
