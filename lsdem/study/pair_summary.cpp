#include "lsdem/study/pair_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "lsdem/results/summary.hpp"
#include "lsdem/study/own_models.hpp"
#include "lsdem/study/pair_plots.hpp"
#include "lsdem/study/pair_text.hpp"
#include "scaling/json_optional.hpp"

namespace musim::lsdem {
namespace {

nlohmann::json make_labelled_summary(const std::string& label, const RunResult& run) {
    nlohmann::json summary = make_summary(run);
    summary["label"] = label;
    return summary;
}

}  // namespace

static nlohmann::json to_json(const std::vector<LoneDistortion>& alone) {
    nlohmann::json all = nlohmann::json::array();
    for (const LoneDistortion& lone : alone) {
        all.push_back({{"property", lone.property},
                       {"factor", lone.factor},
                       {"status", to_string(lone.status)},
                       {"max_relative_velocity_difference", lone.difference.max_velocity},
                       {"rms_relative_velocity_difference", lone.difference.rms_velocity},
                       {"max_relative_loss_difference", scaling::or_null(lone.difference.losses)}});
    }
    return all;
}

static nlohmann::json to_json(const std::vector<QuantityCheck>& checks) {
    nlohmann::json all = nlohmann::json::array();
    for (const QuantityCheck& check : checks) {
        all.push_back({{"key", check.key},
                       {"level", check.level},
                       {"unit", check.unit},
                       {"prototype", check.prototype},
                       {"model", check.model},
                       {"difference", check.difference},
                       {"of_twins", check.twins.largest()},
                       {"probability", check.probability}});
    }
    return all;
}

static nlohmann::json to_json(const OwnJudgement& judgement) {
    nlohmann::json quantities = nlohmann::json::array();
    for (const OwnQuantity& quantity : judgement.quantities) {
        quantities.push_back({{"name", quantity.name},
                              {"difference", quantity.check.difference},
                              {"of_twins", quantity.check.twins.largest()},
                              {"of_specimens", quantity.of_specimens ? nlohmann::json(quantity.of_specimens->largest()) : nlohmann::json()},
                              {"beyond_chance", quantity.beyond_chance}});
    }
    return {{"quantities", quantities}, {"accepted", scaling::or_null(judgement.accepted)}};
}

static nlohmann::json twins_to_json(const PairStudy& study, const Yardstick& yardstick) {
    nlohmann::json all = nlohmann::json::array();
    for (std::size_t i = 0; i < study.twins.size(); ++i) {
        const PairedTwin& twin = study.twins[i];
        all.push_back({{"length", twin.choice.length},
                       {"last_place", twin.choice.last_place},
                       {"status", to_string(twin.status)},
                       {"rms_relative_velocity_difference", twin.difference.rms_velocity},
                       {"max_relative_loss_difference", scaling::or_null(twin.difference.losses)},
                       {"parting_time_s", scaling::or_null(yardstick.parting_time(study.twin_traces[i]))}});
    }
    return all;
}

/// Numbers for pictures: four digits.
static nlohmann::json to_short_json(const std::vector<double>& numbers) {
    nlohmann::json all = nlohmann::json::array();
    for (const double number : numbers) all.push_back(std::stod(fmt::format("{:.4g}", number)));
    return all;
}

static nlohmann::json to_json(const Departure& departure) {
    nlohmann::json models = nlohmann::json::array();
    for (const Departure::Curve& curve : departure.models) {
        models.push_back({{"label", curve.label}, {"largest_difference", to_short_json(curve.running)}});
    }
    return {{"time_s", departure.time},
            {"models", models},
            {"twins", departure.twins},
            {"twins_low", to_short_json(departure.twins_low)},
            {"twins_high", to_short_json(departure.twins_high)},
            {"horizon_s", scaling::or_null(departure.horizon)}};
}

static nlohmann::json to_json(const std::optional<TwinBand>& band) {
    if (!band) return nullptr;
    nlohmann::json widths = nlohmann::json::array();
    for (const std::vector<double>& row : band->half_width) widths.push_back(to_short_json(row));
    return {{"axis", band->axis}, {"rows", band->rows}, {"half_width_m_s", widths}};
}

nlohmann::json to_json(const PairStudy& study) {
    const Yardstick yardstick = study.yardstick();
    // under their old names: of the twin that differs most
    double shadow_rms = 0.0;
    std::optional<double> shadow_losses;
    for (const PairedTwin& twin : study.twins) {
        shadow_rms = std::max(shadow_rms, twin.difference.rms_velocity);
        if (twin.difference.losses) shadow_losses = std::max(shadow_losses.value_or(0.0), *twin.difference.losses);
    }
    // braces around a single value are an array to one compiler and that value to another
    nlohmann::json runs = nlohmann::json::array();
    runs.push_back(make_labelled_summary("prototype", study.prototype));
    nlohmann::json pairs = nlohmann::json::array();
    for (const PairedRun& model : study.models) {
        const Judgement& judgement = model.judgement;
        runs.push_back(make_labelled_summary(model.label, model.run));
        pairs.push_back({{"label", model.label},
                         {"length", model.run.similitude.length()},
                         {"materials", to_string(study.materials)},
                         {"material", model.material.empty() ? nlohmann::json() : nlohmann::json(model.material)},
                         {"max_relative_velocity_difference", model.difference.max_velocity},
                         {"rms_relative_velocity_difference", model.difference.rms_velocity},
                         {"max_relative_loss_difference", scaling::or_null(model.difference.losses)},
                         {"shadow_rms", shadow_rms},
                         {"shadow_loss_difference", scaling::or_null(shadow_losses)},
                         {"bitwise_identical", model.difference.bitwise_identical},
                         {"digits", model.difference.digits()},
                         {"parting_time_s", scaling::or_null(judgement.parting_time)},
                         {"agreement", to_string(judgement.agreement)},
                         {"consistent", study.materials == Materials::own || judgement.agreement == Agreement::agree},
                         {"lead_sd", judgement.lead},
                         {"lead_time_s", judgement.lead_time},
                         {"probability", judgement.least_probability},
                         {"quantities", to_json(judgement.quantities)},
                         {"distortions", to_json(model.distortions)},
                         {"alone", to_json(model.alone)}});
        if (study.materials == Materials::own) pairs.back()["own"] = to_json(judge_own(study, model));
    }
    nlohmann::json json = {{"runs", runs},
                           {"pairs", pairs},
                           {"consistent", study.consistent()},
                           {"agreement", to_string(study.agreement())},
                           {"verdict", describe_verdict(study)},
                           {"twins", twins_to_json(study, yardstick)},
                           {"horizon_s", study.twins.empty() ? nlohmann::json() : nlohmann::json(yardstick.horizon())},
                           {"end_s", yardstick.end()},
                           {"same_bits", scaling::or_null(study.same_bits)},
                           {"lead_of_images_sd", nlohmann::json()},
                           {"other_specimens", study.specimen_traces.size()},
                           {"accept", scaling::or_null(study.tolerance)},
                           {"departure", to_json(find_departure(study))},
                           {"twins_band", to_json(find_twin_band(study))},
                           {"half_step", nlohmann::json()},
                           {"smallest_difference_seen", nlohmann::json()}};
    if (study.half_step) {
        json["half_step"] = {{"rms_relative_velocity_difference", study.half_step->difference.rms_velocity},
                             {"parting_time_s", scaling::or_null(yardstick.parting_time(study.half_step->trace))},
                             {"quantities", to_json(study.half_step->judgement.quantities)}};
    }
    if (const auto images = yardstick.lead_of_images()) json["lead_of_images_sd"] = images->lead;
    if (const auto seen = yardstick.smallest_seen()) {
        json["smallest_difference_seen"] = {{"difference", seen->difference}, {"time_s", seen->time}};
    }
    return json;
}

}  // namespace musim::lsdem
