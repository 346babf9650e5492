#pragma once

#include "lsdem/scene/scene.hpp"
#include "lsdem/study/simulate.hpp"

namespace musim::lsdem::study {

/// The kernel's model of a scene, with its spine and layers. Throws scene::SceneError, records::ReadError, records::ProcessingError.
Specimen make_specimen(const scene::Scene& scene);

/// Steps, samples and frames of a scene's run.
///
/// "step": "auto" takes at most safety·compute_critical_time_step(model), shortened until a sampling interval of the spine is a whole
/// number of steps. A step given in the scene is kept; the interval becomes the nearest multiple. The duration is rounded to whole samples,
/// one at least.
TimePlan make_time_plan(const scene::Scene& scene, const Model& model);

/// Runs a scene.
RunResult run_scene(const scene::Scene& scene, const RunSettings& settings = {});

}  // namespace musim::lsdem::study
