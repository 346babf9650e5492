#include "lsdem/results/summary.hpp"

#include <nlohmann/json.hpp>
#include <string>

#include "lsdem/results/load_measures.hpp"
#include "lsdem/results/outcome.hpp"
#include "lsdem/results/run_warnings.hpp"
#include "scaling/angle.hpp"
#include "scaling/json_optional.hpp"

namespace musim::lsdem {
namespace {

nlohmann::json write_moved(const RunResult& run) {
    const auto point = [](const Vector3& p) { return nlohmann::json{p.x(), p.y(), p.z()}; };
    nlohmann::json list = nlohmann::json::array();
    for (const MovedBlock& moved : run.rest->fallen) {
        list.push_back({{"block", moved.block},
                        {"name", run.blocks.label(moved.block)},
                        {"drawn_m", point(moved.drawn)},
                        {"now_m", point(moved.now)},
                        {"turned_deg", moved.turned / scaling::kDegree}});
    }
    return list;
}

nlohmann::json write_sensors(const std::vector<SensorHistory>& sensors) {
    nlohmann::json list = nlohmann::json::array();
    for (const SensorHistory& sensor : sensors) {
        nlohmann::json channels = nlohmann::json::array();
        const std::vector<SensorChannel>& known = find_channels(sensor.kind);
        for (std::size_t c = 0; c < known.size() && !sensor.values.empty(); ++c) {
            const SensorPeak peak = find_peak(sensor, c);
            channels.push_back(
                {{"column", sensor.name + known[c].column}, {"unit", known[c].unit}, {"peak", peak.value}, {"time_s", peak.time}});
        }
        nlohmann::json described = nlohmann::json::parse(describe_sensor(sensor));
        described["readings"] = sensor.readings();
        described["channels"] = channels;
        list.push_back(described);
    }
    return list;
}

nlohmann::json write_loads(const RunResult& run) {
    nlohmann::json list = nlohmann::json::array();
    const std::vector<LargestLoad> largest = find_largest_loads(run);
    for (std::size_t l = 0; l < largest.size(); ++l) {
        list.push_back({{"name", run.loads[l]},
                        {"largest_force_n", largest[l].force},
                        {"displacement_m", largest[l].displacement},
                        {"time_s", largest[l].time}});
    }
    return list;
}

}  // namespace

nlohmann::json make_summary(const RunResult& run) {
    nlohmann::json summary{{"status", to_string(run.status)},
                           {"blocks", run.blocks.mass.size()},
                           {"steps", run.steps},
                           {"dt_s", run.time_step},
                           {"substeps", run.statistics.substeps},
                           {"critical_dt_s", nullptr},
                           {"duration_s", run.final.time},
                           {"wall_s", run.wall_time},
                           {"contacts", run.statistics.contacts},
                           {"contact_nodes", run.statistics.contact_nodes},
                           {"state_hash", run.state_hash},
                           {"energy_closure", run.energy_closure},
                           {"max_overlap_over_height", run.statistics.max_overlap_over_height},
                           {"base_reaction_over_weight", nullptr}};
    if (run.base_reaction_over_weight) summary["base_reaction_over_weight"] = *run.base_reaction_over_weight;
    if (run.critical_time_step) summary["critical_dt_s"] = *run.critical_time_step;
    if (const auto& left = run.statistics.leaving) {
        summary["left_place"] = {{"block", left->block}, {"time_s", left->time}, {"substeps_per_step", left->substeps}};
    }
    if (run.origin) summary["stage"] = {{"number", run.origin->stage + 1}, {"time_before_s", run.origin->time}};
    if (run.collapse_time) summary["collapse_time_s"] = *run.collapse_time;
    if (const auto failure = find_failure(run)) summary["failure"] = to_json(*failure);
    if (run.rest) {
        summary["rest"] = {{"at_rest", run.rest->at_rest},
                           {"steps", run.rest->steps},
                           {"kinetic_over_weight_height", run.rest->kinetic},
                           {"base_reaction_over_weight", run.rest->reaction_over_weight},
                           {"fallen", run.rest->fallen.size()},
                           {"collapsed", run.rest->collapsed},
                           {"moved", write_moved(run)}};
    }
    if (!run.sensors.empty()) summary["sensors"] = write_sensors(run.sensors);
    if (!run.loads.empty()) summary["loads"] = write_loads(run);
    summary["outcome"] = to_json(find_outcome(run));
    summary["warnings"] = find_warnings(run);
    if (run.divergence) {
        summary["divergence"] = {{"kind", std::string(name_of(run.divergence->kind))},
                                 {"block", run.divergence->block},
                                 {"time_s", run.divergence->time},
                                 {"what", describe_divergence(run)}};
    }
    return summary;
}

nlohmann::json to_json(const Failure& failure) {
    const FailureMeasures& m = failure.measures;
    nlohmann::json object{{"mode", to_string(failure.mode)},
                          {"time_s", failure.time},
                          {"measures",
                           {{"fallen", m.fallen},
                            {"outward_share", m.outward_share},
                            {"bulge", m.bulge},
                            {"bulge_height", m.bulge_height},
                            {"inward_share_above", m.inward_share_above}}}};
    if (!failure.why.empty()) object["why"] = failure.why;
    return object;
}

nlohmann::json to_json(const scaling::Similitude& similitude) {
    nlohmann::json factors;
    for (const scaling::NamedFactor& factor : similitude.factors()) factors[std::string(factor.name)] = factor.value;
    return {{"law", similitude.law_name()},
            {"chosen",
             {{"length", similitude.length()},
              {"friction", similitude.friction()},
              {"gravity", similitude.gravity()},
              {"density", similitude.density()}}},
            {"factors", factors}};
}

scaling::Similitude parse_similitude(const nlohmann::json& json) {
    const nlohmann::json &chosen = json.at("chosen"), &factors = json.at("factors");
    const scaling::ScaleFactors scales{
        .length = chosen.at("length"), .friction = chosen.at("friction"), .gravity = chosen.at("gravity"), .density = chosen.at("density")};
    return {scales, factors.at("acceleration"), json.at("law"), factors.at("acceleration_vertical")};
}

nlohmann::json to_json(const std::vector<scaling::Distortion>& distortions) {
    nlohmann::json list = nlohmann::json::array();
    for (const scaling::Distortion& distortion : distortions) {
        list.push_back({{"group", distortion.group},
                        {"factor", distortion.factor},
                        {"severity", std::string(scaling::to_string(distortion.severity))},
                        {"effect", distortion.effect}});
    }
    return list;
}

}  // namespace musim::lsdem
