#include "lsdem/calibration/rocking_impact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <stdexcept>

#include "lsdem/motion/simulation.hpp"
#include "lsdem/scene/scene.hpp"
#include "lsdem/time_step.hpp"
#include "scaling/angle.hpp"
#include "scaling/interruption.hpp"
#include "scaling/side_by_side.hpp"

namespace musim::lsdem {
namespace {

constexpr int kMostImpacts = 5;                 ///< over which [Harmon23] averages
constexpr double kAtRest = 1e-2;                ///< energy over the first one below which the block counts as at rest
constexpr double kEnergyRatioTolerance = 2e-3;  ///< of r
constexpr int kMostSearchRuns = 12;

/// The block with the side on which it rocks along x.
BlockSample orient(const BlockSample& sample, RockingSide side) { return side == RockingSide::thin ? sample : turned(sample); }

/// Two fixed blocks below the origin, in running bond with the one above.
void add_two_blocks(Model& model, const BlockSample& sample, RockingSide side) {
    const double wide = side == RockingSide::thin ? sample.size.y() : sample.size.x();
    const double pitch = default_pitch({scaling::Length{}, wide * scaling::si::meter, scaling::Length{}}).value();
    const Vector3 along = side == RockingSide::thin ? Vector3::UnitY() : Vector3::UnitX();
    for (const double sign : {-1.0, 1.0}) {
        Block block = make_block(sample, sign * pitch * along - 0.5 * sample.size.z() * Vector3::UnitZ());
        block.fixed = true;
        model.blocks.push_back(block);
    }
    model.ground.present = false;
}

/// The block tilted about its lower edge at +x, that edge in the plane z = 0 where it belongs when upright.
Model make_tilted_model(const BlockSample& sample, const RockingCase& test) {
    Model model = make_model(sample);
    if (test.support == RockingSupport::two_blocks) add_two_blocks(model, sample, test.side);
    const Quaternion orientation(Eigen::AngleAxisd(test.start, Vector3::UnitY()));
    const Vector3 edge(0.5 * sample.size.x(), 0.0, -0.5 * sample.size.z());
    const Vector3 pivot(0.5 * sample.size.x(), 0.0, 0.0);
    model.blocks.push_back(make_block(sample, pivot - orientation * edge, orientation));
    return model;
}

/// Rotation about y [rad].
double find_tilt(const Simulation& simulation, std::size_t block) {
    const Quaternion q = simulation.orientation(block);
    return 2.0 * std::atan2(q.y(), q.w());
}

}  // namespace

std::string to_string(RockingSide side) { return side == RockingSide::thin ? "thin" : "wide"; }
std::string to_string(RockingSupport support) { return support == RockingSupport::ground ? "ground" : "two_blocks"; }

double slenderness(const BlockSample& sample, RockingSide side) {
    return std::atan2(side == RockingSide::thin ? sample.size.x() : sample.size.y(), sample.size.z());
}

double housner_ratio(const BlockSample& sample, RockingSide side) {
    const double s = std::sin(slenderness(sample, side));
    return std::pow(1.0 - 1.5 * s * s, 2);
}

RockingResult run_rocking_test(const BlockSample& given, const RockingCase& test) {
    const double alpha = slenderness(given, test.side);
    if (!(test.start > 0.0) || !(test.start < alpha)) {
        throw std::invalid_argument(
            fmt::format("rocking test: the block is let go at {:.4g} degrees (must be between 0 and {:.4g}, where it overturns)",
                        test.start * scaling::kDegrees, alpha * scaling::kDegrees));
    }
    BlockSample sample = orient(given, test.side);
    sample.restitution = test.restitution;
    const Model model = make_tilted_model(sample, test);
    const std::size_t block = model.blocks.size() - 1;
    Simulation simulation(model, test.safety * compute_critical_time_step(model));

    // energy over m g R; a swing ends where the tilt turns, an impact is where it changes sign
    const auto lift = [&](double tilt) { return std::cos(alpha - std::abs(tilt)) - std::cos(alpha); };
    const double p = std::sqrt(0.75 * sample.gravity / (0.5 * std::hypot(sample.size.x(), sample.size.z())));
    const double start_energy = lift(test.start);
    RockingResult result;
    double before = start_energy, farthest = 0.0, last_tilt = test.start;
    // a quarter of a period takes acosh(1/(1 − θ/α))/p; twice that and a margin for the last small swings
    const double most_time = (2.0 * std::acosh(1.0 / (1.0 - test.start / alpha)) * (kMostImpacts + 2) + 4.0) / p;
    for (bool struck = false; result.impacts < kMostImpacts && simulation.time() < most_time;) {
        simulation.advance();
        scaling::stop_if_interrupted();
        if (simulation.divergence()) throw std::runtime_error("rocking test: the run diverged; take a smaller step");
        const double tilt = find_tilt(simulation, block);
        if ((tilt > 0.0) == (last_tilt > 0.0)) {
            farthest = std::max(farthest, std::abs(tilt));
        }
        const bool crossed = (tilt > 0.0) != (last_tilt > 0.0);
        // the swing after an impact is over when the block has come half way back, or strikes again
        const bool over = struck && (crossed || std::abs(tilt) < 0.5 * farthest) && lift(farthest) > kAtRest * start_energy;
        if (over) {
            const double after = lift(farthest);
            if (result.impacts == 0) result.first = after / before;
            before = after;
            ++result.impacts;
            struck = false;
        }
        if (crossed) {
            const Vector3 x = simulation.position(block);
            result.slip_over_side = std::abs(x.x()) / sample.size.x();
            if (struck && !over) break;  // too small a swing: at rest
            struck = true;
            farthest = 0.0;
        }
        last_tilt = tilt;
    }
    result.mean = result.impacts > 0 ? std::pow(before / start_energy, 1.0 / result.impacts) : 0.0;
    return result;
}

std::vector<RockingCurve> sweep_rocking(const BlockSample& sample, const RockingSweep& sweep) {
    std::vector<RockingCurve> curves;
    for (const RockingSupport support : sweep.supports) {
        for (const RockingSide side : {RockingSide::thin, RockingSide::wide}) {
            for (const double angle : sweep.angles) {
                if (angle >= slenderness(sample, side)) continue;
                curves.push_back({support, side, angle, sweep.restitutions, std::vector<RockingResult>(sweep.restitutions.size())});
            }
        }
    }
    std::vector<std::function<void()>> jobs;
    for (RockingCurve& curve : curves) {
        for (std::size_t i = 0; i < curve.restitution.size(); ++i) {
            jobs.emplace_back([&sample, &curve, &sweep, i] {
                curve.result[i] = run_rocking_test(sample, {curve.support, curve.side, curve.start, curve.restitution[i], sweep.safety});
            });
        }
    }
    scaling::run_side_by_side(jobs, sweep.threads, sweep.on_progress);
    return curves;
}

RestitutionSearch find_restitution(const BlockSample& sample, const RockingCurve& curve, double target, double safety) {
    const auto [least, most] = std::minmax_element(curve.result.begin(), curve.result.end(),
                                                   [](const RockingResult& a, const RockingResult& b) { return a.mean < b.mean; });
    RestitutionSearch search{.lowest = least->mean, .highest = most->mean, .restitution = {}, .reached = 0.0};

    // the first interval of the curve that takes the target, among those whose ends lie on both sides of the target
    for (std::size_t i = 1; i < curve.result.size(); ++i) {
        double low = curve.restitution[i - 1], high = curve.restitution[i];
        const bool rising = curve.result[i].mean > curve.result[i - 1].mean;
        const auto [lower, upper] = std::minmax(curve.result[i - 1].mean, curve.result[i].mean);
        if (target < lower || target > upper) continue;
        for (int run = 0; run < kMostSearchRuns; ++run) {
            const double middle = 0.5 * (low + high);
            search.restitution = middle;
            search.reached = run_rocking_test(sample, {curve.support, curve.side, curve.start, middle, safety}).mean;
            if (std::abs(search.reached - target) < kEnergyRatioTolerance) return search;
            ((search.reached < target) == rising ? low : high) = middle;
        }
        // bounces make the curve jump there: it passes the target without taking it
        search.restitution.reset();
    }
    return search;
}

std::string make_rocking_csv(const BlockSample& sample, const std::vector<RockingCurve>& curves) {
    std::string csv = "support,side,start_deg,restitution,r_first,r_mean,impacts,slip_over_side,housner\n";
    for (const RockingCurve& curve : curves) {
        for (std::size_t i = 0; i < curve.restitution.size(); ++i) {
            const RockingResult& r = curve.result[i];
            fmt::format_to(std::back_inserter(csv), "{},{},{:.6g},{},{},{},{},{},{}\n", to_string(curve.support), to_string(curve.side),
                           curve.start * scaling::kDegrees, curve.restitution[i], r.first, r.mean, r.impacts, r.slip_over_side,
                           housner_ratio(sample, curve.side));
        }
    }
    return csv;
}

}  // namespace musim::lsdem
