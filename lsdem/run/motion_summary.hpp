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

/// Turn of the base about one axis while a run lasts: largest of a component of its rotation vector, of the rate and of its slope.
struct AxisTurn {
    char axis = 'x';
    double angle = 0.0, rate = 0.0, acceleration = 0.0;  ///< [rad, rad/s, rad/s²]
};

/// One motion of the base, and the run that it shakes.
struct MotionSummary {
    std::string name;                                    ///< of one of several motions; empty: the only one
    std::string source;                                  ///< "record CICLC.v1, ...", "synthetic signal along x", or "none, the base rests"
    std::vector<AxisMotion> axes = {};                   ///< that move
    std::vector<AxisTurn> turns = {};                    ///< about which it turns
    std::optional<scaling::Similitude> similitude = {};  ///< by which a prototype's record was made the model's
    BaseComponents base = {};
    TimePlan plan = {};

    bool rests() const { return axes.empty() && turns.empty(); }  ///< does the base?
};

/// Summary of the motion of a scene that has one. `base`: the ground's motion in the scene's model. Throws scaling::SimilitudeError,
/// records::ProcessingError.
MotionSummary summarize_motion(const Scene& scene, const std::string& name, const BaseComponents& base, const TimePlan& plan);

}  // namespace musim::lsdem
