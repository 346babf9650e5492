#include "lsdem/study/ensemble_files.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "lsdem/results/result_layout.hpp"
#include "lsdem/study/compare_ensembles.hpp"
#include "scaling/angle.hpp"
#include "scaling/json_optional.hpp"

namespace musim::lsdem {
namespace {

using scaling::kDegree;

/// A single number, or a list.
nlohmann::json values(const Eigen::ArrayXd& array) {
    if (array.size() == 1) return array[0];
    return std::vector<double>(array.begin(), array.end());
}

nlohmann::json to_json(const SampleMoments& moments, double unit = 1.0) {
    return {{"mean", values(moments.mean() / unit)}, {"sd", values(moments.sd() / unit)}, {"count", moments.count()}};
}

nlohmann::json to_json(const LevelMoments& level) {
    return {{"level", level.level},
            {"height_m", to_json(level.height)},
            {"peak_velocity_m_s", to_json(level.peak_velocity)},
            {"peak_displacement_m", to_json(level.peak_displacement)},
            {"residual_displacement_m", to_json(level.residual_displacement)},
            {"rotation_deg", to_json(level.rotation, kDegree)}};
}

nlohmann::json scales_to_json(const SpeedScales& scales) {
    return {{"friction", scales.friction},
            {"gravity_m_s2", scales.gravity},
            {"height_m", scales.height},
            {"sliding_speed_m_s", scales.sliding_speed()},
            {"elastic_speed_m_s", scales.elastic_speed}};
}

std::vector<char> make_ensemble_hdf5(const EnsembleSummary& summary, const std::string& version) {
    const Bands& bands = summary.bands;
    const hsize_t nt = bands.samples(), ns = bands.levels();
    detail::Hdf5File file;
    file.exchange("/time", {nt}, bands.time, "s");
    detail::exchange_base(file, bands.base);
    file.exchange("/count", {nt}, bands.count, "1");
    file.exchange("/spine/level", {ns}, bands.level, "1");
    file.exchange("/spine/velocity_mean", {nt, ns}, bands.mean, "m/s");
    file.exchange("/spine/velocity_sd", {nt, ns}, bands.sd, "m/s");
    file.write_attribute("format", "musim-ensemble/1");
    file.write_attribute("summary", to_json(summary, version).dump());
    return file.image();
}

/// Time, base, count, mean and deviation of every level along the main motion; nothing where a sample gives none.
std::string make_ensemble_csv(const EnsembleSummary& summary) {
    const Bands& bands = summary.bands;
    const std::string axis = axis_name(summary.axis);
    std::string csv = fmt::format("time_s,base_v{}_m_s,count", axis);
    for (const int level : bands.level) fmt::format_to(std::back_inserter(csv), ",mean_v{0}_{1}_m_s,sd_v{0}_{1}_m_s", axis, level);
    csv += '\n';
    const auto add = [&](double value) { csv += std::isfinite(value) ? fmt::format(",{}", value) : ","; };
    for (std::size_t k = 0; k < bands.samples(); ++k) {
        fmt::format_to(std::back_inserter(csv), "{},{},{}", bands.time[k], bands.base[k].velocity[summary.axis], bands.count[k]);
        for (std::size_t s = 0; s < bands.levels(); ++s) {
            add(bands.mean[k * bands.levels() + s][summary.axis]);
            add(bands.sd[k * bands.levels() + s][summary.axis]);
        }
        csv += '\n';
    }
    return csv;
}

}  // namespace

nlohmann::json to_json(const MemberResult& member) {
    nlohmann::json object{{"name", member.name}, {"seed", member.seed}, {"status", to_string(member.status)}};
    if (!member.reason.empty()) object["reason"] = member.reason;
    if (member.collapse_time) object["collapse_time_s"] = *member.collapse_time;
    if (!member.state_hash.empty()) object["state_hash"] = member.state_hash;
    if (!member.response) return object;
    const Response& response = *member.response;
    object["damage_index"] = response.damage.index;
    object["fallen_blocks"] = response.damage.fallen;
    if (!response.spine.empty()) object["top_peak_velocity_m_s"] = response.spine.back().peak_velocity[response.axis];
    for (const SpeedEstimate& estimate : response.speeds) object["speeds_m_s"][estimate.method] = scaling::or_null(estimate.speed);
    return object;
}

nlohmann::json to_json(const EnsembleSummary& summary, const std::string& version) {
    nlohmann::json members = nlohmann::json::array(), levels = nlohmann::json::array(), speeds = nlohmann::json::array(), counts;
    for (const MemberResult& member : summary.members) members.push_back(to_json(member));
    for (const LevelMoments& level : summary.levels) levels.push_back(to_json(level));
    for (const SpeedMoments& speed : summary.speeds) {
        speeds.push_back(to_json(speed.speed));
        speeds.back()["method"] = speed.method;
    }
    for (const MemberStatus status :
         {MemberStatus::completed, MemberStatus::collapsed, MemberStatus::diverged, MemberStatus::unsettled, MemberStatus::failed})
        counts[to_string(status)] = summary.count(status);
    return {{"format", "musim-ensemble/1"},
            {"scene", summary.name},
            {"program_version", version},
            {"axis", axis_name(summary.axis)},
            {"scales", summary.scales ? scales_to_json(*summary.scales) : nlohmann::json()},
            {"counts", counts},
            {"members", members},
            {"spine", levels},
            {"speeds_m_s", speeds},
            {"damage_index", to_json(summary.damage)}};
}

StackedPlot make_ensemble_plot(const EnsembleSummary& summary) {
    const int collapsed = summary.count(MemberStatus::collapsed), members = summary.count(MemberStatus::completed) + collapsed;
    DimensionlessBands drawn{.name = fmt::format("{} members", members), .axis = summary.axis, .bands = summary.bands};
    if (collapsed > 0) drawn.name += fmt::format(", {} of them until they collapse", collapsed);
    const bool has_scales = summary.scales && summary.scales->sliding_speed() > 0.0;
    if (has_scales) {
        const double velocity = 1.0 / summary.scales->sliding_speed(), time = summary.scales->sliding_speed() / summary.scales->height;
        for (double& t : drawn.bands.time) t *= time;
        for (std::vector<Vector3>* values : {&drawn.bands.mean, &drawn.bands.sd}) {
            for (Vector3& value : *values) value *= velocity;
        }
    }
    StackedPlot plot = make_bands_plot({drawn});
    plot.subtitle = summary.name;
    if (!has_scales) {
        plot.x_label = "t [s]";
        plot.y_label = fmt::format("v [m/s] along {}, one row per level", axis_name(summary.axis));
    }
    return plot;
}

void add_ensemble(ResultFolder& folder, const EnsembleSummary& summary, const std::string& version) {
    folder.add_json("ensemble.json", to_json(summary, version));
    if (summary.bands.samples() == 0) return;
    const std::vector<char> bytes = make_ensemble_hdf5(summary, version);
    folder.add_text("ensemble.h5", {bytes.data(), bytes.size()});
    folder.add_text("ensemble.csv", make_ensemble_csv(summary));
    folder.add_text("ensemble.svg", make_svg(make_ensemble_plot(summary)));
}

}  // namespace musim::lsdem
