#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/model.hpp"

/// Can a structure of rigid blocks stand? See docs/theory/rigid_statics.md.
namespace musim::lsdem {

/// Gap up to which rigid blocks count as touching, over the smaller height of the two: a power of two, above what coordinates of four
/// digits leave open and below differences in height that one would measure [-].
inline constexpr double kRigidGap = 0x1p-12;

/// Directions in which friction may act in a joint: the corners of a polygon inside Coulomb's circle, smaller by 2 % where it is least.
inline constexpr std::size_t kFrictionDirections = 16;

/// Force and moment that a block would need from outside to stand as drawn.
struct BlockHelp {
    std::size_t block = 0;
    double force = 0.0;  ///< over its weight [-]
    /// The moment over its weight: by so much its weight acts beside what could bear it [m].
    double arm = 0.0;
    bool touches = true;  ///< does anything touch the block?
};

/// Findings of rigid statics about a structure under its own weight.
struct RigidStatics {
    enum class Answer {
        not_asked,     ///< see `why`
        can_stand,     ///< forces were found that bear every block
        undecided,     ///< there are none inside a polygon in Coulomb's circle, but some inside one around it; or see `why`
        cannot_stand,  ///< there are none
    };
    Answer answer = Answer::not_asked;
    std::string why = {};    ///< it was not asked, or is undecided for another reason than the polygon
    std::size_t joints = 0;  ///< that bear
    double residual = 0.0;   ///< largest force that is left on a block over its weight, or moment over that and half its diagonal [-]
    /// Blocks that cannot stand, the one that needs the most help first: each for itself, whatever the others do; or, where each could, the
    /// least help that the structure needs in all, in which others may take the place of these.
    std::vector<BlockHelp> needs = {};
    bool each_alone = false;  ///< the former
};

/// Asks whether forces exist in the joints (find_rigid_joints) of a structure that bear all loose blocks under gravity:
///
///   N ≥ 0, |T| ≤ μ N at the corners of all joints,    Σ f + m g = 0,  Σ (x − c) × f = 0 of every block
///
/// the static theorem [Drucker54] [GilbertMelbourne94], a linear program for T inside a polygon (kFrictionDirections); fixed blocks and the
/// ground bear anything. Forces that exist show that the structure can stand, not that it does: friction is not associated. Forces count in
/// weights of the block, moments in these times half its diagonal: an answer holds at every scale. The program's answer is inserted in the
/// equations, which must hold to 1e-6. Not asked of round blocks, without gravity, of more than kMostRays
/// unknowns, or where musim was built without CLP. Blocks are taken where the model has them.
RigidStatics ask_rigid_statics(const Model& model);

/// Largest number of unknowns, corners times directions, of which statics is asked: 470 joints of four corners take about 5 s, and the time
/// grows as the square [-].
inline constexpr std::size_t kMostRays = 30000;

/// The largest steady horizontal acceleration, over gravity, along the unit vector `towards`, for which such forces exist [-]: of
/// hinging structures that at which they overturn, of sliding ones an upper bound (friction is not associated). Nothing where statics is
/// not asked or would have more than kMostSteadyRays unknowns, where they cannot stand, or beyond kMostAcceleration.
std::optional<double> find_steady_acceleration(const Model& model, const Vector3& towards);

/// A second at most [-].
inline constexpr std::size_t kMostSteadyRays = 5000;

/// Blocks between fixed ones may bear any [-].
inline constexpr double kMostAcceleration = 100.0;

}  // namespace musim::lsdem
