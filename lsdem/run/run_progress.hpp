#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "lsdem/results/history.hpp"
#include "lsdem/results/time_plan.hpp"

namespace musim::lsdem {

/// Where a run stands while it goes on, for whoever looks on.
struct RunProgress {
    double time = 0.0;                 ///< of the model, since the start of the run [s]
    double duration = 0.0;             ///< planned [s]
    std::size_t stage = 1;             ///< of a sequence, from 1
    double kinetic_energy = 0.0;       ///< now, of all blocks [J]
    double drift = 0.0;                ///< largest now, see find_largest_drift [-]
    std::size_t blocks = 0;            ///< in all
    std::size_t fallen = 0;            ///< of them
    bool collapsed = false;            ///< kCollapsedFraction of them have
    int axis = 0;                      ///< along which the base has moved most: 0, 1, 2 for x, y, z
    std::vector<double> top_velocity;  ///< of the highest spine block along that axis, see thin_extremes [m/s]

    bool operator==(const RunProgress&) const = default;
};

/// How many values of a history are shown.
inline constexpr std::size_t kProgressPoints = 40;

/// The last sample of a run that goes on by this plan. A run without samples or spine has no drift and no velocity.
RunProgress observe_run(const RunResult& run, const TimePlan& plan);

/// Largest drift of the spine at a sample,
///   max over neighbors i, j of |Δu_i − Δu_j| / (z_i − z_j)       [-],
/// Δu the horizontal displacement since the start, z the height at the start; the base is the neighbor below the lowest one, at z = 0,
/// moved by its own displacement. Neighbors that are not above each other are left out.
double find_largest_drift(const RunResult& run, std::size_t sample);

/// Of `count` equal parts of a history, or of each value if it is shorter, the value of largest magnitude.
std::vector<double> thin_extremes(const std::vector<double>& history, std::size_t count);

nlohmann::json to_json(const RunProgress& progress);
/// Throws nlohmann::json::exception for anything else than to_json() makes.
RunProgress parse_progress_run(const nlohmann::json& json);

}  // namespace musim::lsdem
