#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scaling/units.hpp"

namespace musim::lsdem {

/// Three components along x, y, z, or edge lengths (thin b, wide w, height H).
template <class Quantity>
using Triple = std::array<Quantity, 3>;

/// A block's material with its contact properties.
///
/// The stiffnesses are those of a whole face of one block, the one across its z axis, as in Table 3 of [Harmon23]; the kernel gets
/// K = k/A [Pa/m], A being the base of the structure's block (reference_area).
struct BlockMaterial {
    scaling::Density density{};
    scaling::Stiffness normal_stiffness{};  ///< k_n of a whole face
    scaling::Stiffness shear_stiffness{};   ///< k_s of a whole face
    double friction = 0.0;                  ///< Coulomb coefficient μ [-]
    double restitution = 0.0;               ///< normal coefficient of restitution e, in (0, 1] [-]
    double shear_damping_ratio = 0.0;       ///< ζ_s of the optional tangential dashpot, 0 in the papers [-]

    bool operator==(const BlockMaterial&) const = default;
};

/// A measured material and the block it was measured for.
struct MeasuredMaterial {
    std::string name;
    BlockMaterial material;
    Triple<scaling::Length> reference_block{};  ///< b, w, H that the stiffnesses belong to
};

/// One of the papers.
struct MaterialPreset : MeasuredMaterial {
    double length_scale = 1.0;  ///< of the tower whose block it is: 1/107 or 1/25 [-]
    std::string_view source;
    /// Period of the camera that filmed the tests over a whole number, which the papers took as time step: 1/4800 s over 20 for wood and
    /// over 80 for aluminium, 1/2000 s over 34 for concrete [Harmon23, Table 4]. For the reference block only; wood's is above its critical
    /// one.
    scaling::Time camera_step{};
    std::string_view camera_step_fraction;            ///< the same as text, "1/96000 s"
    std::optional<scaling::Velocity> bar_wave_speed;  ///< √(E/ρ) where E is known from elsewhere
};

/// The preset called `name`: "wood" and "concrete" as printed, "aluminium" with the stiffnesses that its wave speed asks for (also
/// "al_wave"), "al_printed" with the printed ones. Throws SceneError with the known names for any other.
const MaterialPreset& find_material_preset(std::string_view name);

/// The names that find_material_preset knows.
std::vector<std::string> material_preset_names();

/// The same solid in a block of another size:  k = k_ref·(A/H)/(A_ref/H_ref),  because E_eff = k·H/A is the solid's (bar wave speed
/// c = H·√(k/m)). At the reference block this is the preset itself, to rounding.
BlockMaterial fit_to_block(const MeasuredMaterial& measured, const Triple<scaling::Length>& block);

}  // namespace musim::lsdem
