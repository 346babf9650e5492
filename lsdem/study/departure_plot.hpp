#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lsdem/plot/line_plot.hpp"
#include "lsdem/study/pair.hpp"

namespace musim::lsdem {

/// How models and twins of a pair depart from their prototype: R over its time, see RunTrace.
struct Departure {
    struct Curve {
        std::string label;
        std::vector<double> running;  ///< R [-]; shorter than `time` for a run that ended early
    };
    std::vector<double> time;                             ///< of the prototype [s]
    std::vector<Curve> models = {};                       ///< and the run at half the step, last
    std::size_t twins = 0;                                ///< how many
    std::vector<double> twins_low = {}, twins_high = {};  ///< the least and the largest R of them; empty without any
    std::optional<double> horizon = {};                   ///< when it lies within the run [s]
};
Departure find_departure(const PairStudy& study);

/// Of a pair with twins, where it lies within the run [s].
std::optional<double> find_horizon(const PairStudy& study);
/// "horizon, 4.68 s".
std::string name_horizon(double horizon);

/// The departures on a logarithmic axis, twins as a band, the horizon marked. `name` says of what.
LinePlot make_departure_plot(const Departure& departure, const std::string& name);

/// How far twins were from the prototype in the spine velocities along its strongest axis: half widths of a band about it.
struct TwinBand {
    int axis = 0;                                      ///< 0, 1, 2: x, y, z
    std::vector<std::size_t> rows;                     ///< indices into the spine, bottom to top (choose_rows)
    std::vector<std::vector<double>> half_width = {};  ///< of each row over the samples, the largest |v_twin/λ_v − v_P| [m/s]
};
/// Nothing without twins.
std::optional<TwinBand> find_twin_band(const PairStudy& study);

}  // namespace musim::lsdem
