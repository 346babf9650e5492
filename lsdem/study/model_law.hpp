#pragma once

#include <optional>
#include <string>

#include "lsdem/study/base_shaking.hpp"

namespace musim::lsdem {

/// Source of the knowledge by which law a model is shaken.
enum class LawSource {
    chosen,    ///< asked for, or the default of its materials
    scene,     ///< named by the model's scene for its record
    measured,  ///< found from the motion of its base beside the prototype's
    assumed    ///< nothing says it
};

/// By which law a model is shaken; the law's name and factors are in its similitude, the name being kNoLaw for a base that moves by none
/// of those that are looked for.
struct ModelLaw {
    LawSource source = LawSource::chosen;
    std::string why = {};                     ///< of an assumed law: why nothing says it; one clause
    std::optional<BaseShaking> shaking = {};  ///< of a scene: the factors between the motions of both bases, where one is the other's
};
inline constexpr const char* kNoLaw = "none";

}  // namespace musim::lsdem
