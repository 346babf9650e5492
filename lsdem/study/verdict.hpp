#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/results/run_quantities.hpp"

/// When exact models agree with their prototype. The measure are twins: runs of the same structure that differ by rounding only. See
/// docs/theory/comparison.md, "When models agree". Everything here is in the prototype's units.
namespace musim::lsdem {

/// Traces of a run that are compared.
struct RunTrace {
    /// R, sample by sample: the running maximum of the difference of spine velocities, max |v_M/λ_v − v_P|, over the largest velocity that
    /// a spine block of the prototype has relative to the base [-].
    std::vector<double> running;
    std::vector<QuantityFamily> quantities;
    bool diverged = false;
    bool settled_anew = false;  ///< of a model: it came to rest by itself, which leaves kInEquilibrium of its weight
    bool image = true;          ///< of a twin: made by the scaling that is judged; else a copy at the prototype's own scale
};

/// Traces of a run against its prototype.
RunTrace trace_run(const RunResult& prototype, const RunResult& run, const scaling::Similitude& similitude);

/// Scatter of log10 R of exact models of one prototype, pooled over scenes: what is taken of fewer than kMeasuredTwins twins, and at least
/// [-]. Measured: docs/validation/verdict.md.
inline constexpr double kPooledScatter = 0.5;
inline constexpr std::size_t kMeasuredTwins = 4;

/// A model parts too early when at some time before the horizon log10 R is this many standard deviations above the twins' mean; below the
/// second it agrees, between them nothing is decided. Chosen for one false alarm in a thousand models: docs/validation/verdict.md.
inline constexpr double kPartsTooEarly = 4.0, kPartsInTime = 3.5;

/// Beyond the horizon: the probability of so large a difference in one of all quantities, by Student's t and with Bonferroni's correction.
/// Below the first the model differs, above the second it agrees [-]. Chosen likewise: few twins do not show the tails of their scatter.
inline constexpr double kDiffers = 1e-5, kAgrees = 1e-3;

/// Differences of runs that agree to this are below what rounding does in any run that only slides: they agree without twins [-].
inline constexpr double kRoundingLevel = 1e-9;

enum class Agreement {
    agree,      ///< the difference is what twins show
    differ,     ///< it is more
    undecided,  ///< between the two
    not_judged  ///< there are no twins
};
/// Verdict on several: differ, else undecided, else not judged, else agree.
Agreement worst(std::initializer_list<Agreement> all);
/// "agree", "differ", "undecided", "not_judged".
std::string to_string(Agreement agreement);

/// Between which differences several runs lie, the prototype (0) among them [-].
struct DifferenceRange {
    double lowest = 0.0, highest = 0.0;

    void include(double difference) { lowest = std::min(lowest, difference), highest = std::max(highest, difference); }
    double largest() const { return std::max(highest, -lowest); }
};

/// One quantity of a model beside the prototype's and the twins'.
struct QuantityCheck {
    std::string key, title, unit;
    int level = 0;
    double prototype = 0.0, model = 0.0;  ///< [unit]
    /// Differences to the prototype over the largest value that the prototype has on any level [-]: the size of the model's, and the
    /// twins'.
    double difference = 0.0;
    DifferenceRange twins{};
    double probability = 1.0;  ///< that a twin lies as far from the other twins [-]; 1 where that is not asked
    std::string name = {};     ///< of a listed block; else empty
};

/// Check of one family on the highest level that it has; nullptr when there is none.
const QuantityCheck* find_top(const std::vector<QuantityCheck>& checks, const std::string& key);

/// A model against the twins.
struct Judgement {
    Agreement agreement = Agreement::not_judged;
    bool within_rounding = false;        ///< it agrees to kRoundingLevel throughout, one that settled anew to kInEquilibrium
    std::optional<double> parting_time;  ///< see Yardstick
    double lead = 0.0;                   ///< most standard deviations of log10 R above the twins' mean, up to the horizon [-]
    double lead_time = 0.0;              ///< [s]
    double least_probability = 1.0;      ///< of any quantity, with the correction; 1 when the horizon is the end of the run [-]
    std::vector<QuantityCheck> quantities;
};

/// Twins of a prototype as the measure of its models.
class Yardstick {
  public:
    Yardstick(const RunResult& prototype, std::vector<RunTrace> twins);

    /// The earliest time at which a twin differs by kPartingLevel; the end of the run when none does [s]. More twins never make it later.
    double horizon() const { return time_of(horizon_); }
    bool is_within_run() const { return parted_; }  ///< does any twin part?
    bool has_twins() const { return !twins_.empty(); }
    double end() const { return time_of(samples_ - 1); }

    /// Twins that are images against those that are copies: by how many standard deviations of the difference of their means log10 R of the
    /// images is higher, at most, up to the horizon [-], and when [s]. What is wrong at every scale but one is wrong in models and images
    /// alike; copies do not have it. Nothing unless there are both.
    struct ImageLead {
        double lead = 0.0, time = 0.0;
        Agreement agreement() const;
    };
    std::optional<ImageLead> lead_of_images() const;

    /// The smallest difference R that would have been seen once the structure moves at a tenth of its peak velocity [-], and when [s].
    /// Nothing without twins or motion.
    struct Seen {
        double difference = 0.0, time = 0.0;
    };
    std::optional<Seen> smallest_seen() const;

    /// Mean and standard deviation of log10 R at a sample, the deviation as it is used.
    struct Scatter {
        double mean = 0.0, sd = 0.0;
    };
    Scatter scatter(std::size_t sample) const;

    /// When R of a run first exceeds kPartingLevel [s]; nothing if never. The horizon is the earliest of the twins'.
    std::optional<double> parting_time(const RunTrace& run) const;
    /// R of a run at the horizon [-].
    double largest_difference(const RunTrace& run) const { return run.running[std::min(horizon_, run.running.size() - 1)]; }
    Judgement judge(const RunTrace& model) const;
    /// The quantities of a run beside those of the twins, without a judgement.
    std::vector<QuantityCheck> check_quantities(const RunTrace& run) const;

  private:
    double time_of(std::size_t sample) const { return static_cast<double>(sample) * interval_; }
    double logarithm(const RunTrace& run, std::size_t sample) const;
    /// By how much log10 R of images may be higher: blocks that fly free round alike in prototype and copies, in images anew at each of n
    /// steps, which adds up as √n. n: up to the last sample at which the copies still move in the
    /// prototype's bits.
    double find_flight_allowance() const;
    double find_scale(std::size_t family) const;  ///< the largest value that the prototype has on any level
    /// Measure that is compared with the twins': the logarithm of a value; of a number of blocks that of one more.
    double measure(std::size_t family, double value) const;
    /// Measures of one quantity: the prototype's, which is one of them, and the twins'.
    std::vector<double> measures_of_twins(std::size_t family, std::size_t level) const;
    /// That the measures of a family are taken to have.
    double least_scatter(std::size_t family) const;

    std::vector<RunTrace> twins_;
    std::vector<QuantityFamily> prototype_;
    double interval_ = 0.0;  ///< between samples [s]
    double steps_per_sample_ = 0.0;
    double floor_ = 0.0;  ///< what rounding of a position makes of R within a step [-]
    std::size_t samples_ = 0, horizon_ = 0, lively_ = 0;
    bool parted_ = false, moves_ = false;
};

}  // namespace musim::lsdem
