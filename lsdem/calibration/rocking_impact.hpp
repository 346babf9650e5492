#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/calibration/block_sample.hpp"

/// Loss of a rocking block at an impact, against the coefficient of restitution of its contacts [Harmon23, appendix].
namespace musim::lsdem {

/// The side along which the block rocks: pivots are b or w apart.
enum class RockingSide { thin, wide };

/// On the ground, or on two fixed blocks of the same size in running bond, shifted by half of the wide side: a block that rocks on its
/// wide side then pivots on the middles of both, one that rocks on its thin side on their edges.
enum class RockingSupport { ground, two_blocks };

std::string to_string(RockingSide side);
std::string to_string(RockingSupport support);

struct RockingCase {
    RockingSupport support = RockingSupport::ground;
    RockingSide side = RockingSide::thin;
    double start = 0.0;        ///< tilt at which the block is let go [rad]
    double restitution = 0.3;  ///< of the contacts, C_res [-]
    double safety = 0.2;       ///< time step over the critical one
};

/// Energies of a block that rocks, from the heights at its turning points.
struct RockingResult {
    double first = 0.0;  ///< r of the first impact: energy after over energy before [-]
    /// Geometric mean r of the impacts followed, five at most, (E_n/E_0)^(1/n). [Harmon23] averaged over as many; a geometric mean does not
    /// depend on how bounces pass energy from one swing to the next [-].
    double mean = 0.0;
    int impacts = 0;              ///< followed, until it has come to rest
    double slip_over_side = 0.0;  ///< how far the block's middle has moved along the support when it was last upright, over its side [-]
};

/// Slenderness angle α of a side, at which the block would overturn [rad].
double slenderness(const BlockSample& sample, RockingSide side);

/// Energy ratio of an impact without bounce or slip, (1 − 1.5 sin²α)² [Housner63]; thin 0.741, wide 0.293.
double housner_ratio(const BlockSample& sample, RockingSide side);

/// Lets the block fall from `start` and follows it for five impacts, or until its energy is below a hundredth of the first.
///
/// The energy at a turning point θ is m g R (cos(α − θ) − cos α), R the half diagonal. Throws std::invalid_argument unless
/// 0 < start < α, and for a sample that make_model refuses.
RockingResult run_rocking_test(const BlockSample& sample, const RockingCase& test);

/// The tests of one support, side and angle, over restitution.
struct RockingCurve {
    RockingSupport support = RockingSupport::ground;
    RockingSide side = RockingSide::thin;
    double start = 0.0;  ///< [rad]
    std::vector<double> restitution;
    std::vector<RockingResult> result;
};

struct RockingSweep {
    std::vector<double> restitutions;  ///< C_res
    std::vector<double> angles;        ///< where the block is let go [rad]; those at or above α of a side are left out there
    std::vector<RockingSupport> supports;
    double safety = 0.2;
    int threads = 0;  ///< tests side by side; no influence on results
    std::function<void(double)> on_progress = {};
};

/// Runs all tests of a sweep.
std::vector<RockingCurve> sweep_rocking(const BlockSample& sample, const RockingSweep& sweep);

/// Which restitution gives an energy ratio.
struct RestitutionSearch {
    double lowest = 0.0, highest = 0.0;  ///< mean r at the ends of the curve [-]
    std::optional<double> restitution;   ///< nothing when the target lies outside of them
    double reached = 0.0;                ///< mean r at `restitution`
};

/// Looks for the restitution at which the mean energy ratio is `target`: halves the interval of the curve in which it lies until r is
/// within 0.002 of it, 12 runs at most. The curve needs two points or more.
RestitutionSearch find_restitution(const BlockSample& sample, const RockingCurve& curve, double target, double safety);

/// support,side,start_deg,restitution,r_first,r_mean,impacts,slip_over_side,housner: one line per test.
std::string make_rocking_csv(const BlockSample& sample, const std::vector<RockingCurve>& curves);

}  // namespace musim::lsdem
