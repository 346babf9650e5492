#include "lsdem/study/pair_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "lsdem/block_height.hpp"

namespace musim::lsdem {
namespace {

constexpr std::size_t kMaxRows = 10;

Vector3 find_base_peaks(const History& history) {
    Vector3 peaks = Vector3::Zero();
    for (const BaseState& base : history.base) peaks = peaks.cwiseMax(base.velocity.cwiseAbs());
    return peaks;
}

/// Styles of a plot of runs: the prototype and its twins, and the first model.
constexpr int kPrototypeStyle = 0, kFirstModelStyle = 1;

PlotSeries make_series(const std::string& label, const std::vector<double>& running, const std::vector<double>& time) {
    const auto count = static_cast<std::ptrdiff_t>(std::min(running.size(), time.size()));
    PlotSeries series;
    series.label = label;
    series.x.assign(time.begin(), time.begin() + count);
    series.y.assign(running.begin(), running.begin() + count);
    return series;
}

/// The smallest value that a logarithmic axis shows.
double find_least(const LinePlot& plot) {
    double least = 1.0;
    for (const PlotSeries& series : plot.series) {
        for (const std::vector<double>* values : {&series.y, &series.y_low}) {
            for (const double value : *values) least = value > 0.0 ? std::min(least, value) : least;
        }
    }
    return least;
}

/// Horizon of a pair with twins, where it lies within the run [s].
std::optional<double> find_horizon(const PairStudy& study) {
    if (study.twin_traces.empty()) return std::nullopt;
    const Yardstick yardstick = study.yardstick();
    return yardstick.is_within_run() ? std::optional(yardstick.horizon()) : std::nullopt;
}
/// "horizon, 4.68 s".
std::string name_horizon(double horizon) { return fmt::format("horizon, {:.3g} s", horizon); }

}  // namespace

std::vector<std::size_t> choose_rows(std::size_t spine) {
    const std::size_t rows = std::min(spine, kMaxRows);
    std::vector<std::size_t> chosen;
    for (std::size_t r = 0; r < rows; ++r) chosen.push_back(rows > 1 ? r * (spine - 1) / (rows - 1) : 0);
    return chosen;
}

PlotCurves make_spine_curves(const std::string& label, const RunData& run, const SpineUnits& units, const std::vector<std::size_t>& rows) {
    PlotCurves curves{.label = label, .y = std::vector<std::vector<double>>(rows.size())};
    const std::size_t spine = run.spine.size();
    for (std::size_t k = 0; k < run.history.samples(); ++k) {
        curves.x.push_back(units.time * run.history.time[k] / run.similitude.time());
        for (std::size_t r = 0; r < rows.size(); ++r) {
            curves.y[r].push_back(units.velocity * run.history.spine_velocity[k * spine + rows[r]][units.axis] / run.similitude.velocity());
        }
    }
    return curves;
}

SpeedScales find_motion_scales(const Specimen& specimen) {
    const Model& model = specimen.model;
    SpeedScales scales{.gravity = model.gravity.norm()};
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

StackedPlot make_spine_plot(const PairStudy& study, const SpeedScales& scales, const std::string& name) {
    StackedPlot plot{
        .title = "Spine velocities, scaled back to the prototype", .subtitle = name, .x_label = "t √(μ g / l)", .y_label = "v / PGV"};
    SpineUnits units;

    // what velocities are measured in
    units.axis = find_strongest_axis(study.prototype.history);
    const double pgv = find_base_peaks(study.prototype.history)[units.axis];
    const double sliding_velocity = scales.sliding_speed();
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
    plot.y_label +=
        std::string(" along ") + "xyz"[units.axis] + (study.prototype.blocks.is_listed() ? ", one row per block" : ", one row per level");

    const std::vector<std::size_t> rows = choose_rows(study.prototype.spine.size());
    const std::vector<std::string> labels = label_spine(study.prototype);
    for (const std::size_t row : rows) plot.row_labels.push_back(labels[row]);
    plot.runs.push_back(make_spine_curves("prototype", study.prototype, units, rows));
    if (const std::optional<TwinBand> band = find_twin_band(study)) add_twin_band(plot, *band, units);
    if (const std::optional<double> horizon = find_horizon(study)) plot.mark = {*horizon * units.time, name_horizon(*horizon)};
    for (const PairedRun& model : study.models) plot.runs.push_back(make_spine_curves(model.label, model.run, units, rows));
    return plot;
}

Departure find_departure(const PairStudy& study) {
    Departure departure{.time = study.prototype.history.time, .twins = study.twin_traces.size()};
    for (const PairedRun& model : study.models) departure.models.push_back({.label = model.label, .running = model.trace.running});
    if (study.half_step) departure.models.push_back({.label = "half the step", .running = study.half_step->trace.running});
    if (study.twin_traces.empty()) return departure;
    departure.horizon = find_horizon(study);
    for (std::size_t k = 0; k < departure.time.size(); ++k) {
        double low = 0.0, high = 0.0;
        for (const RunTrace& twin : study.twin_traces) {
            if (k >= twin.running.size()) continue;
            low = low > 0.0 ? std::min(low, twin.running[k]) : twin.running[k];
            high = std::max(high, twin.running[k]);
        }
        departure.twins_low.push_back(low);
        departure.twins_high.push_back(high);
    }
    return departure;
}

LinePlot make_departure_plot(const Departure& departure, const std::string& name) {
    LinePlot plot{.title = "Departure from the prototype",
                  .subtitle = name,
                  .x_label = "time of the prototype [s]",
                  .y_label = "largest difference so far / peak velocity"};
    plot.y_logarithmic = true;
    plot.of_runs = true;
    if (departure.twins > 0) {
        PlotSeries twins = make_series(fmt::format("{} twins", departure.twins), departure.twins_high, departure.time);
        twins.y_low = departure.twins_low;
        twins.y_low.resize(twins.y.size());
        twins.style = kPrototypeStyle;
        plot.series.push_back(std::move(twins));
    }
    int style = kFirstModelStyle;
    for (const Departure::Curve& curve : departure.models) {
        plot.series.push_back(make_series(curve.label, curve.running, departure.time));
        plot.series.back().style = curve.style >= 0 ? curve.style : style;
        ++style;
    }
    if (departure.horizon) {
        PlotSeries horizon;
        horizon.label = name_horizon(*departure.horizon);
        horizon.x = {*departure.horizon, *departure.horizon};
        horizon.y = {find_least(plot), 1.0};
        horizon.style = kMarkStyle;
        plot.series.push_back(std::move(horizon));
    }
    return plot;
}

std::optional<TwinBand> find_twin_band(const PairStudy& study) {
    if (study.twin_spread.empty()) return std::nullopt;
    const std::size_t spine = study.prototype.spine.size();
    TwinBand band{.axis = find_strongest_axis(study.prototype.history), .rows = choose_rows(spine)};
    for (const std::size_t row : band.rows) {
        std::vector<double>& widths = band.half_width.emplace_back();
        for (std::size_t k = row; k < study.twin_spread.size(); k += spine) widths.push_back(study.twin_spread[k][band.axis]);
    }
    return band;
}

void add_twin_band(StackedPlot& plot, const TwinBand& band, const SpineUnits& units) {
    PlotCurves& first = plot.runs.front();
    const auto fits = [&](const std::vector<double>& widths) { return widths.size() == first.x.size(); };
    const bool all_fit = std::all_of(band.half_width.begin(), band.half_width.end(), fits);
    if (band.axis != units.axis || band.half_width.size() != plot.row_labels.size() || !all_fit) return;
    first.spread = band.half_width;
    for (std::vector<double>& widths : first.spread) {
        for (double& width : widths) width *= units.velocity;
    }
    first.label += ", band of its twins";
}

}  // namespace musim::lsdem
