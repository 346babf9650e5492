#include "lsdem/study/summary.hpp"

#include <nlohmann/json.hpp>
#include <string>

#include "lsdem/study/verdict.hpp"

namespace musim::lsdem::study {
namespace {

nlohmann::json make_labelled_summary(const std::string& label, const RunResult& run) {
    nlohmann::json summary = make_summary(run);
    summary["label"] = label;
    return summary;
}

}  // namespace

nlohmann::json make_summary(const RunResult& run) {
    nlohmann::json summary{{"status", to_string(run.status)},
                           {"blocks", run.blocks.mass.size()},
                           {"steps", run.steps},
                           {"dt_s", run.time_step},
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
    if (run.origin) summary["stage"] = {{"number", run.origin->stage + 1}, {"time_before_s", run.origin->time}};
    if (run.collapse_time) summary["collapse_time_s"] = *run.collapse_time;
    if (const auto failure = find_failure(run)) summary["failure"] = to_json(*failure);
    if (run.rest) {
        summary["rest"] = {{"at_rest", run.rest->at_rest},
                           {"steps", run.rest->steps},
                           {"kinetic_over_weight_height", run.rest->kinetic},
                           {"base_reaction_over_weight", run.rest->reaction_over_weight},
                           {"fallen", run.rest->fallen}};
    }
    summary["doubts"] = find_doubts(run);
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

static nlohmann::json to_json(const std::optional<double>& number) { return number ? nlohmann::json(*number) : nlohmann::json(); }

static nlohmann::json to_json(const std::vector<LoneDistortion>& alone) {
    nlohmann::json all = nlohmann::json::array();
    for (const LoneDistortion& lone : alone) {
        all.push_back({{"property", lone.property},
                       {"factor", lone.factor},
                       {"status", to_string(lone.status)},
                       {"max_relative_velocity_difference", lone.difference.max_velocity},
                       {"rms_relative_velocity_difference", lone.difference.rms_velocity},
                       {"max_relative_loss_difference", to_json(lone.difference.losses)}});
    }
    return all;
}

nlohmann::json to_json(const PairStudy& study) {
    nlohmann::json runs = {make_labelled_summary("prototype", study.prototype),
                           make_labelled_summary(study.shadow.label, study.shadow.run)};
    nlohmann::json pairs = nlohmann::json::array();
    for (const PairedRun& model : study.models) {
        runs.push_back(make_labelled_summary(model.label, model.run));
        pairs.push_back({{"label", model.label},
                         {"length", model.similitude.length()},
                         {"materials", to_string(study.materials)},
                         {"max_relative_velocity_difference", model.difference.max_velocity},
                         {"rms_relative_velocity_difference", model.difference.rms_velocity},
                         {"max_relative_loss_difference", to_json(model.difference.losses)},
                         {"shadow_rms", study.shadow.difference.rms_velocity},
                         {"shadow_loss_difference", to_json(study.shadow.difference.losses)},
                         {"bitwise_identical", model.difference.bitwise_identical},
                         {"digits", model.difference.digits()},
                         {"parting_time_s", to_json(model.difference.parting_time)},
                         {"consistent", model.consistent},
                         {"distortions", to_json(model.distortions)},
                         {"alone", to_json(model.alone)}});
    }
    return {{"runs", runs}, {"pairs", pairs}, {"consistent", study.consistent()}};
}

}  // namespace musim::lsdem::study
