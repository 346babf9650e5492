#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/results/history.hpp"
#include "lsdem/run/simulate.hpp"
#include "lsdem/scene/scene.hpp"
#include "lsdem/study/mechanism.hpp"
#include "lsdem/types.hpp"
#include "scaling/angle.hpp"

/// The angle at which a structure collapses when its ground is tilted slowly, as on a tilting table.
///
/// The ground turns from one angle to the next and is held there; all times are multiples of T = √(H/g), H the height of the structure.
/// The structure stands at an angle when no block has fallen and the last quarter of the hold has moved none, seen from the ground, faster
/// than kMostSpeed √(gH). The states in which it stands are kept: where it fails the ground goes on from the last of them by half the step,
/// until it fails after a step of the tolerance. See docs/theory/tilt.md.
namespace musim::lsdem {

/// Time in which the ground turns by a step, over T: its rate rises in the first quarter, and falls in the last one, evenly. While it falls
/// the structure bears at its top a steady acceleration of (16/3)/kTurnTime² of the step, as if the ground were tilted by so much more:
/// 1/12.
inline constexpr double kTurnTime = 8.0;

/// Time for which the ground is held, over T. Beyond its limit by δ a block overturns as δ cosh pt, p ≤ √(3/2)/T, and one that slides has
/// the speed g δ t: kMostSpeed is exceeded from δ = 1e-6 and 2e-4 rad on.
inline constexpr double kHoldTime = 10.0;

/// Rate at which velocities decay in the first quarter of a hold, times T: what the turning left swings no longer, as if it had been
/// slower.
inline constexpr double kHoldDamping = 4.0;

/// Mean speed of a point of a block in the last quarter of a hold, over √(gH), below which it stands [-]. A choice.
inline constexpr double kMostSpeed = 1e-3;

/// The mechanism is named when a joint has opened or slipped by this part of the smallest edge of its blocks [-], or after kFallTime T.
inline constexpr double kVisiblePart = 0.125, kFallTime = 40.0;

/// Direction about which the ground is tilted, horizontal, of unit length: positive turns lower the side of axis × z.
struct TiltSettings {
    Vector3 axis = Vector3::UnitY();
    double step = 2.0 * scaling::kDegree;       ///< the first one [rad]
    double until = 60.0 * scaling::kDegree;     ///< where to end [rad]
    double tolerance = 0.1 * scaling::kDegree;  ///< width to which the angle is enclosed at most [rad]
};

/// An angle that was tried.
struct TiltTry {
    double from = 0.0, angle = 0.0;  ///< the ground turned from one to the other [rad]
    bool stands = false;
    double speed = 0.0;                      ///< largest of the last quarter over √(gH) [-]; 0 where a block fell before
    std::optional<std::size_t> fallen = {};  ///< the first block that was seen to have fallen
};

/// A structure that moves, where it is.
struct TiltFall {
    std::vector<BodyPlace> place;  ///< of all blocks, seen from the ground: as if it had not been tilted
    double time = 0.0;             ///< since the ground began to turn by the last step [s]
    /// Nothing where a block is round: its joints have no corners.
    std::optional<Mechanism> mechanism;
    std::string sentence;  ///< the mechanism for people; empty without
};

struct TiltCollapse {
    Vector3 axis = Vector3::UnitY();
    double height = 0.0;         ///< H [m]
    double unit_time = 0.0;      ///< T [s]
    double time_step = 0.0;      ///< [s]
    std::uint64_t steps = 0;     ///< of all tries
    double low = 0.0;            ///< the largest angle at which it stood [rad]
    std::optional<double> high;  ///< at which it did not, after a step of less than the tolerance [rad]; nothing: it stood up to the end
    double rate_excess = 0.0;    ///< by so much the angle may be larger, since the ground was turned by the last step in finite time [rad]
    std::vector<TiltTry> tries;  ///< in their order
    /// Angle of the limit by rigid statics: atan of find_steady_acceleration() downhill; nothing where that has no answer [rad].
    std::optional<double> statics;
    std::optional<TiltFall> fall;          ///< nothing where it stood to the end
    std::optional<Divergence> divergence;  ///< then the search ended early
    BlockTable blocks;
    Model model;  ///< before it is tilted

    double angle() const { return high ? 0.5 * (low + *high) : low; }                ///< [rad]
    double error() const { return high ? 0.5 * (*high - low) + rate_excess : 0.0; }  ///< of angle() [rad]
    Vector3 downhill() const { return axis.cross(Vector3::UnitZ()); }                ///< seen from the ground, for positive angles
};

/// Tilts the structure of a scene, laid as for a run, until it collapses. Progress is the part of `until` that is reached. Throws
/// SceneError for a scene with a base motion, without a ground, with blocks that do not turn with it, with gravity that is not vertical,
/// and for a structure that does not stand on level ground; std::invalid_argument for settings out of range (check_tilt);
/// scaling::Interrupted; as lay_specimen does.
TiltCollapse find_tilt_of_collapse(const Scene& scene, const TiltSettings& settings = {}, const RunSettings& run = {});

/// Why these settings cannot be used, in words without a subject; empty: they can.
std::string check_tilt(const TiltSettings& settings);

/// Results as one JSON object in SI units and degrees.
nlohmann::json to_json(const TiltCollapse& result);

/// Results for people, line by line.
std::vector<std::string> describe(const TiltCollapse& result);

/// Picture of the structure as it falls, seen along the axis, with joints that open and slide; requires TiltCollapse::fall.
std::string make_fall_svg(const TiltCollapse& result, const std::string& title);

}  // namespace musim::lsdem
