#pragma once

#include <string_view>

#include "lsdem/scene/scene.hpp"

namespace musim::lsdem {

/// Small prototypes that show whether a law of similitude holds.
enum class BenchScene {
    slide,   ///< a lying block, rotation locked, pushed by a half-sine: slips once
    rock,    ///< a slender block on a stiff base, pushed by a half-sine: rocks
    column,  ///< five blocks under two cycles of sine: rock and slip on each other
    chain,   ///< five blocks that neither slip nor turn, on a base that starts at once: shear waves
};

/// "slide", "rock", "column" or "chain".
std::string_view to_string(BenchScene scene);

/// The prototype: concrete of the papers, base motion along x.
Scene make_bench_scene(BenchScene scene);

/// The groups of the prototypes, for their closed forms [-].
inline constexpr double kSlideStrength = 3.0;     ///< A/(μg)
inline constexpr double kRockStrength = 1.9;      ///< A/(g·tan α)
inline constexpr double kRockRate = 4.0;          ///< π/(T·p)
inline constexpr double kRockSlenderness = 0.05;  ///< tan α
inline constexpr double kChainDamping = 0.1;      ///< ζ_s of its joints
inline constexpr double kChainSafety = 0.02;      ///< time step over the critical one
inline constexpr double kChainSamples = 100.0;    ///< of its output in a half wave of its lowest mode, at least

/// ω·T of the sliding block: ω² = k_s/m of its friction spring, T of its push [-].
double slide_rigidity();
/// Depth by which the rocking block sinks under its weight, over its thin side, m g/(k_n b) [-].
double rock_sinking();

}  // namespace musim::lsdem
