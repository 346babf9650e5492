#pragma once

/// Everything of `musim::lsdem` that a program needs: scenes, their models at other scales, runs and their results.
#include "lsdem/results/level_motion.hpp"
#include "lsdem/results/read_results.hpp"
#include "lsdem/results/write_results.hpp"
#include "lsdem/run/run.hpp"
#include "lsdem/scene/scale_scene.hpp"
#include "lsdem/scene/scene_json.hpp"
