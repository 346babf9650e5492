#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/results/base_change.hpp"
#include "lsdem/results/time_plan.hpp"
#include "lsdem/scene/scene.hpp"
#include "scaling/laws/similitude.hpp"

namespace musim::lsdem {

/// Motion of the base along one axis while a run lasts.
struct AxisMotion {
    char axis = 'x';
    double pga = 0.0, pgv = 0.0, pgd = 0.0;         ///< of the base [m/s², m/s, m]; velocity and displacement at its samples
    std::optional<BaseChange> change = {};          ///< against the record or formula
    std::optional<double> predominant_period = {};  ///< of the largest PSA at 5 % damping, from 4 samples to half the motion [s]
};

/// One motion of the base, and the run that it shakes.
struct MotionSummary {
    std::string name;                                    ///< of one of several motions; empty: the only one
    std::string source;                                  ///< "record CICLC.v1, ...", "synthetic signal along x", or "none, the base rests"
    std::vector<AxisMotion> axes = {};                   ///< that move
    std::optional<scaling::Similitude> similitude = {};  ///< by which a prototype's record was made the model's
    BaseComponents base = {};
    TimePlan plan = {};
};

/// Summary of the motion of a scene that has one. `base`: the ground's motion in the scene's model. Throws scaling::SimilitudeError,
/// records::ProcessingError.
MotionSummary summarize_motion(const Scene& scene, const std::string& name, const BaseComponents& base, const TimePlan& plan);

}  // namespace musim::lsdem
