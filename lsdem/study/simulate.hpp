#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "lsdem/model.hpp"
#include "lsdem/study/history.hpp"

namespace musim::lsdem::study {

/// When a run steps, samples and ends. Counts, so that similar runs do exactly the same steps.
struct TimePlan {
    double time_step = 0.0;  ///< [s]
    std::uint64_t steps_per_sample = 1;
    std::uint64_t samples = 0;            ///< after the one at t = 0
    std::uint64_t samples_per_frame = 0;  ///< 0: no frames

    std::uint64_t steps() const { return steps_per_sample * samples; }
    double duration() const { return static_cast<double>(steps()) * time_step; }  ///< [s]

    /// The plan of a similar run: the same counts, the time step multiplied by λ_t.
    TimePlan scaled(double time_factor) const;
};

/// A model with the places in it that results speak of.
struct Specimen {
    Model model;
    Spine spine;
    std::vector<int> layer;  ///< of every block, from 1 at the base; 0: in no layer
};

/// How to carry out a run; none of it changes the results.
struct RunSettings {
    int threads = 1;                               ///< 0: all cores
    std::function<void(double)> on_progress = {};  ///< called now and then with the fraction done, 0 to 1, from the thread that runs
};

/// A structure has collapsed when this fraction of its blocks has fallen (Simulation::fallen_fraction). One in twenty: a few blocks may
/// leave the free edges of a tower that stands; with fewer than 20 blocks it means any one of them. Changes the label only.
inline constexpr double kCollapsedFraction = 0.05;

/// Runs a specimen to the end of its plan, or until it diverges. Throws std::invalid_argument as Simulation does.
RunResult simulate(const Specimen& specimen, const TimePlan& plan, const RunSettings& settings = {});

/// The specimen for a shadow run: of every block, the coordinate of largest magnitude moved up by one unit in its last place. The largest,
/// because at a coordinate of zero that unit would be the smallest double and change nothing.
Specimen make_shadow(Specimen specimen);

}  // namespace musim::lsdem::study
