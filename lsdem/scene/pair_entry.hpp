#pragma once

#include <array>
#include <optional>
#include <string>

#include "scaling/units.hpp"

namespace musim::lsdem {

/// Names of the scene's own material, and of the plane, in a pair of materials.
inline constexpr const char* kOwnMaterialName = "material";
inline constexpr const char* kGroundName = "ground";

/// Joint of blocks of two materials, or of one and the ground, where it does not follow from the two (combine()).
struct PairEntry {
    std::array<std::string, 2> of;                       ///< keys of Scene::materials, kOwnMaterialName, kGroundName
    std::optional<scaling::Stiffness> normal_stiffness;  ///< k_n of the interface over the base of the structure's block
    std::optional<scaling::Stiffness> shear_stiffness;   ///< k_s likewise
    std::optional<double> friction;                      ///< Coulomb coefficient μ [-]
    std::optional<double> restitution;                   ///< in (0, 1] [-]
    std::optional<double> shear_damping_ratio;           ///< ζ_s [-]

    bool operator==(const PairEntry&) const = default;
};

}  // namespace musim::lsdem
