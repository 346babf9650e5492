#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/plot/line_plot.hpp"
#include "lsdem/response/structural_speed.hpp"
#include "lsdem/results/damage.hpp"
#include "lsdem/results/failure.hpp"
#include "lsdem/results/read_results.hpp"
#include "lsdem/results/spine_measures.hpp"

/// Response of one run: how motion travelled up, how far blocks moved and turned, what was left.
namespace musim::lsdem {

struct ResponseSettings {
    std::optional<int> axis;  ///< 0, 1, 2: x, y, z of the speeds; nothing: along which the base moves most, or the spine when it stands
    double threshold = 0.1;   ///< see SpeedSettings
    std::optional<std::array<double, 2>> window;  ///< part of the histories for the speeds [s]; nothing: all
};

/// Scales that make the speeds dimensionless; from the scene that the run carries.
struct SpeedScales {
    double friction = 0.0;       ///< μ of the scene's material [-]
    double gravity = 0.0;        ///< [m/s²]
    double height = 0.0;         ///< l, from the lowest to the highest point of the blocks [m]
    double elastic_speed = 0.0;  ///< c_e = H·√(k/m) of the lowest spine block: k_s for horizontal motion, k_n for vertical [m/s]

    /// √(μ g l) [m/s].
    double sliding_speed() const;
};

struct Response {
    int axis = 0;
    Vector3 pga = Vector3::Zero();      ///< see RunResult::peak_base_acceleration [m/s²]
    BaseChanges base_changes;           ///< of the base's motion against what it was made from
    std::vector<SpeedEstimate> speeds;  ///< none faster than elastic waves, see `why`; empty: the run has one sample
    SpeedScales scales;
    std::vector<SpineLevel> spine;
    Damage damage;
    RunStatus status = RunStatus::completed;
    std::optional<double> collapse_time;  ///< [s]
    bool collapsed_before = false;        ///< see RunData::collapsed_before
    std::optional<Failure> failure;       ///< of a run that collapsed
};

/// Measures a run. Throws ResultError when its scene cannot be read or the window holds fewer than two samples.
Response measure_response(const StoredRun& run, const ResponseSettings& settings = {});

/// Everything in one object; angles in degrees, other quantities in SI units that the keys name. Speeds that cannot be had are null, with
/// the reason in "why".
nlohmann::json to_json(const Response& response);

/// level,height_m,residual_x_m,...,name: one line per block of the spine; a name where blocks are listed.
std::string make_spine_levels_csv(const Response& response);

/// Residual displacement, divided by `length`, over level, as Fig. 10 of [Harmon23].
LinePlot make_residual_plot(const Response& response, const std::string& name, double length = 1.0);
/// Peak and residual rotations over level.
LinePlot make_rotation_plot(const Response& response, const std::string& name);
/// Lag over height for every estimate of the speed.
LinePlot make_lag_plot(const Response& response, const std::string& name);

}  // namespace musim::lsdem
