#include "lsdem/response/response.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>

#include "lsdem/results/base_frame.hpp"
#include "lsdem/results/summary.hpp"
#include "lsdem/scene/reference_block.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "scaling/angle.hpp"
#include "scaling/json_optional.hpp"

namespace musim::lsdem {
namespace {

using scaling::kDegree;

/// First and one past the last sample of the window.
std::array<std::size_t, 2> find_samples(const StoredRun& run, const ResponseSettings& settings) {
    const std::vector<double>& time = run.history.time;
    if (!settings.window) return {0, time.size()};
    const auto first = std::lower_bound(time.begin(), time.end(), (*settings.window)[0]);
    const auto last = std::upper_bound(time.begin(), time.end(), (*settings.window)[1]);
    if (last - first < 2) {
        throw ResultError(
            fmt::format("{}: the window from {} s to {} s holds fewer than two samples (the run goes from 0 to {} s); widen it",
                        run.directory.string(), (*settings.window)[0], (*settings.window)[1], time.back()));
    }
    return {static_cast<std::size_t>(first - time.begin()), static_cast<std::size_t>(last - time.begin())};
}

/// The spine's velocities from the lowest level up, without those by which the base turns it; of blocks at one height only the first, as in
/// a list of blocks side by side.
Receivers make_receivers(const StoredRun& run, int axis, const std::array<std::size_t, 2>& samples) {
    const History& history = run.history;
    const std::size_t ns = run.spine.size();
    Receivers receivers;
    receivers.dt = (history.time.back() - history.time.front()) / static_cast<double>(std::max<std::size_t>(1, history.samples() - 1));
    for (const std::size_t s : sort_spine_by_height(run)) {
        const double height = history.spine_position[s].z();
        // levels are a block height apart; less than half of one is the same level
        const double apart = 0.5 * run.blocks.size[run.spine.block[s]].z();
        if (!receivers.height.empty() && height - receivers.height.back() < apart) continue;
        receivers.height.push_back(height);
        receivers.velocity.emplace_back();
        for (std::size_t k = samples[0]; k < samples[1]; ++k) {
            const std::size_t at = k * ns + s;
            receivers.velocity.back().push_back(
                find_unturned_velocity(history.base[k], history.spine_position[at], history.spine_velocity[at])[axis]);
        }
    }
    return receivers;
}

SpeedScales find_scales(const StoredRun& run, int axis) {
    Scene scene;
    try {
        scene = parse_scene(run.scene, run.directory / "result.h5");
    } catch (const SceneError& error) {
        throw ResultError(std::string(error.what()) + " (the scene that the results carry)");
    }
    SpeedScales scales{.friction = scene.material.friction, .gravity = 0.0, .height = 0.0, .elastic_speed = 0.0};
    for (const auto& g : scene.gravity) scales.gravity = std::hypot(scales.gravity, g.value());
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t b = 0; b < run.blocks.size.size(); ++b) {
        const BlockReach reach = run.blocks.find_reach(b, run.initial.orientation[b]);
        low = std::min(low, run.initial.position[b].z() - reach.below.z());
        high = std::max(high, run.initial.position[b].z() + reach.above.z());
    }
    scales.height = high - low;
    if (run.spine.size() > 0) {
        const std::size_t block = run.spine.block.front();
        const double stiffness = axis == 2 ? scene.material.normal_stiffness.value() : scene.material.shear_stiffness.value();
        const Triple<scaling::Length> reference = reference_block(scene);
        const Vector3& size = run.blocks.size[block];
        const double bases = (size.x() * size.y()) / (reference[0] * reference[1]).value();
        scales.elastic_speed = size.z() * std::sqrt(stiffness * bases / run.blocks.mass[block]);
    }
    return scales;
}

nlohmann::json to_array(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

nlohmann::json to_json(const SpeedEstimate& estimate, const SpeedScales& scales) {
    nlohmann::json object{{"method", estimate.method}, {"speed_m_s", nullptr},    {"speed_error_m_s", nullptr},
                          {"s_number", nullptr},       {"over_elastic", nullptr}, {"levels", estimate.height.size()}};
    object["slowness_s_m"] = scaling::or_null(estimate.slowness);
    object["slowness_error_s_m"] = estimate.slowness ? nlohmann::json(estimate.slowness_error) : nlohmann::json();
    object["why"] = estimate.why.empty() ? nlohmann::json() : nlohmann::json(estimate.why);
    if (!estimate.speed) return object;
    object["speed_m_s"] = *estimate.speed;
    object["speed_error_m_s"] = estimate.speed_error;
    if (scales.sliding_speed() > 0.0) object["s_number"] = *estimate.speed / scales.sliding_speed();
    if (scales.elastic_speed > 0.0) object["over_elastic"] = *estimate.speed / scales.elastic_speed;
    return object;
}

nlohmann::json to_json(const Spread& spread, double unit = 1.0) { return {{"mean", spread.mean / unit}, {"max", spread.max / unit}}; }

/// `share`: of what all levels dissipated.
nlohmann::json to_json(const std::optional<PairWork>& loss, double share) {
    if (!loss) return nullptr;
    return {{"friction_J", loss->friction}, {"damping_J", loss->damping}, {"share", share}};
}

nlohmann::json to_json(const LevelDamage& l, const Damage& damage) {
    return {{"level", l.level},
            {"blocks", l.blocks},
            {"fallen", l.fallen},
            {"slip_m", to_json(l.slip)},
            {"residual_displacement_m", to_json(l.displacement)},
            {"initial_tilt_deg", to_json(l.initial_tilt, kDegree)},
            {"final_tilt_deg", to_json(l.final_tilt, kDegree)},
            {"rotation_deg", to_json(l.rotation, kDegree)},
            {"turn_deg", to_json(l.turn, kDegree)},
            {"damage_index", l.index},
            {"loss", to_json(l.loss, l.loss ? find_loss_share(l, damage) : 0.0)}};
}

/// A tenth more than the elastic speed: arrivals by a threshold come a few percent early [-].
constexpr double kFastest = 1.1;

/// Leaves no speed faster than elastic waves: nothing travels faster, motion arrives everywhere at once then.
void drop_impossible(std::vector<SpeedEstimate>& speeds, const SpeedScales& scales) {
    for (SpeedEstimate& estimate : speeds) {
        if (!estimate.speed || !(scales.elastic_speed > 0.0) || *estimate.speed <= kFastest * scales.elastic_speed) continue;
        estimate.why = fmt::format(
            "{:.3g} m/s would be above the elastic speed of {:.3g} m/s (motion arrives everywhere at once, as far as "
            "the samples show)",
            *estimate.speed, scales.elastic_speed);
        estimate.speed.reset();
    }
}

}  // namespace

double SpeedScales::sliding_speed() const { return std::sqrt(friction * gravity * height); }

Response measure_response(const StoredRun& run, const ResponseSettings& settings) {
    Response response;
    response.axis = settings.axis.value_or(find_strongest_axis(run.history));
    response.pga = run.peak_base_acceleration;
    response.base_changes = run.base_changes;
    response.scales = find_scales(run, response.axis);
    const auto samples = find_samples(run, settings);
    double base_peak = 0.0;
    for (std::size_t k = samples[0]; k < samples[1]; ++k)
        base_peak = std::max(base_peak, std::abs(run.history.base[k].velocity[response.axis]));
    SpeedSettings speed;
    speed.threshold = settings.threshold;
    if (base_peak > 0.0) speed.reference_peak = base_peak;
    // a run that ended where it began has no motion to travel
    if (samples[1] - samples[0] > 1) response.speeds = estimate_speeds(make_receivers(run, response.axis, samples), speed);
    drop_impossible(response.speeds, response.scales);
    response.spine = measure_spine(run, response.axis);
    response.damage = assess_damage(run);
    response.status = run.status;
    response.collapse_time = run.collapse_time;
    response.collapsed_before = run.collapsed_before();
    response.failure = find_failure(run);
    return response;
}

nlohmann::json to_json(const Response& response) {
    nlohmann::json speeds = nlohmann::json::array(), spine = nlohmann::json::array(), levels = nlohmann::json::array();
    for (const SpeedEstimate& estimate : response.speeds) speeds.push_back(to_json(estimate, response.scales));
    for (const SpineLevel& l : response.spine) {
        spine.push_back({{"level", l.level},
                         {"name", l.name.empty() ? nlohmann::json() : nlohmann::json(l.name)},
                         {"height_m", l.height},
                         {"residual_displacement_m", to_array(l.residual_displacement)},
                         {"peak_displacement_m", to_array(l.peak_displacement)},
                         {"peak_velocity_m_s", to_array(l.peak_velocity)},
                         {"in_plane_rotation_peak_deg", l.in_plane_peak / kDegree},
                         {"in_plane_rotation_residual_deg", l.in_plane_residual / kDegree},
                         {"vertical_rotation_peak_deg", l.vertical_peak / kDegree},
                         {"vertical_rotation_residual_deg", l.vertical_residual / kDegree}});
    }
    for (const LevelDamage& level : response.damage.levels) levels.push_back(to_json(level, response.damage));
    return {{"status", to_string(response.status)},
            {"collapse_time_s", scaling::or_null(response.collapse_time)},
            {"failure", response.failure ? to_json(*response.failure) : nlohmann::json()},
            {"axis", axis_name(response.axis)},
            {"pga_g", to_array(response.pga / scaling::kStandardGravity.value())},
            {"base_changes", to_json(response.base_changes)},
            {"speeds", speeds},
            {"elastic_speed_m_s", response.scales.elastic_speed},
            {"sliding_speed_m_s", response.scales.sliding_speed()},
            {"height_m", response.scales.height},
            {"spine", spine},
            {"levels", levels},
            {"blocks", response.damage.blocks},
            {"fallen_blocks", response.damage.fallen},
            {"damage_index", response.damage.index},
            {"loss", to_json(response.damage.loss, 1.0)}};
}

std::string make_spine_levels_csv(const Response& response) {
    std::string csv =
        "level,height_m,residual_x_m,residual_y_m,residual_z_m,peak_x_m,peak_y_m,peak_z_m,peak_vx_m_s,peak_vy_m_s,peak_vz_m_s,in_plane_"
        "peak_deg,"
        "in_plane_residual_deg,vertical_peak_deg,vertical_residual_deg,name\n";
    for (const SpineLevel& l : response.spine) {
        fmt::format_to(std::back_inserter(csv), "{},{}", l.level, l.height);
        for (const Vector3& v : {l.residual_displacement, l.peak_displacement, l.peak_velocity})
            fmt::format_to(std::back_inserter(csv), ",{},{},{}", v.x(), v.y(), v.z());
        for (const double angle : {l.in_plane_peak, l.in_plane_residual, l.vertical_peak, l.vertical_residual})
            fmt::format_to(std::back_inserter(csv), ",{}", angle / kDegree);
        fmt::format_to(std::back_inserter(csv), ",{}\n", l.name);
    }
    return csv;
}

LinePlot make_residual_plot(const Response& response, const std::string& name, double length) {
    LinePlot plot = make_level_plot("Residual displacement of the spine, relative to the base", name, "displacement [mm]");
    for (int axis = 0; axis < 3; ++axis) {
        plot.series.push_back(make_level_series("along " + axis_name(axis), response.spine,
                                                [&](const SpineLevel& l) { return 1e3 * l.residual_displacement[axis] / length; }));
    }
    return plot;
}

LinePlot make_rotation_plot(const Response& response, const std::string& name) {
    LinePlot plot = make_level_plot("Rotation of the spine's blocks, relative to the start", name, "rotation [degrees]");
    const auto add = [&](const char* label, double SpineLevel::*angle) {
        plot.series.push_back(make_level_series(label, response.spine, [&](const SpineLevel& l) { return l.*angle / kDegree; }));
    };
    add("in plane, peak", &SpineLevel::in_plane_peak);
    add("in plane, residual", &SpineLevel::in_plane_residual);
    add("vertical axis, peak", &SpineLevel::vertical_peak);
    add("vertical axis, residual", &SpineLevel::vertical_residual);
    return plot;
}

LinePlot make_lag_plot(const Response& response, const std::string& name) {
    LinePlot plot{.title = fmt::format("Arrival along {} over height", axis_name(response.axis)),
                  .subtitle = name,
                  .x_label = "height above the lowest level of the spine [m]",
                  .y_label = "lag [ms]",
                  .y_from_zero = true};
    for (const SpeedEstimate& estimate : response.speeds) {
        const std::string speed = estimate.speed ? fmt::format(" {:.4g} m/s", *estimate.speed) : "";
        PlotSeries series{.label = estimate.method + speed, .x = estimate.height, .y = estimate.lag, .marks = true, .line = false};
        for (double& lag : series.y) lag *= 1e3;
        plot.series.push_back(std::move(series));
    }
    return plot;
}

}  // namespace musim::lsdem
