#include "lsdem/study/departure_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "lsdem/response/response.hpp"
#include "lsdem/study/spine_plot.hpp"

namespace musim::lsdem {
namespace {

constexpr int kStyleOfTwins = 5, kStyleOfHorizon = 11;  ///< black, and black and dashed

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

}  // namespace

std::optional<double> find_horizon(const PairStudy& study) {
    if (study.twin_traces.empty()) return std::nullopt;
    const Yardstick yardstick = study.yardstick();
    return yardstick.is_within_run() ? std::optional(yardstick.horizon()) : std::nullopt;
}

std::string name_horizon(double horizon) { return fmt::format("horizon, {:.3g} s", horizon); }

Departure find_departure(const PairStudy& study) {
    Departure departure{.time = study.prototype.history.time, .twins = study.twin_traces.size()};
    for (const PairedRun& model : study.models) departure.models.push_back({model.label, model.trace.running});
    if (study.half_step) departure.models.push_back({"half the step", study.half_step->trace.running});
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
    if (departure.twins > 0) {
        PlotSeries twins = make_series(fmt::format("{} twins", departure.twins), departure.twins_high, departure.time);
        twins.y_low = departure.twins_low;
        twins.y_low.resize(twins.y.size());
        twins.style = kStyleOfTwins;
        plot.series.push_back(std::move(twins));
    }
    for (const Departure::Curve& curve : departure.models) plot.series.push_back(make_series(curve.label, curve.running, departure.time));
    if (departure.horizon) {
        PlotSeries horizon;
        horizon.label = name_horizon(*departure.horizon);
        horizon.x = {*departure.horizon, *departure.horizon};
        horizon.y = {find_least(plot), 1.0};
        horizon.style = kStyleOfHorizon;
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

}  // namespace musim::lsdem
