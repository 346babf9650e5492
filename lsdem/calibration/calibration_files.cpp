#include "lsdem/calibration/calibration_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>

#include "lsdem/plot/line_plot.hpp"
#include "scaling/angle.hpp"

namespace musim::lsdem {
namespace {

using scaling::kDegree;
constexpr std::size_t kMostRows = 2000, kMostPoints = 400;
constexpr std::size_t kLayersPerCurve = 5;

/// Every so-many-th of `count` samples, so that at most `most` are left.
std::size_t find_stride(std::size_t count, std::size_t most) { return std::max<std::size_t>(1, (count + most - 1) / most); }

}  // namespace

std::string make_wave_csv(const WaveHistory& history) {
    std::string csv = "time_s,base_m";
    for (std::size_t n = 1; n <= history.displacement.size(); ++n) fmt::format_to(std::back_inserter(csv), ",layer{}_m", n);
    csv += '\n';
    for (std::size_t k = 0; k < history.time.size(); k += find_stride(history.time.size(), kMostRows)) {
        fmt::format_to(std::back_inserter(csv), "{},{}", history.time[k], history.base_velocity * history.time[k]);
        for (const auto& layer : history.displacement) fmt::format_to(std::back_inserter(csv), ",{}", layer[k]);
        csv += '\n';
    }
    return csv;
}

std::string make_wave_svg(const WaveHistory& history, const BlockSample& sample, const std::string& title, const WaveSpeed& speed) {
    LinePlot plot{.title = title,
                  .subtitle = fmt::format("{:.1f} m/s effective, {:.1f} +- {:.1f} m/s by the criterion, layers {} to {}; base {:.4g} m/s",
                                          speed.effective(), speed.speed, speed.standard_error, speed.first_layer, speed.last_layer,
                                          history.base_velocity),
                  .x_label = "time [ms]",
                  .y_label = "displacement [1e-6 block heights]",
                  .y_from_zero = true};
    const std::size_t stride = find_stride(history.time.size(), kMostPoints);
    const auto add = [&](const std::string& label, const auto& value) {
        PlotSeries series{.label = label};
        for (std::size_t k = 0; k < history.time.size(); k += stride) {
            series.x.push_back(1e3 * history.time[k]);
            series.y.push_back(1e6 * value(k) / sample.size.z());
        }
        plot.series.push_back(std::move(series));
    };
    add("base", [&](std::size_t k) { return history.base_velocity * history.time[k]; });
    const std::size_t top = history.displacement.size();
    for (std::size_t n = kLayersPerCurve; n <= top; n += kLayersPerCurve) {
        add(fmt::format("layer {}", n), [&](std::size_t k) { return history.displacement[n - 1][k]; });
    }
    if (top % kLayersPerCurve != 0) {
        add(fmt::format("layer {} (top)", top), [&](std::size_t k) { return history.displacement[top - 1][k]; });
    }
    return make_svg(plot);
}

std::string downhill_edge(const TiltCase& test) {
    if (test.side == TiltSide::wide) return "w";
    return test.pose == TiltPose::lying ? "H" : "b";
}

std::string make_tilt_csv(const std::vector<TiltCase>& cases, const std::vector<TiltResult>& results) {
    std::string csv =
        "pose,support,downhill,event,angle_deg,half_interval_deg,tangent,expected_slip_deg,expected_topple_deg,"
        "expected_topple_on_springs_deg\n";
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const TiltResult& r = results[i];
        fmt::format_to(std::back_inserter(csv), "{},{},{},{},{},{},{},{},{},{}\n", to_string(cases[i].pose), to_string(cases[i].support),
                       downhill_edge(cases[i]), to_string(r.event), r.angle() / kDegree, 0.5 * (r.high - r.low) / kDegree, r.friction(),
                       r.expected_slip / kDegree, r.expected_fall / kDegree, r.expected_fall_on_springs / kDegree);
    }
    return csv;
}

std::optional<double> find_published_ratio(double start) {
    struct Measured {
        double degrees, ratio;
    };
    constexpr std::array<Measured, 3> kMeasured{{{22.0, 0.6}, {11.0, 0.5}, {6.0, 0.25}}};
    for (const Measured& m : kMeasured) {
        if (std::abs(start - m.degrees * kDegree) < 0.01 * kDegree) return m.ratio;
    }
    return std::nullopt;
}

std::string make_rocking_svg(const BlockSample& sample, const std::vector<RockingCurve>& curves, RockingSupport support) {
    LinePlot plot{
        .title = fmt::format("Rocking on {}: energy kept at an impact", support == RockingSupport::ground ? "the ground" : "two blocks"),
        .subtitle = "mean over up to five impacts; horizontal lines: Housner, no bounce; and Harmon et al. 2023 on wood",
        .x_label = "coefficient of restitution C_res",
        .y_label = "energy after over before",
        .y_from_zero = true};
    double low = 1.0, high = 0.0;
    for (const RockingCurve& curve : curves) {
        if (curve.support != support) continue;
        PlotSeries series{.label = fmt::format("{} side, {:.4g} degrees", to_string(curve.side), curve.start / kDegree),
                          .x = curve.restitution,
                          .marks = true};
        for (const RockingResult& r : curve.result) series.y.push_back(r.mean);
        low = std::min(low, curve.restitution.front());
        high = std::max(high, curve.restitution.back());
        plot.series.push_back(std::move(series));
    }
    const auto add_level = [&](const std::string& label, double level, int style) {
        plot.series.push_back({.label = label, .x = {low, high}, .y = {level, level}, .style = style});
    };
    // the dashed styles of the plot begin at 6
    for (const RockingSide side : {RockingSide::thin, RockingSide::wide}) {
        add_level(fmt::format("Housner, {} {:.3f}", to_string(side), housner_ratio(sample, side)), housner_ratio(sample, side),
                  side == RockingSide::thin ? 6 : 7);
    }
    for (const double degrees : {22.0, 11.0, 6.0}) {
        add_level(fmt::format("wood, {} degrees: {}", degrees, *find_published_ratio(degrees * kDegree)),
                  *find_published_ratio(degrees * kDegree), 17);
    }
    return make_svg(plot);
}

}  // namespace musim::lsdem
