#pragma once

#include <optional>

#include "lsdem/run/prepare.hpp"
#include "lsdem/run/simulate.hpp"
#include "lsdem/scene/scene.hpp"

namespace musim::lsdem {

/// The kernel's model of a scene as it is drawn, with its spine and layers: blocks of unequal height stand upright, without touching deeper
/// than contact. Throws SceneError, records::ReadError, records::ProcessingError.
Specimen make_upright_specimen(const Scene& scene);

/// Does the specimen of a scene come to rest before it runs? Unless the scene asks for none, or lists single blocks of one height and says
/// nothing: these begin as they are listed.
bool wants_preparation(const Scene& scene, const Specimen& upright);

/// Do all blocks stand still when it begins?
bool starts_at_rest(const Specimen& specimen);

/// Is the specimen of a scene put in equilibrium where it is drawn, if it stands there? Blocks that are prepared as drawn; and single ones
/// that are listed at rest on a base that moves, without a word on their preparation.
bool seeks_equilibrium(const Scene& scene, const Specimen& upright);

/// Preparation of the specimen of a scene: as the scene says, else layer by layer when blocks differ in height, else as drawn.
/// Velocities decay at the scene's rate, else at that of choose_damping_rate for the first block.
PreparationSettings find_preparation(const Scene& scene, const Specimen& upright);

/// The specimen of a scene in its places and at rest there, when it is to be prepared: placed as drawn, as a file has it, on resting
/// planes, or layer by layer; single blocks see seeks_equilibrium. The preparation runs with `settings`; it is not done again, or from
/// where it was, when a checkpoint says so. Throws as make_upright_specimen and prepare do.
Specimen make_specimen(const Scene& scene, const RunSettings& settings = {}, const Checkpoint* from = nullptr);

/// The settings of a run whose checkpoints hold where the blocks of its specimen are, when it was prepared.
RunSettings keep_places(RunSettings settings, const Specimen& specimen);

/// A specimen before it runs.
struct LaidSpecimen {
    Specimen specimen;              ///< without settling: its runs start as it is
    std::optional<Rest> rest = {};  ///< how it came to rest; nothing when it was not to
};

/// Lays the specimen of a scene and lets it come to rest, when the scene asks for that. To let every image of it come to rest again would
/// be a choice on rounding: they start from it unchanged. With settings.checkpoint it is kept in that file once it is laid, and found there
/// again, or laid on from where it was. Throws as make_specimen and read_checkpoint do.
LaidSpecimen lay_specimen(const Scene& scene, RunSettings settings = {});

/// Lets a specimen of a scene come to rest at the step of its run, when it is to settle, or carries that on, and puts it there; how it did.
/// Throws SceneError for one that has collapsed meanwhile (Rest::collapsed): nothing can be compared with it.
std::optional<Rest> let_settle(const Scene& scene, Specimen& specimen, const RunSettings& settings, const Checkpoint* from = nullptr);

/// Choice of an automatic step when the spine's rate asks for more than one sample a step: every step is a sample; or steps are shortened,
/// so that runs with steps of their own are sampled at the same times.
enum class Sampling { every_step, at_rate };

/// Steps, samples and frames of a scene's run. The spine's rate decides when samples are taken, not how long the run is.
///
/// Samples are 1/rate apart, or so much closer that the duration is a whole number of them. "step": "auto" takes at most
/// safety·compute_critical_time_step(model), shortened until the time between samples is a whole number of steps. A step given in the scene
/// is kept: the run has as many as the duration holds, rounded, one at least; up to as many of them as the rate asks for, no fewer than
/// half, make a sample, such that as few as can be, mostly none, are left over and not run.
/// Throws SceneError for more steps or samples than can be counted and kept.
TimePlan make_time_plan(const Scene& scene, const Model& model, Sampling sampling = Sampling::every_step);

/// The same with a given time step [s].
TimePlan make_time_plan(const Scene& scene, double time_step);

/// Runs a scene. Throws as make_specimen does, and SceneError for one with a list of motions.
RunResult run_scene(const Scene& scene, const RunSettings& settings = {});

/// Runs the specimen that make_specimen made of a scene, or carries its run on from a checkpoint. Throws as simulate and resume do.
RunResult run_specimen(const Scene& scene, const Specimen& specimen, std::optional<Checkpoint> from = {}, const RunSettings& settings = {});

/// Runs the model of a prototype (scale_scene); the result has the similitude. Throws as scale_scene, check_scene and run_scene do.
RunResult run_model(const Scene& prototype, const scaling::Similitude& similitude, const RunSettings& settings = {});

/// Carries on the run of a scene from a checkpoint, see resume(). The scene is the checkpoint's own; a record that it names is read again.
/// Throws std::runtime_error also when the record has changed: the model is then another one.
RunResult resume_scene(const Scene& scene, Checkpoint checkpoint, const RunSettings& settings = {});

}  // namespace musim::lsdem
