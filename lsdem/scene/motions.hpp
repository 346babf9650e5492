#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lsdem/scene/scene.hpp"

/// Scenes whose structure is shaken by several motions one after another.
namespace musim::lsdem {

/// One shaking of such a scene.
struct StageScene {
    std::string name;       ///< the entry's, or that of its record or signal
    std::size_t entry = 0;  ///< of Scene::motions
    bool settle = true;     ///< the structure comes to rest before it
    Scene scene;            ///< the scene with this motion alone; its duration is the motion's own length when none is given
};

/// The shakings of a scene in their order, repetitions one by one; none for a scene without a list of motions. Throws as
/// make_base_components does, and SceneError for a motion without a length that is to give the duration.
std::vector<StageScene> expand_motions(const Scene& scene);

/// One line for each motion of a scene that still moves the base when its run ends, by more than a sample: how long it lasts, and where it
/// is cut. Throws as make_base_components does.
std::vector<std::string> describe_cut_motions(const Scene& scene);

/// Throws SceneError for a scene with a list of motions, where only one can be used. `what` cannot: "a pair".
void require_single_motion(const Scene& scene, const std::string& what);

}  // namespace musim::lsdem
