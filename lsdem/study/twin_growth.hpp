#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// Growth of the differences between exact models, or copies that begin a little elsewhere, and their prototype. Everything here is in the
/// prototype's units.
namespace musim::lsdem {

/// Growth is measured over this time, in √(H/g) of a block's height H: 10 ms of a tower of blocks 4.25 m high. Blocks rock and hit each
/// other in about √(H/g): within a hundredth of that nothing that is continuous multiplies a difference much.
inline constexpr double kGrowthWindow = 0.015;

/// Copies whose blocks begin elsewhere part in proportion to how far, as long as the difference is small: compared up to this part of the
/// peak [-].
inline constexpr double kProportionalLevel = 1e-4;

/// A twin of a prototype: it would move as the prototype does if nothing were rounded, or almost so.
struct TwinChoice {
    double length = 1.0;           ///< λ_l, by law `exact`
    double shift = 0.0;            ///< every block that moves begins this part of its height elsewhere [-]
    std::uint64_t directions = 0;  ///< seed of the directions in which: twins of one seed begin elsewhere in the same
    bool last_place = false;  ///< instead: each coordinate is off by −1, 0 or 1 units in the last place of the largest, drawn likewise

    bool operator==(const TwinChoice&) const = default;
};

/// Result of a twin's run.
struct TwinRun {
    TwinChoice choice;
    /// Sample by sample from t = 0: max |v_M/λ_v − v_P| over all blocks that move, at equal dimensionless times [m/s]. Shorter than the
    /// prototype's run when it diverged.
    std::vector<double> difference;
    bool diverged = false;
};

/// Data of a prototype that has run.
struct TwinPrototype {
    std::size_t moving_blocks = 0;  ///< over which all maxima are taken
    double height = 0.0;            ///< H, of the shape of the first of them [m]
    double gravity = 0.0;           ///< g [m/s²]
    double interval = 0.0;          ///< between samples [s]
    std::size_t samples = 0;        ///< with that at t = 0
    double peak = 0.0;              ///< V: largest velocity of a moving block relative to the base in the whole run [m/s]
    /// ε L/Δt: what a velocity differs by when a position does by its last place within one step, L the largest coordinate of a block at
    /// the start [m/s]. Twins that stand still differ by as much; growth counts from there on, lest the first rounding pass for a jump.
    double rounding = 0.0;
    bool diverged = false;  ///< its run ends there, and so do the twins'

    double time(std::size_t sample) const { return static_cast<double>(sample) * interval; }  ///< [s]
    /// kGrowthWindow √(H/g) in whole samples, one at least; without gravity one.
    std::size_t window() const;
};

/// A prototype and its twins.
struct TwinStudy {
    std::string name;  ///< of the scene
    TwinPrototype prototype;
    std::vector<TwinRun> twins;
};

/// The largest growth within one window.
struct Growth {
    double factor = 1.0;  ///< min(R(t), kPartingLevel)/max(R(t − window), rounding/V); of copies that begin elsewhere after one window
    double time = 0.0;    ///< t, at its end [s]
    double from = 0.0;    ///< R at its begin [-]
};

/// Growth of one twin's difference from the prototype. R is the running maximum of difference/V.
struct TwinGrowth {
    std::vector<double> running;         ///< R, sample by sample [-]
    std::optional<double> parting_time;  ///< first sample with R > kPartingLevel [s]; nothing if never
    Growth growth;                       ///< below kPartingLevel
};
TwinGrowth find_growth(const TwinPrototype& prototype, const TwinRun& twin);

/// Logarithms of R of several models at one sample; those that agree to the last bit up to there have none and are left out, as are copies
/// that begin elsewhere.
struct LogSpread {
    double time = 0.0;      ///< [s]
    std::size_t count = 0;  ///< models with a logarithm
    double mean = 0.0;      ///< of log10 R; NaN without
    double sd = 0.0;        ///< of the population they are drawn from; NaN of fewer than two
};

/// All twins of a study together.
struct TwinSummary {
    std::vector<TwinGrowth> twins;  ///< in the order of the study
    double horizon = 0.0;           ///< the earliest parting, or the end of the run when none parts [s]
    LogSpread at_horizon;           ///< at the last sample up to 0.9 of the horizon
    std::size_t fastest = 0;        ///< the twin with the largest growth
};

/// Throws std::invalid_argument for a study without twins, or one whose prototype never moves.
TwinSummary summarize(const TwinStudy& study);

/// The spread at a sample, over the models that got there.
LogSpread find_spread(const TwinStudy& study, const std::vector<TwinGrowth>& twins, std::size_t sample);

/// Copies that begin elsewhere in the same directions, each by another part of a height. Exact models beside them say what rounding alone
/// makes of a difference by then; what is less than ten times as much is not compared.
struct Proportionality {
    std::uint64_t directions = 0;
    std::vector<double> shift;  ///< ascending [-]
    /// The largest max/min of R/shift over the copies with 10 R_0 < R ≤ kProportionalLevel, R_0 the largest of rounding/V and of the R of
    /// exact models; 1: in proportion throughout. What does not last for a growth window is left out: an impact that comes a little earlier
    /// in one copy. Nothing when there was never a sample with two of them.
    std::optional<double> departure;
    double time = 0.0;   ///< of that [s]
    double level = 0.0;  ///< the largest R then [-]
};

/// One for each seed of directions with two copies or more.
std::vector<Proportionality> find_proportionality(const TwinStudy& study, const std::vector<TwinGrowth>& twins);

/// `models` exact models with lengths 4^u, u uniform in (−2, 2), drawn from `seed`; the first ones are the same whatever their number. None
/// is a power of four, short of an accident.
std::vector<TwinChoice> choose_models(std::size_t models, std::uint64_t seed);

/// Copies of length 1, for every one of `sets` seeds of directions from `seed` on one of each shift.
std::vector<TwinChoice> choose_shifted(const std::vector<double>& shifts, std::size_t sets, std::uint64_t seed);

}  // namespace musim::lsdem
