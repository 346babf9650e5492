#pragma once

/// Everything of `musim::lsdem` that a program needs: scenes, their models at other scales, runs and their results.
#include "lsdem/results/level_motion.hpp"
#include "lsdem/results/read_results.hpp"
#include "lsdem/results/write_results.hpp"
#include "lsdem/run/run.hpp"
#include "lsdem/scene/scale_scene.hpp"
#include "lsdem/scene/scene_json.hpp"

namespace musim::lsdem {

using scene::BlockList;
using scene::BlockMaterial;
using scene::Column;
using scene::find_material_preset;
using scene::find_tiling_preset;
using scene::fit_to_block;
using scene::read_scene;
using scene::RecordMotion;
using scene::scale_scene;
using scene::Scene;
using scene::SceneError;
using scene::SignalMotion;
using scene::Tower;
using scene::Triple;
using scene::Wall;
using scene::write_scene;
using study::LevelSample;
using study::measure_level;
using study::measure_top;
using study::read_run;
using study::ResultError;
using study::ResultFolder;
using study::run_model;
using study::run_scene;
using study::RunResult;
using study::RunSettings;
using study::StoredRun;

}  // namespace musim::lsdem
