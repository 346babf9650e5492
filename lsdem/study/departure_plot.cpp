#include "lsdem/study/departure_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace musim::lsdem::study {
namespace {

constexpr int kStyleOfTwins = 5, kStyleOfHorizon = 11;  ///< black, and black and dashed

PlotSeries make_series(const std::string& label, const RunTrace& trace, const std::vector<double>& time) {
    PlotSeries series;
    series.label = label;
    for (std::size_t k = 0; k < std::min(trace.running.size(), time.size()); ++k) {
        series.x.push_back(time[k]);
        series.y.push_back(trace.running[k]);
    }
    return series;
}

/// The smallest value that a logarithmic axis shows.
double find_least(const LinePlot& plot) {
    double least = 1.0;
    for (const PlotSeries& series : plot.series) {
        for (const double value : series.y) least = value > 0.0 ? std::min(least, value) : least;
    }
    return least;
}

}  // namespace

LinePlot make_departure_plot(const PairStudy& study, const std::string& name) {
    LinePlot plot{.title = "Departure from the prototype",
                  .subtitle = name,
                  .x_label = "time of the prototype [s]",
                  .y_label = "largest difference so far / peak velocity",
                  .series = {}};
    plot.y_logarithmic = true;
    const std::vector<double>& time = study.prototype.history.time;
    for (std::size_t i = 0; i < study.twin_traces.size(); ++i) {
        PlotSeries twin = make_series(i == 0 ? fmt::format("{} twins", study.twin_traces.size()) : "", study.twin_traces[i], time);
        twin.style = kStyleOfTwins;
        plot.series.push_back(std::move(twin));
    }
    for (const PairedRun& model : study.models) plot.series.push_back(make_series(model.label, model.trace, time));
    if (study.half_step) plot.series.push_back(make_series("half the step", study.half_step->trace, time));
    const Yardstick yardstick = study.yardstick();
    if (yardstick.is_within_run()) {
        PlotSeries horizon;
        horizon.label = fmt::format("horizon, {:.3g} s", yardstick.horizon());
        horizon.x = {yardstick.horizon(), yardstick.horizon()};
        horizon.y = {find_least(plot), 1.0};
        horizon.style = kStyleOfHorizon;
        plot.series.push_back(std::move(horizon));
    }
    return plot;
}

}  // namespace musim::lsdem::study
