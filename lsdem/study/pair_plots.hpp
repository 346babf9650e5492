#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/plot/line_plot.hpp"
#include "lsdem/plot/plot.hpp"
#include "lsdem/response/response.hpp"
#include "lsdem/study/pair.hpp"

/// Pictures of a pair, and what is drawn in them.
namespace musim::lsdem {

/// Scales that make a specimen's motion dimensionless: time times √(μ g/l), velocities over √(μ g l) [Andrade22]; μ of the lowest block, 0
/// makes time and velocity dimensional. Elastic waves are left out.
SpeedScales find_motion_scales(const Specimen& specimen);

/// Indices of the spine blocks to show in a picture, bottom to top: at most ten, evenly chosen, the lowest and the highest among them.
std::vector<std::size_t> choose_rows(std::size_t spine);

/// Units in which spine velocities are drawn: along an axis (0, 1, 2: x, y, z), by factors on seconds and m/s of the prototype.
struct SpineUnits {
    int axis = 0;
    double time = 1.0, velocity = 1.0;
};

/// Spine velocities of a run, scaled back by its similitude, a curve for each of `rows`.
PlotCurves make_spine_curves(const std::string& label, const RunData& run, const SpineUnits& units, const std::vector<std::size_t>& rows);

/// Distance of the twins from the prototype in the spine velocities along its strongest axis: half widths of a band about it.
struct TwinBand {
    int axis = 0;                                      ///< 0, 1, 2: x, y, z
    std::vector<std::size_t> rows;                     ///< indices into the spine, bottom to top (choose_rows)
    std::vector<std::vector<double>> half_width = {};  ///< of each row over the samples, the largest |v_twin/λ_v − v_P| [m/s]
};
/// Nothing without twins.
std::optional<TwinBand> find_twin_band(const PairStudy& study);
/// Draws the band about the first run of a plot, when it is of the same curves.
void add_twin_band(StackedPlot& plot, const TwinBand& band, const SpineUnits& units);

/// Spine velocities of the prototype and its models along the axis that the base shakes most, or along which the spine
/// moves most when the base stands: v/PGV, or v/√(μ g l), over t √(μ g/l), every run scaled back to the prototype. At most ten levels,
/// evenly chosen. About the prototype's is the band of its twins, when there are any. `name` says of what.
StackedPlot make_spine_plot(const PairStudy& study, const SpeedScales& scales, const std::string& name);

/// Departure of the models and twins of a pair from their prototype: R over its time, see RunTrace.
struct Departure {
    struct Curve {
        std::string label;
        std::vector<double> running;  ///< R [-]; shorter than `time` for a run that ended early
        int style = -1;               ///< look of the run, see PlotCurves::style; -1: its place after the prototype
    };
    std::vector<double> time;                             ///< of the prototype [s]
    std::vector<Curve> models = {};                       ///< and the run at half the step, last
    std::size_t twins = 0;                                ///< how many
    std::vector<double> twins_low = {}, twins_high = {};  ///< the least and the largest R of them; empty without any
    std::optional<double> horizon = {};                   ///< when it lies within the run [s]
};
Departure find_departure(const PairStudy& study);

/// The departures on a logarithmic axis, runs in the looks that they have in make_spine_plot(), twins as a band in the prototype's colour,
/// the horizon marked. `name` says of what.
LinePlot make_departure_plot(const Departure& departure, const std::string& name);

}  // namespace musim::lsdem
