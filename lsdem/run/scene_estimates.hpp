#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lsdem/run/motion_summary.hpp"
#include "lsdem/run/standing.hpp"
#include "lsdem/scene/scene.hpp"

namespace musim::lsdem {

/// A closed form of what a structure does, for orientation before it is run.
struct SceneEstimate {
    std::string key;                   ///< in JSON
    std::string title;                 ///< for people
    std::string text;                  ///< the value with its unit, or what happens
    std::optional<double> value = {};  ///< SI; nothing where the text alone says it
    std::string formula;               ///< from which it comes
};

/// Estimates of a scene whose first block is b x w x H, m its mass, k_n and k_s the stiffnesses of its face across H, μ its friction; p of
/// the thin side, for example, is √(3g/(4R)), R = √(b² + H²)/2:
///
///   rocking_thin, rocking_wide       tan α = b/H, w/H: a block begins to rock above so many g [-] [Housner63]
///   sliding                          μ: a block begins to slide above so many g [-]
///   overturning_x, overturning_y     d/h: the structure, or what stands above a level joint, overturns as one body along that axis above
///   so
///                                    many g [-]: of a column b/(N H), of a wall b/(N H) across it (find_overturning)
///   steady_x, steady_y               such an acceleration, held, that rigid statics just bears, where it is asked: see
///                                    find_steady_acceleration, the less of both senses [-]
///   first_motion_thin, _wide         what a block or the structure, whichever rocks first, does first under the larger horizontal PGA, if
///   it
///                                    shakes across that side of the first block [Shenton96]
///   frequency_parameter_thin, _wide  p [1/s] [Housner63]
///   contact_frequency                √(k_n/m)/(2π): a block on one face, up and down [Hz]
///
/// and, of N layers of a column, tower or wall, l = N H high,
///
///   shear_frequency                  (1/π) √(k_s/m) sin(π/(4N + 2)): the lowest of a chain of N blocks that stick and do not turn [Hz];
///                                    blocks that turn sway more slowly
///   vertical_frequency               the same with k_n [Hz]
///   elastic_speed                    c_e = H √(k_s/m) [m/s], at which sway climbs where joints stick
///   climb_stick, climb_slip          l/c_e, 2 l/c_e: from base to top where joints stick, and where they slip [s]
///   base_overlap                     N m g/(k_n H): overlap of the lowest faces under dead weight over H [-]
///
/// Source: scaling/structures. Nothing of spheres and without gravity. `upright`: see make_upright_specimen. Rigid statics is asked of
/// structures that can stand where they are drawn, of no more than kMostSteadyRays unknowns.
std::vector<SceneEstimate> estimate_scene(const Scene& scene, double friction, const Specimen& upright,
                                          const std::vector<MotionSummary>& motions, const SceneStanding& standing);

/// Least friction coefficient that a block of the first one's material can meet: on the ground and, where there are several levels or no
/// ground, on any other block; without the scatter of single joints [-].
double find_least_friction(const Model& model, int levels);

}  // namespace musim::lsdem
