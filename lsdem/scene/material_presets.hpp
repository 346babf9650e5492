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

/// Time step that the papers took for a material: the period of the camera that filmed its tests over a whole number, 1/4800 s over 20 for
/// wood and over 80 for aluminium, 1/2000 s over 34 for concrete [Harmon23, Table 4]. For the reference block only; wood's is above its
/// critical one.
struct CameraStep {
    scaling::Time value{};
    std::string_view fraction;  ///< the same as text, "1/96000 s"
};

/// Material of the papers, or a stone as textbooks have it.
struct MaterialPreset : MeasuredMaterial {
    std::optional<double> length_scale;  ///< of the tower whose block it is: 1/107 or 1/25 [-]; nothing for a stone
    std::string_view source;
    std::optional<CameraStep> camera_step;            ///< of a material of the papers
    std::optional<scaling::Velocity> bar_wave_speed;  ///< √(E/ρ) where E is known from elsewhere

    /// Whether stiffnesses are those of a solid of known elasticity, k_n = E·A/H and k_s = G·A/H in whatever block.
    bool is_stone() const { return !length_scale; }
};

/// Preset called `name`: "wood" and "concrete" as printed, "aluminium" with the stiffnesses that its wave speed asks for (also
/// "al_wave"), "al_printed" with the printed ones; "granite", "limestone" and "marble" for sound stone with dry, flat, sawn faces, see
/// docs/theory/calibration.md. Throws SceneError with the known names for any other.
const MaterialPreset& find_material_preset(std::string_view name);

/// The names that find_material_preset knows.
std::vector<std::string> material_preset_names();

/// The same solid in a block of another size:  k = k_ref·(A/H)/(A_ref/H_ref),  because E_eff = k·H/A is the solid's (bar wave speed
/// c = H·√(k/m)). At the reference block this is the preset itself, to rounding.
BlockMaterial fit_to_block(const MeasuredMaterial& measured, const Triple<scaling::Length>& block);

}  // namespace musim::lsdem
