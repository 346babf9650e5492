#include "lsdem/study/spine_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "lsdem/block_height.hpp"
#include "lsdem/response/response.hpp"
#include "lsdem/study/departure_plot.hpp"

namespace musim::lsdem {
namespace {

constexpr std::size_t kMaxRows = 10;

Vector3 find_base_peaks(const History& history) {
    Vector3 peaks = Vector3::Zero();
    for (const BaseState& base : history.base) peaks = peaks.cwiseMax(base.velocity.cwiseAbs());
    return peaks;
}

struct PlotUnits {
    Eigen::Index axis = 0;
    double time = 1.0;      ///< dimensionless time per second of the prototype
    double velocity = 1.0;  ///< plotted velocity per m/s of the prototype
};

PlotCurves make_curves(const std::string& label, const RunResult& run, const scaling::Similitude& similitude, const PlotUnits& units,
                       const std::vector<std::size_t>& rows) {
    PlotCurves curves{.label = label, .y = std::vector<std::vector<double>>(rows.size())};
    const std::size_t spine = run.spine.size();
    const double time = units.time / similitude.time();
    const double velocity = units.velocity / similitude.velocity();
    for (std::size_t k = 0; k < run.history.samples(); ++k) {
        curves.x.push_back(run.history.time[k] * time);
        for (std::size_t r = 0; r < rows.size(); ++r) {
            curves.y[r].push_back(run.history.spine_velocity[k * spine + rows[r]][units.axis] * velocity);
        }
    }
    return curves;
}

}  // namespace

std::vector<std::size_t> choose_rows(std::size_t spine) {
    const std::size_t rows = std::min(spine, kMaxRows);
    std::vector<std::size_t> chosen;
    for (std::size_t r = 0; r < rows; ++r) chosen.push_back(rows > 1 ? r * (spine - 1) / (rows - 1) : 0);
    return chosen;
}

MotionScales find_motion_scales(const Specimen& specimen) {
    const Model& model = specimen.model;
    MotionScales scales{.friction = 0.0, .gravity = model.gravity.norm(), .height = 0.0};
    double bottom = std::numeric_limits<double>::infinity();
    double top = -bottom;
    for (const Block& block : model.blocks) {
        const double half_height = (block.orientation.toRotationMatrix().cwiseAbs() * half_extents(model, block)).z();
        if (block.position.z() - half_height < bottom) {
            bottom = block.position.z() - half_height;
            scales.friction = model.materials[block.material].friction;
        }
        top = std::max(top, block.position.z() + half_height);
    }
    scales.height = std::max(0.0, top - bottom);
    return scales;
}

StackedPlot make_spine_plot(const PairStudy& study, const MotionScales& scales, const std::string& name) {
    StackedPlot plot{
        .title = "Spine velocities, scaled back to the prototype", .subtitle = name, .x_label = "t √(μ g / l)", .y_label = "v / PGV"};
    PlotUnits units;

    // what velocities are measured in
    units.axis = find_strongest_axis(study.prototype.history);
    const double pgv = find_base_peaks(study.prototype.history)[units.axis];
    const double sliding_velocity = std::sqrt(scales.friction * scales.gravity * scales.height);
    if (pgv > 0.0) {
        units.velocity = 1.0 / pgv;
    } else {
        units.velocity = sliding_velocity > 0.0 ? 1.0 / sliding_velocity : 1.0;
        plot.y_label = sliding_velocity > 0.0 ? "v / √(μ g l)" : "v of the prototype [m/s]";
    }
    if (sliding_velocity > 0.0) {
        units.time = std::sqrt(scales.friction * scales.gravity / scales.height);
    } else {
        plot.x_label = "t of the prototype [s]";
    }
    plot.y_label += std::string(" along ") + "xyz"[units.axis] + ", one row per level";

    const std::vector<std::size_t> rows = choose_rows(study.prototype.spine.size());
    for (const std::size_t row : rows) plot.row_labels.push_back(fmt::format("level {}", study.prototype.spine.level[row]));
    plot.runs.push_back(make_curves("prototype", study.prototype, scaling::Similitude(), units, rows));
    if (const std::optional<TwinBand> band = find_twin_band(study)) {
        plot.runs.back().label = "prototype, band of its twins";
        plot.runs.back().spread = band->half_width;
        for (std::vector<double>& widths : plot.runs.back().spread) {
            for (double& width : widths) width *= units.velocity;
        }
    }
    if (const std::optional<double> horizon = find_horizon(study)) plot.mark = {*horizon * units.time, name_horizon(*horizon)};
    for (const PairedRun& model : study.models) plot.runs.push_back(make_curves(model.label, model.run, model.run.similitude, units, rows));
    return plot;
}

}  // namespace musim::lsdem
