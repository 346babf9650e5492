#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "lsdem/run/equilibrium.hpp"
#include "lsdem/run/simulate.hpp"
#include "lsdem/scene/scene.hpp"
#include "lsdem/statics/rigid_statics.hpp"

namespace musim::lsdem {

/// Where the blocks of a scene are when its motion begins, as far as it is known before the scene is run.
struct SceneStanding {
    enum class Begins {
        in_equilibrium,      ///< where they are drawn
        out_of_equilibrium,  ///< there they do not rest: a preparation moves them, without one they start to move with the motion
        when_laid,           ///< found when they are laid
        from_specimen,       ///< as they were in its file
        as_listed            ///< weight begins to act when the motion does
    };
    Begins begins = Begins::as_listed;
    std::optional<Equilibrium> equilibrium;  ///< sought where they are drawn
    std::optional<RigidStatics> statics;     ///< asked of blocks at rest that are not in equilibrium where they are drawn
    BlockTable blocks = {};                  ///< names of listed blocks
};

/// Looks for equilibrium where make_specimen does, so that both find the same; asks rigid statics where there is none. `upright`: see
/// make_upright_specimen. Throws as compute_time_step does.
SceneStanding find_standing(const Scene& scene, const Specimen& upright);

/// One line for people, which calls blocks as `blocks` does.
std::string describe(const RigidStatics& statics, const BlockTable& blocks = {});

/// "in_equilibrium", "out_of_equilibrium", "when_laid", "from_specimen", "as_listed".
std::string to_string(SceneStanding::Begins begins);

/// One JSON object in SI units: `begins`, `equilibrium` and `statics`, null where they were not sought.
nlohmann::json to_json(const SceneStanding& standing);

}  // namespace musim::lsdem
