#include "lsdem/study/compare_ensembles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "lsdem/response/response.hpp"
#include "lsdem/results/folder_contents.hpp"
#include "lsdem/results/hdf5_reader.hpp"
#include "lsdem/results/result_error.hpp"
#include "lsdem/study/pair_plots.hpp"
#include "scaling/error.hpp"
#include "scaling/json_text.hpp"

namespace musim::lsdem {
namespace {

/// Mean, deviation and count of one level at one time.
struct Point {
    double mean = 0.0, sd = 0.0;
    int count = 0;
};

Point at_sample(const DimensionlessBands& ensemble, int axis, std::size_t level, std::size_t k) {
    const Bands& bands = ensemble.bands;
    const std::size_t i = k * bands.levels() + level;
    return {bands.mean[i][axis], bands.sd[i][axis], bands.count[k]};
}

/// Linear between the samples about `time`, which lies among them.
Point at_time(const DimensionlessBands& ensemble, int axis, std::size_t level, double time) {
    const std::vector<double>& times = ensemble.bands.time;
    const auto after = static_cast<std::size_t>(std::lower_bound(times.begin(), times.end(), time) - times.begin());
    const Point right = at_sample(ensemble, axis, level, after);
    if (after == 0) return right;
    const Point left = at_sample(ensemble, axis, level, after - 1);
    const double part = (time - times[after - 1]) / (times[after] - times[after - 1]);
    return {left.mean + part * (right.mean - left.mean), left.sd + part * (right.sd - left.sd), std::min(left.count, right.count)};
}

std::vector<Vector3> to_vectors(const std::vector<double>& values, double unit) {
    std::vector<Vector3> vectors;
    for (std::size_t i = 0; i + 2 < values.size(); i += 3) vectors.emplace_back(Vector3(values[i], values[i + 1], values[i + 2]) / unit);
    return vectors;
}

[[noreturn]] void refuse_other(const detail::Hdf5Reader& file) { file.fail("is no ensemble; name the directory of one"); }

/// 0, 1, 2 for "x", "y", "z".
int find_axis(const std::string& name) {
    constexpr std::string_view kAxes = "xyz";
    const std::size_t axis = name.size() == 1 ? kAxes.find(name) : std::string_view::npos;
    if (axis == std::string_view::npos) throw scaling::ParseError("no axis");
    return static_cast<int>(axis);
}

}  // namespace

DimensionlessBands read_bands(const std::filesystem::path& directory) {
    require_complete(directory);
    const detail::Hdf5Reader file(directory / "ensemble.h5");
    DimensionlessBands ensemble;
    ensemble.name = directory.string();
    double speed = 0.0, height = 0.0;
    try {
        const auto summary = scaling::parse_json_text(file.attribute("summary"));
        if (summary.at("format") != "musim-ensemble/1") throw scaling::ParseError("another format");
        speed = summary.at("scales").value("sliding_speed_m_s", 0.0);
        height = summary.at("scales").value("height_m", 0.0);
        ensemble.axis = find_axis(summary.value("axis", "x"));
    } catch (const scaling::ParseError&) {
        refuse_other(file);
    } catch (const nlohmann::json::exception&) {
        refuse_other(file);
    }
    if (!(speed > 0.0 && height > 0.0)) {
        file.fail("has no friction or gravity (velocities are compared over sqrt(mu g l)); name another one");
    }
    Bands& bands = ensemble.bands;
    for (const double t : file.read<double>("/time", 1).values) bands.time.push_back(t * speed / height);
    for (const long long level : file.read<long long>("/spine/level", 1).values) bands.level.push_back(static_cast<int>(level));
    for (const long long count : file.read<long long>("/count", 1).values) bands.count.push_back(static_cast<int>(count));
    bands.mean = to_vectors(file.read<double>("/spine/velocity_mean", 3).values, speed);
    bands.sd = to_vectors(file.read<double>("/spine/velocity_sd", 3).values, speed);
    const std::size_t values = bands.samples() * bands.levels();
    if (bands.count.size() != bands.samples() || bands.mean.size() != values || bands.sd.size() != values) {
        file.fail("its datasets differ in size (it is damaged); run the ensemble again");
    }
    return ensemble;
}

BandOverlap compare_bands(const DimensionlessBands& first, const DimensionlessBands& second) {
    if (first.bands.level != second.bands.level) {
        throw ResultError(first.name + " and " + second.name + ": their spines have other levels; compare ensembles of one structure");
    }
    BandOverlap overlap;
    std::size_t in_sd = 0, in_error = 0;
    for (std::size_t k = 0; k < first.bands.samples(); ++k) {
        const double time = first.bands.time[k];
        if (second.bands.time.empty() || time < second.bands.time.front() || time > second.bands.time.back()) continue;
        for (std::size_t level = 0; level < first.bands.levels(); ++level) {
            const Point a = at_sample(first, first.axis, level, k), b = at_time(second, first.axis, level, time);
            if (a.count < 2 || b.count < 2) continue;
            const double apart = std::abs(a.mean - b.mean);
            ++overlap.points;
            in_sd += apart <= a.sd ? 1 : 0;
            in_error += apart <= 2.0 * std::sqrt(a.sd * a.sd / a.count + b.sd * b.sd / b.count) ? 1 : 0;
        }
    }
    if (overlap.points == 0) {
        throw ResultError(first.name + " and " + second.name + ": at no time do both have two members; run more, or longer");
    }
    overlap.within_sd = static_cast<double>(in_sd) / static_cast<double>(overlap.points);
    overlap.within_error = static_cast<double>(in_error) / static_cast<double>(overlap.points);
    return overlap;
}

StackedPlot make_bands_plot(const std::vector<DimensionlessBands>& ensembles) {
    const DimensionlessBands& first = ensembles.front();
    const std::vector<std::size_t> rows = choose_rows(first.bands.levels());
    StackedPlot plot{.title = "Spine velocities: mean and mean ± standard deviation",
                     .subtitle = ensembles.size() == 1 ? first.name : fmt::format("{} ensembles", ensembles.size()),
                     .x_label = "t √(μ g / l)",
                     .y_label = fmt::format("v / √(μ g l) along {}, one row per level", axis_name(first.axis))};
    for (const std::size_t row : rows) plot.row_labels.push_back(fmt::format("level {}", first.bands.level[row]));
    for (const DimensionlessBands& ensemble : ensembles) {
        const Bands& bands = ensemble.bands;
        if (bands.level != first.bands.level) continue;
        PlotCurves& curves = plot.runs.emplace_back(PlotCurves{.label = ensemble.name, .x = bands.time});
        for (const std::size_t row : rows) {
            std::vector<double>&mean = curves.y.emplace_back(), &sd = curves.spread.emplace_back();
            for (std::size_t k = 0; k < bands.samples(); ++k) {
                mean.push_back(bands.mean[k * bands.levels() + row][first.axis]);
                sd.push_back(bands.sd[k * bands.levels() + row][first.axis]);
            }
        }
    }
    return plot;
}

nlohmann::json to_json(const BandOverlap& overlap) {
    return {{"points", overlap.points}, {"within_sd", overlap.within_sd}, {"within_error", overlap.within_error}};
}

}  // namespace musim::lsdem
