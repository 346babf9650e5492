#include "lsdem/run/run_progress.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "lsdem/results/spine_measures.hpp"

namespace musim::lsdem {
namespace {

/// A line of the spine, or the base, as drift sees it.
struct DriftPoint {
    double height = 0.0;
    Eigen::Vector2d moved = Eigen::Vector2d::Zero();
};

double drift_between(const DriftPoint& lower, const DriftPoint& upper) {
    const double rise = upper.height - lower.height;
    return rise > 0.0 ? (upper.moved - lower.moved).norm() / rise : 0.0;
}

}  // namespace

double find_largest_drift(const RunResult& run, std::size_t sample) {
    const History& history = run.history;
    const std::size_t count = run.spine.size();
    DriftPoint lower{.height = 0.0, .moved = (history.base[sample].displacement - history.base.front().displacement).head<2>()};
    double largest = 0.0;
    for (std::size_t s = 0; s < count; ++s) {
        const Vector3& start = history.spine_position[s];
        const DriftPoint upper{.height = start.z(), .moved = (history.spine_position[sample * count + s] - start).head<2>()};
        largest = std::max(largest, drift_between(lower, upper));
        lower = upper;
    }
    return largest;
}

std::vector<double> thin_extremes(const std::vector<double>& history, std::size_t count) {
    if (history.size() <= count) return history;
    std::vector<double> thinned;
    thinned.reserve(count);
    const auto at = [&](std::size_t part) { return history.begin() + static_cast<std::ptrdiff_t>(part * history.size() / count); };
    for (std::size_t part = 0; part < count; ++part) {
        thinned.push_back(*std::max_element(at(part), at(part + 1), [](double a, double b) { return std::abs(a) < std::abs(b); }));
    }
    return thinned;
}

RunProgress observe_run(const RunResult& run, const TimePlan& plan) {
    const History& history = run.history;
    RunProgress progress;
    progress.duration = plan.duration();
    progress.stage = run.origin ? run.origin->stage + 1 : 1;
    progress.blocks = run.falls.time.size();
    progress.fallen =
        static_cast<std::size_t>(std::count_if(run.falls.time.begin(), run.falls.time.end(), [](double t) { return !std::isnan(t); }));
    progress.collapsed = run.collapse_time.has_value();
    if (history.samples() == 0) return progress;
    progress.time = history.time.back();
    progress.kinetic_energy = history.energy.back().kinetic;
    const std::size_t count = run.spine.size();
    if (count == 0) return progress;
    progress.axis = find_strongest_axis(history);
    progress.drift = find_largest_drift(run, history.samples() - 1);
    std::vector<double> top;
    top.reserve(history.samples());
    for (std::size_t k = 0; k < history.samples(); ++k) top.push_back(history.spine_velocity[k * count + count - 1][progress.axis]);
    progress.top_velocity = thin_extremes(top, kProgressPoints);
    return progress;
}

nlohmann::json to_json(const RunProgress& progress) {
    return {{"time_s", progress.time},         {"duration_s", progress.duration},
            {"stage", progress.stage},         {"kinetic_energy_J", progress.kinetic_energy},
            {"largest_drift", progress.drift}, {"blocks", progress.blocks},
            {"fallen", progress.fallen},       {"collapsed", progress.collapsed},
            {"axis", progress.axis},           {"top_velocity_m_s", progress.top_velocity}};
}

RunProgress parse_progress_run(const nlohmann::json& json) {
    RunProgress progress;
    json.at("time_s").get_to(progress.time);
    json.at("duration_s").get_to(progress.duration);
    json.at("stage").get_to(progress.stage);
    json.at("kinetic_energy_J").get_to(progress.kinetic_energy);
    json.at("largest_drift").get_to(progress.drift);
    json.at("blocks").get_to(progress.blocks);
    json.at("fallen").get_to(progress.fallen);
    json.at("collapsed").get_to(progress.collapsed);
    json.at("axis").get_to(progress.axis);
    json.at("top_velocity_m_s").get_to(progress.top_velocity);
    return progress;
}

}  // namespace musim::lsdem
