#include "lsdem/study/pair_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "lsdem/results/summary.hpp"
#include "lsdem/study/law_text.hpp"
#include "lsdem/study/own_models.hpp"
#include "lsdem/study/pair_plots.hpp"
#include "lsdem/study/step_error.hpp"
#include "scaling/json_optional.hpp"

namespace musim::lsdem {
namespace {

nlohmann::json make_labelled_summary(const std::string& label, const RunResult& run) {
    nlohmann::json summary = make_summary(run);
    summary["label"] = label;
    return summary;
}

}  // namespace

static void to_json(nlohmann::json& json, const RunDifference& difference) {
    json = {{"max_relative_velocity_difference", difference.max_velocity},
            {"rms_relative_velocity_difference", difference.rms_velocity},
            {"max_relative_loss_difference", scaling::or_null(difference.losses)}};
}

static void to_json(nlohmann::json& json, const LoneDistortion& lone) {
    json = lone.difference;
    json.update({{"property", lone.property}, {"factor", lone.factor}, {"status", to_string(lone.status)}});
}

static void to_json(nlohmann::json& json, const BaseShaking& shaking) {
    json = {{"time", scaling::or_null(shaking.time)},
            {"velocity", scaling::or_null(shaking.velocity)},
            {"velocity_vertical", scaling::or_null(shaking.velocity_vertical)}};
}

static nlohmann::json law_to_json(const PairedRun& model) {
    const scaling::Similitude& similitude = model.run.similitude;
    return {{"name", similitude.law_name()},
            {"source", to_string(model.law.source)},
            {"time", similitude.time()},
            {"acceleration", similitude.acceleration()},
            {"acceleration_vertical", similitude.acceleration_vertical()},
            {"base_motion", scaling::or_null(model.law.shaking)}};
}

static void to_json(nlohmann::json& json, const DifferenceRange& range) { json = range.largest(); }

static void to_json(nlohmann::json& json, const QuantityCheck& check) {
    json = {{"key", check.key},     {"level", check.level},           {"unit", check.unit},      {"prototype", check.prototype},
            {"model", check.model}, {"difference", check.difference}, {"of_twins", check.twins}, {"probability", check.probability}};
    if (!check.name.empty()) json["name"] = check.name;
}

static void to_json(nlohmann::json& json, const OwnQuantity& quantity) {
    json = {{"name", quantity.name},
            {"difference", quantity.check.difference},
            {"of_twins", quantity.check.twins},
            {"of_specimens", scaling::or_null(quantity.of_specimens)},
            {"beyond_chance", quantity.beyond_chance}};
}

static void to_json(nlohmann::json& json, const OwnJudgement& judgement) {
    json = {{"quantities", judgement.quantities}, {"accepted", scaling::or_null(judgement.accepted)}};
}

static void to_json(nlohmann::json& json, const SceneDifference& difference) {
    const auto value_of = [](const std::string& text) { return text.empty() ? nlohmann::json() : nlohmann::json::parse(text); };
    json = {{"key", difference.key}, {"prototype", value_of(difference.first)}, {"model", value_of(difference.second)}};
}

static void to_json(nlohmann::json& json, const SecondScene& scene) {
    json = {{"file", scene.file}, {"judged", scene.way}, {"same_structure", scene.same_structure}, {"differences", scene.differences}};
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

static void to_json(nlohmann::json& json, const Departure::Curve& curve) {
    json = {{"label", curve.label}, {"largest_difference", to_short_json(curve.running)}};
}

static void to_json(nlohmann::json& json, const Departure& departure) {
    json = {{"time_s", departure.time},
            {"models", departure.models},
            {"twins", departure.twins},
            {"twins_low", to_short_json(departure.twins_low)},
            {"twins_high", to_short_json(departure.twins_high)},
            {"horizon_s", scaling::or_null(departure.horizon)}};
}

static void to_json(nlohmann::json& json, const TwinBand& band) {
    json = {{"axis", band.axis}, {"rows", band.rows}, {"half_width_m_s", nlohmann::json::array()}};
    for (const std::vector<double>& row : band.half_width) json["half_width_m_s"].push_back(to_short_json(row));
}

nlohmann::json to_json(const StepError& error) {
    return {{"status", to_string(error.status)},
            {"rms_relative_velocity_difference", error.difference.rms_velocity},
            {"parting_time_s", scaling::or_null(error.parting_time)},
            {"largest_relative_velocity_difference", error.largest},
            {"until_s", error.horizon},
            {"quantities", error.quantities}};
}

nlohmann::json to_json(const PairStudy& study) {
    const Yardstick yardstick = study.yardstick();
    // braces around a single value are an array to one compiler and that value to another
    nlohmann::json runs = nlohmann::json::array();
    runs.push_back(make_labelled_summary("prototype", study.prototype));
    nlohmann::json pairs = nlohmann::json::array();
    for (const PairedRun& model : study.models) {
        const Judgement& judgement = model.judgement;
        runs.push_back(make_labelled_summary(model.label, model.run));
        nlohmann::json& pair = pairs.emplace_back(model.difference);
        pair.update({{"label", model.label},
                     {"length", model.run.similitude.length()},
                     {"materials", to_string(model.materials)},
                     {"material", model.material.empty() ? nlohmann::json() : nlohmann::json(model.material)},
                     {"law", law_to_json(model)},
                     {"specimen", model.is_image ? "image" : "anew"},
                     {"bitwise_identical", model.difference.bitwise_identical},
                     {"digits", model.difference.digits()},
                     {"parting_time_s", scaling::or_null(judgement.parting_time)},
                     {"agreement", to_string(judgement.agreement)},
                     {"consistent", model.materials == Materials::own || judgement.agreement == Agreement::agree},
                     {"lead_sd", judgement.lead},
                     {"lead_time_s", judgement.lead_time},
                     {"probability", judgement.least_probability},
                     {"quantities", judgement.quantities},
                     {"distortions", to_json(model.distortions)},
                     {"asked_by_law", model.asked},
                     {"alone", model.alone}});
        if (model.materials == Materials::own || study.tolerance) pair["own"] = judge_own(study, model);
        if (model.scene) pair["scene"] = *model.scene;
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
                           {"departure", find_departure(study)},
                           {"twins_band", scaling::or_null(find_twin_band(study))},
                           {"half_step", nlohmann::json()},
                           {"smallest_difference_seen", nlohmann::json()}};
    if (const std::optional<StepError> error = find_step_error(study)) json["half_step"] = to_json(*error);
    if (const auto images = yardstick.lead_of_images()) json["lead_of_images_sd"] = images->lead;
    if (const auto seen = yardstick.smallest_seen()) {
        json["smallest_difference_seen"] = {{"difference", seen->difference}, {"time_s", seen->time}};
    }
    return json;
}

}  // namespace musim::lsdem
