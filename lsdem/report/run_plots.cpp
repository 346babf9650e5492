#include "lsdem/report/run_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <optional>

#include "lsdem/report/json_parts.hpp"
#include "lsdem/study/pair_plots.hpp"
#include "scaling/angle.hpp"

namespace musim::lsdem {
namespace {

using scaling::kDegree;

bool are_of_several_scales(const std::vector<ReportedRun>& runs) {
    return std::any_of(runs.begin(), runs.end(),
                       [&](const ReportedRun& run) { return run.run.similitude.length() != runs.front().run.similitude.length(); });
}

/// Subtitle of a plot: whose it is.
std::string describe_runs(const std::vector<ReportedRun>& runs) {
    if (runs.size() == 1) return runs.front().label;
    return are_of_several_scales(runs) ? fmt::format("scaled back to {}", runs.front().label) : fmt::format("{} runs", runs.size());
}

/// Name of a figure of one run: its label with all but letters and digits as underscores.
std::string name_figure(const std::string& what, const std::string& label) {
    std::string name = what + "_" + label;
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return name;
}

/// A value of every level over the level, one series for each run that was measured.
ReportFigure make_level_figure(const std::string& name, const std::string& title, const std::string& x_label,
                               const std::vector<ReportedRun>& runs,
                               const std::function<double(const LevelDamage&, const ReportedRun&)>& value) {
    LinePlot plot = make_level_plot(title, describe_runs(runs), x_label);
    plot.of_runs = true;
    for (std::size_t r = 0; r < runs.size(); ++r) {
        if (!runs[r].response) continue;
        plot.series.push_back(make_level_series(runs[r].label, runs[r].response->damage.levels,
                                                [&](const LevelDamage& level) { return value(level, runs[r]); }));
        plot.series.back().style = static_cast<int>(r);
    }
    return make_figure(name, plot);
}

/// One figure of a run alone, its three directions beside each other; of several runs one for each direction in which any was displaced.
std::vector<ReportFigure> make_residual_figures(const std::vector<ReportedRun>& runs) {
    const std::string name = "residual_displacement";
    if (runs.size() == 1) {
        return {make_figure(name, make_residual_plot(*runs.front().response, describe_runs(runs), runs.front().run.similitude.length()))};
    }
    std::vector<ReportFigure> figures;
    for (const int axis : {0, 1, 2}) {
        LinePlot plot = make_level_plot(fmt::format("Residual displacement of the spine along {}, relative to the base", axis_name(axis)),
                                        describe_runs(runs), "displacement [mm]");
        plot.of_runs = true;
        bool is_displaced = false;
        for (std::size_t r = 0; r < runs.size(); ++r) {
            if (!runs[r].response) continue;
            const double length = runs[r].run.similitude.length();
            plot.series.push_back(make_level_series(runs[r].label, runs[r].response->spine, [&](const SpineLevel& level) {
                return 1e3 * level.residual_displacement[axis] / length;
            }));
            plot.series.back().style = static_cast<int>(r);
            const std::vector<double>& x = plot.series.back().x;
            is_displaced = is_displaced || std::any_of(x.begin(), x.end(), [](double value) { return value != 0.0; });
        }
        if (is_displaced || axis == 0) figures.push_back(make_figure(fmt::format("{}_{}", name, axis_name(axis)), plot));
    }
    return figures;
}

/// Tilts below this are rounding: blocks stand upright [rad].
constexpr double kUpright = 1e-9;

/// The tilts' distribution in one run, their means in several; nothing where all blocks stand upright.
std::optional<ReportFigure> make_initial_tilt_figure(const std::vector<ReportedRun>& runs) {
    const bool is_any_tilted = std::any_of(runs.begin(), runs.end(), [](const ReportedRun& run) {
        const std::vector<Quaternion>& orientations = run.run.initial.orientation;
        return std::any_of(orientations.begin(), orientations.end(), [](const Quaternion& each) { return find_tilt(each) > kUpright; });
    });
    if (!is_any_tilted) return std::nullopt;
    if (runs.size() > 1) {
        return make_level_figure("initial_tilt", "Tilt of the blocks at the start, mean", "tilt [degrees]", runs,
                                 [](const LevelDamage& level, const ReportedRun&) { return level.initial_tilt.mean / kDegree; });
    }
    const StoredRun& run = runs.front().run;
    std::vector<double> tilt;
    for (const Quaternion& orientation : run.initial.orientation) tilt.push_back(find_tilt(orientation));
    return make_tilt_figure("initial_tilt", runs.front().label, run.blocks.layer, tilt);
}

/// The smallest value that at least this share of the sorted values does not exceed.
double find_quantile(const std::vector<double>& sorted, double share) {
    const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
    return sorted[std::max<std::size_t>(rank, 1) - 1];
}

/// A figure over the time of the first run, whose x has so many seconds in one unit.
ReportFigure over_time(ReportFigure figure, double seconds_per_x) {
    figure.seconds_per_x = seconds_per_x;
    return figure;
}

/// Were two runs sampled at the same dimensionless times?
bool samples_alike(const ReportedRun& a, const ReportedRun& b) {
    const History &first = a.run.history, &second = b.run.history;
    if (a.run.spine.size() != b.run.spine.size() || first.samples() < 2 || second.samples() < 2) return false;
    const double interval = first.time[1] - first.time[0];
    const std::size_t last = std::min(first.samples(), second.samples()) - 1;
    // a thousandth of an interval: what differs by more was not sampled at the same times
    return std::abs(second.time[last] / b.run.similitude.time() - first.time[last] / a.run.similitude.time()) <
           1e-3 * interval / a.run.similitude.time();
}

/// The band of the twins that pair.json has; without rows when it has none.
TwinBand read_twin_band(const nlohmann::json& pair) {
    const nlohmann::json kept = find_object(pair, "twins_band");
    TwinBand band{.axis = -1, .rows = {}};
    for (const int axis : {0, 1, 2}) {
        if (find_number(kept, "axis", -1.0) == axis) band.axis = axis;
    }
    for (const nlohmann::json& row : find_list(kept, "half_width_m_s")) band.half_width.push_back(to_numbers(row));
    return band;
}

}  // namespace

std::optional<ReportFigure> make_spine_figure(const std::vector<ReportedRun>& runs, const nlohmann::json& pair) {
    const ReportedRun& first = runs.front();
    if (first.run.spine.size() == 0 || first.run.history.samples() < 2) return std::nullopt;
    const int axis = find_strongest_axis(first.run.history);
    const std::string rows_of = first.run.blocks.is_listed() ? "one row per block" : "one row per level";
    StackedPlot plot{.title = fmt::format("Velocity of the spine along {}", axis_name(axis)),
                     .subtitle = describe_runs(runs),
                     .x_label = "t [s]",
                     .y_label = "v [cm/s], " + rows_of};
    SpineUnits units{.axis = axis, .velocity = 1e2};
    const double sliding = first.response ? first.response->scales.sliding_speed() : 0.0;
    if (are_of_several_scales(runs) && sliding > 0.0) {
        plot.x_label = "t √(μ g / l)";
        plot.y_label = "v / √(μ g l), " + rows_of;
        units.time = sliding / first.response->scales.height;
        units.velocity = 1.0 / sliding;
    }
    const std::vector<std::size_t> rows = choose_rows(first.run.spine.size());
    const std::vector<std::string> labels = label_spine(first.run);
    for (const std::size_t row : rows) plot.row_labels.push_back(labels[row]);
    for (std::size_t r = 0; r < runs.size(); ++r) {
        if (runs[r].run.spine.size() != first.run.spine.size()) continue;
        plot.runs.push_back(make_spine_curves(runs[r].label, runs[r].run, units, rows));
        plot.runs.back().style = static_cast<int>(r);
    }
    add_twin_band(plot, read_twin_band(pair), units);
    return over_time(make_figure("spine_velocity", plot), 1.0 / units.time);
}

std::optional<ReportFigure> make_departure_figure(const std::vector<ReportedRun>& runs, const nlohmann::json& pair,
                                                  const std::string& name) {
    const nlohmann::json kept = find_object(pair, "departure");
    Departure departure{.time = find_numbers(kept, "time_s"),
                        .twins = static_cast<std::size_t>(std::max(0.0, find_number(kept, "twins", 0.0))),
                        .twins_low = find_numbers(kept, "twins_low"),
                        .twins_high = find_numbers(kept, "twins_high")};
    int beyond = static_cast<int>(runs.size());
    for (const nlohmann::json& model : find_list(kept, "models")) {
        const std::string label = find_text(model, "label");
        const auto run = std::find_if(runs.begin(), runs.end(), [&](const ReportedRun& each) { return each.label == label; });
        const int style = run != runs.end() ? static_cast<int>(run - runs.begin()) : beyond++;
        departure.models.push_back({label, find_numbers(model, "largest_difference"), style});
    }
    if (departure.time.empty()) return std::nullopt;
    if (const double horizon = find_number(kept, "horizon_s"); std::isfinite(horizon)) departure.horizon = horizon;
    return over_time(make_figure("departure", make_departure_plot(departure, name)), 1.0);
}

std::optional<ReportFigure> make_difference_figure(const std::vector<ReportedRun>& runs) {
    const ReportedRun& first = runs.front();
    const std::size_t spine = first.run.spine.size();
    const std::vector<Vector3>& of_first = first.run.history.spine_velocity;
    double largest = 0.0;
    for (std::size_t k = 0; k < first.run.history.samples(); ++k) {
        double sum = 0.0;
        for (std::size_t s = 0; s < spine; ++s) sum += of_first[k * spine + s].squaredNorm();
        largest = std::max(largest, sum);
    }
    LinePlot plot{.title = "Difference of velocities over time",
                  .subtitle = fmt::format("root of the sum over the spine, over the largest of {}", first.label),
                  .x_label = fmt::format("t of {} [s]", first.label),
                  .y_label = "difference",
                  .y_logarithmic = true,
                  .of_runs = true,
                  .y_most_decades = 16.0};
    for (std::size_t r = 1; r < runs.size(); ++r) {
        const ReportedRun& model = runs[r];
        if (!(largest > 0.0) || !samples_alike(first, model)) continue;
        PlotSeries series{.label = model.label, .style = static_cast<int>(r)};
        const std::size_t samples = std::min(first.run.history.samples(), model.run.history.samples());
        for (std::size_t k = 0; k < samples; ++k) {
            double sum = 0.0;
            for (std::size_t s = 0; s < spine; ++s) {
                sum += (model.run.history.spine_velocity[k * spine + s] / model.run.similitude.velocity() - of_first[k * spine + s])
                           .squaredNorm();
            }
            series.x.push_back(first.run.history.time[k]);
            series.y.push_back(std::sqrt(sum / largest));
        }
        plot.series.push_back(std::move(series));
    }
    const auto differs = [](const PlotSeries& series) {
        return std::any_of(series.y.begin(), series.y.end(), [](double y) { return y > 0.0; });
    };
    // of series that are zero a logarithmic axis shows nothing
    plot.series.erase(std::remove_if(plot.series.begin(), plot.series.end(), [&](const PlotSeries& series) { return !differs(series); }),
                      plot.series.end());
    if (plot.series.empty()) return std::nullopt;
    return over_time(make_figure("difference", plot), 1.0);
}

std::optional<ReportFigure> make_lag_figure(const ReportedRun& run) {
    if (!run.response) return std::nullopt;
    Response found = *run.response;
    std::erase_if(found.speeds, [](const SpeedEstimate& estimate) { return !estimate.speed; });
    if (found.speeds.empty()) return std::nullopt;
    return make_figure(name_figure("lag", run.label), make_lag_plot(found, run.label));
}

std::vector<ReportFigure> make_profile_figures(const std::vector<ReportedRun>& runs) {
    if (std::none_of(runs.begin(), runs.end(), [](const ReportedRun& run) { return run.response.has_value(); })) return {};
    std::vector<ReportFigure> figures = make_residual_figures(runs);
    figures.push_back(make_level_figure(
        "slip", "Slip below each level at the end, mean", "slip [mm]", runs,
        [](const LevelDamage& level, const ReportedRun& run) { return 1e3 * level.slip.mean / run.run.similitude.length(); }));
    figures.push_back(make_level_figure("rotation", "Rotation of the blocks since the start, mean", "rotation [degrees]", runs,
                                        [](const LevelDamage& level, const ReportedRun&) { return level.rotation.mean / kDegree; }));
    if (std::optional<ReportFigure> tilts = make_initial_tilt_figure(runs)) figures.push_back(std::move(*tilts));
    return figures;
}

ReportFigure make_tilt_figure(const std::string& name, const std::string& whose, const std::vector<int>& layer,
                              const std::vector<double>& tilt) {
    std::map<int, std::vector<double>> levels;
    for (std::size_t b = 0; b < tilt.size(); ++b) {
        if (layer[b] > 0) levels[layer[b]].push_back(tilt[b] / kDegree);
    }
    LinePlot plot = make_level_plot("Tilt of the blocks at the start", whose, "tilt [degrees]");
    const struct {
        const char* label;
        double share;
    } kinds[] = {{"median", 0.5}, {"nine of ten below", 0.9}, {"largest", 1.0}};
    for (const auto& kind : kinds) {
        PlotSeries series{.label = kind.label, .marks = true};
        for (auto& [level, tilts] : levels) {
            std::sort(tilts.begin(), tilts.end());
            series.x.push_back(find_quantile(tilts, kind.share));
            series.y.push_back(level);
        }
        plot.series.push_back(std::move(series));
    }
    return make_figure(name, plot);
}

ReportFigure make_energy_figure(const ReportedRun& run) {
    LinePlot plot{.title = "Energy over time", .subtitle = run.label, .x_label = "t [s]", .y_label = "energy [J]"};
    const History& history = run.run.history;
    const auto add = [&](const std::string& label, const std::function<double(const Energy&)>& value) {
        PlotSeries series{.label = label, .x = history.time};
        for (const Energy& energy : history.energy) series.y.push_back(value(energy));
        plot.series.push_back(std::move(series));
    };
    const double start = history.energy.empty() ? 0.0 : history.energy.front().gravitational;
    add("kinetic", [](const Energy& e) { return e.kinetic; });
    add("gravitational, from the start", [start](const Energy& e) { return e.gravitational - start; });
    add("elastic", [](const Energy& e) { return e.elastic_normal + e.elastic_shear; });
    add("lost by friction", [](const Energy& e) { return e.friction_loss; });
    add("lost in dashpots", [](const Energy& e) { return e.damping_loss; });
    add("work of the base", [](const Energy& e) { return e.base_work; });
    if (!run.run.loads.empty()) add("work of the loads", [](const Energy& e) { return e.load_work; });
    return over_time(make_figure(name_figure("energy", run.label), plot), 1.0);
}

std::optional<ReportFigure> make_loss_figure(const std::vector<ReportedRun>& runs) {
    for (const ReportedRun& run : runs) {
        if (!run.response || !run.response->damage.loss) return std::nullopt;
    }
    return make_level_figure(
        "losses", "Energy dissipated below each level, of all", "share [%]", runs,
        [](const LevelDamage& level, const ReportedRun& run) { return 100.0 * find_loss_share(level, run.response->damage); });
}

}  // namespace musim::lsdem
