#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "lsdem/model.hpp"
#include "lsdem/results/time_plan.hpp"
#include "lsdem/run/run.hpp"
#include "lsdem/run/settle.hpp"
#include "lsdem/run/simulate.hpp"
#include "lsdem/scene/scene.hpp"

namespace musim::lsdem {

/// One motion of a sequence.
struct SequenceStage {
    std::string name;       ///< for people
    std::string folder;     ///< of its results: stage-01-NAME
    bool settle = true;     ///< the structure comes to rest before it
    Scene scene;            ///< the scene with this motion alone
    BaseComponents motion;  ///< of the base
    TimePlan plan;          ///< of the same time step in all stages
};

/// Several motions that shake one specimen one after another.
struct SequencePlan {
    Specimen specimen;  ///< as drawn, not prepared yet (make_specimen of the first stage's scene); its model has the first motion
    Settling settling;  ///< how it comes to rest between motions
    std::vector<SequenceStage> stages;
};

/// Velocity by which the base may jump where one motion follows another without a rest phase, over the larger of their peak velocities
/// [-]. Formulas that end at rest do so to 1e-16; a jump of a millionth is far below what sampling a formula costs (1e-4,
/// docs/user/scenes.md).
inline constexpr double kSeamlessVelocity = 1e-6;

/// Plans the motions of a scene (expand_motions). Between two motions the structure comes to rest at the damping rate of
/// find_preparation.
///
/// Throws SceneError for a scene without a list of motions; for a motion without a rest phase before it that does not begin with the
/// velocity that the one before it ends with; for a base that keeps a velocity it took in a jump, before a rest phase, since nothing says
/// how it stops. Else as make_upright_specimen does.
SequencePlan plan_sequence(const Scene& scene, Sampling sampling = Sampling::every_step);

/// Motion in which the base comes to rest from `velocity` [m/s] before a rest phase: at the largest acceleration of the motion it ends, no
/// harder than the motion itself. Requires that the motion has an acceleration.
BaseComponents make_stop(const BaseComponents& motion, const Vector3& velocity);

}  // namespace musim::lsdem
