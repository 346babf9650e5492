#include "lsdem/run/sequence_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "lsdem/results/read_results.hpp"
#include "lsdem/results/summary.hpp"
#include "lsdem/rotation.hpp"
#include "scaling/angle.hpp"
#include "scaling/json_optional.hpp"

namespace musim::lsdem {
namespace {

using scaling::kDegree;

void add(const Losses& more, Losses& sum) {
    if (sum.block.empty()) sum.block.resize(more.block.size());
    for (std::size_t b = 0; b < more.block.size(); ++b) sum.block[b] += more.block[b];
    sum.ground += more.ground;
}

Residual measure_residual(const RunData& run, int axis) { return {assess_damage(run), measure_spine(run, axis)}; }

/// `losses`: of all stages up to this one.
StageSummary summarize_stage(const StoredRun& run, const StageFolder& where, const Losses& losses) {
    StageSummary stage;
    stage.where = where;
    stage.status = run.status;
    stage.start_time = run.origin ? run.origin->time : 0.0;
    stage.duration = run.history.time.back();
    stage.axis = find_strongest_axis(run.history);
    for (const BaseState& base : run.history.base) {
        stage.peak_velocity = std::max(stage.peak_velocity, base.velocity.norm());
    }
    int strongest = 0;
    stage.peak_acceleration = run.peak_base_acceleration.maxCoeff(&strongest);
    const std::optional<BaseChange>& change = run.base_changes[static_cast<std::size_t>(strongest)];
    if (change) stage.pga = fmt::format("along {}: {}", axis_name(strongest), describe_base(stage.peak_acceleration, change));
    stage.at_rest = run.at_rest;
    for (const double time : run.falls.time) {
        if (std::isnan(time)) continue;
        ++stage.fallen;
        if (run.origin && time <= 0.0) ++stage.fallen_before;
    }
    stage.collapse_time = run.collapse_time;
    stage.collapsed_before = run.collapsed_before();
    stage.divergence = run.divergence;
    stage.warnings = run.warnings;
    stage.of_stage = measure_residual(run, stage.axis);
    stage.of_sequence = stage.of_stage;
    if (!run.origin) return stage;
    stage.at_start = measure_residual(measure_from_first(run, run.initial, Vector3::Zero(), {}), stage.axis);
    const Vector3& moved = run.history.base.back().displacement;
    stage.of_sequence = measure_residual(measure_from_first(run, run.final, moved, losses), stage.axis);
    return stage;
}

nlohmann::json to_array(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

/// Over all joints.
Spread find_slip(const Damage& damage) {
    Spread slip;
    for (const Joint& joint : damage.joints) {
        slip.mean += joint.slip / static_cast<double>(damage.joints.size());
        slip.max = std::max(slip.max, joint.slip);
    }
    return slip;
}

nlohmann::json to_json(const Residual& residual) {
    const Damage& damage = residual.damage;
    nlohmann::json spine = nlohmann::json::array(), levels = nlohmann::json::array();
    for (const SpineLevel& l : residual.spine) {
        spine.push_back({{"level", l.level},
                         {"name", l.name.empty() ? nlohmann::json() : nlohmann::json(l.name)},
                         {"residual_displacement_m", to_array(l.residual_displacement)},
                         {"in_plane_rotation_residual_deg", l.in_plane_residual / kDegree},
                         {"vertical_rotation_residual_deg", l.vertical_residual / kDegree}});
    }
    for (const LevelDamage& l : damage.levels)
        levels.push_back({{"level", l.level}, {"fallen", l.fallen}, {"damage_index", l.index}, {"slip_max_m", l.slip.max}});
    const Spread slip = find_slip(damage);
    nlohmann::json object{{"fallen_blocks", damage.fallen},
                          {"damage_index", damage.index},
                          {"slip_m", {{"mean", slip.mean}, {"max", slip.max}}},
                          {"loss", nullptr},
                          {"spine", spine},
                          {"levels", levels}};
    if (damage.loss) object["loss"] = {{"friction_J", damage.loss->friction}, {"damping_J", damage.loss->damping}};
    return object;
}

nlohmann::json to_json(const StageSummary& stage) {
    nlohmann::json object{{"name", stage.where.name},
                          {"folder", stage.where.folder},
                          {"status", to_string(stage.status)},
                          {"start_time_s", stage.start_time},
                          {"duration_s", stage.duration},
                          {"axis", axis_name(stage.axis)},
                          {"peak_base_velocity_m_s", stage.peak_velocity},
                          {"peak_base_acceleration_m_s2", stage.peak_acceleration},
                          {"pga", stage.pga},
                          {"at_rest_before", stage.at_rest},
                          {"fallen_blocks_before", stage.fallen_before},
                          {"fallen_blocks", stage.fallen},
                          {"collapse_time_s", scaling::or_null(stage.collapse_time)},
                          {"warnings", stage.warnings},
                          {"at_start", stage.at_start ? to_json(*stage.at_start) : nlohmann::json()},
                          {"since_stage_start", to_json(stage.of_stage)},
                          {"since_first_start", to_json(stage.of_sequence)}};
    if (!stage.divergence.empty()) object["divergence"] = stage.divergence;
    return object;
}

/// The highest level of the spine; nothing without one.
const SpineLevel* find_top(const Residual& residual) {
    const auto top = std::max_element(residual.spine.begin(), residual.spine.end(),
                                      [](const SpineLevel& a, const SpineLevel& b) { return a.height < b.height; });
    return top == residual.spine.end() ? nullptr : &*top;
}

/// damage index, largest slip, displacement of the spine's top, friction and dashpots: five columns and two empty ones where unknown.
std::string residual_columns(const Residual& residual) {
    std::string csv = fmt::format(",{},{}", residual.damage.index, find_slip(residual.damage).max);
    const SpineLevel* top = find_top(residual);
    csv += top == nullptr
               ? ",,,"
               : fmt::format(",{},{},{}", top->residual_displacement.x(), top->residual_displacement.y(), top->residual_displacement.z());
    const auto& loss = residual.damage.loss;
    return csv + (loss ? fmt::format(",{},{}", loss->friction, loss->damping) : ",,");
}

}  // namespace

std::optional<double> SequenceSummary::collapse_time() const {
    const StageSummary& last = stages.back();
    if (!last.collapse_time) return std::nullopt;
    return last.start_time + *last.collapse_time;
}

RunData measure_from_first(const RunData& stage, const Kinematics& pose, const Vector3& base, const std::optional<Losses>& losses) {
    const StageOrigin& origin = *stage.origin;
    RunData whole;
    whole.blocks = stage.blocks;
    whole.spine = stage.spine;
    whole.losses = losses;
    whole.falls.airborne = stage.falls.airborne;
    whole.initial.position = origin.position;
    whole.initial.orientation = origin.orientation;
    whole.final = pose;
    whole.history.time = {0.0, origin.time};
    whole.history.base = {BaseState{}, BaseState{Vector3(origin.base + base)}};
    whole.history.spine_velocity.assign(2 * stage.spine.size(), Vector3::Zero());
    for (const std::size_t block : stage.spine.block) {
        whole.history.spine_position.push_back(origin.position[block]);
        whole.history.spine_rotation.emplace_back(Vector3::Zero());
    }
    for (const std::size_t block : stage.spine.block) {
        whole.history.spine_position.push_back(pose.position[block]);
        whole.history.spine_rotation.push_back(rotation_vector(origin.orientation[block], pose.orientation[block]));
    }
    return whole;
}

SequenceSummary summarize_sequence(const std::filesystem::path& directory, const std::string& name, std::size_t planned,
                                   const std::vector<StageFolder>& stages) {
    SequenceSummary summary{.name = name, .planned = planned, .stages = {}, .failure = {}};
    Losses losses;
    for (const StageFolder& where : stages) {
        const StoredRun run = read_run(directory / where.folder);
        if (run.losses) add(*run.losses, losses);
        summary.stages.push_back(summarize_stage(run, where, losses));
        summary.failure = find_failure(run);
    }
    return summary;
}

nlohmann::json to_json(const SequenceSummary& summary) {
    nlohmann::json stages = nlohmann::json::array(), collapse;
    for (std::size_t k = 0; k < summary.stages.size(); ++k) {
        stages.push_back(to_json(summary.stages[k]));
        stages.back()["stage"] = k + 1;
    }
    if (const auto time = summary.collapse_time()) {
        const StageSummary& last = summary.stages.back();
        collapse = {{"stage", summary.stages.size()},
                    {"name", last.where.name},
                    {"time_s", *last.collapse_time},
                    {"total_time_s", *time},
                    {"in_rest_phase", *last.collapse_time > last.duration}};
    }
    return {{"name", summary.name},
            {"status", to_string(summary.status())},
            {"motions", summary.planned},
            {"stages_run", summary.stages.size()},
            {"total_time_s", summary.duration()},
            {"collapse", collapse},
            {"failure", summary.failure ? to_json(*summary.failure) : nlohmann::json()},
            {"stages", stages}};
}

std::string make_sequence_csv(const SequenceSummary& summary) {
    std::string csv = "stage,name,status,start_time_s,duration_s,peak_base_velocity_m_s,peak_base_acceleration_m_s2,fallen_blocks";
    csv += ",collapse_time_s,damage_index_at_start";
    for (const char* since : {"stage", "total"}) {
        fmt::format_to(
            std::back_inserter(csv),
            ",damage_index_{0},slip_max_m_{0},top_residual_x_m_{0},top_residual_y_m_{0},top_residual_z_m_{0},friction_j_{0},damping_j_{0}",
            since);
    }
    csv += '\n';
    for (std::size_t k = 0; k < summary.stages.size(); ++k) {
        const StageSummary& s = summary.stages[k];
        // a comma or quote in a name must not part it
        std::string name = s.where.name;
        std::replace_if(
            name.begin(), name.end(), [](char c) { return c == ',' || c == '"' || c == '\n'; }, ' ');
        fmt::format_to(std::back_inserter(csv), "{},{},{},{},{},{},{},{},{},{}", k + 1, name, to_string(s.status), s.start_time, s.duration,
                       s.peak_velocity, s.peak_acceleration, s.fallen, s.collapse_time ? fmt::format("{}", *s.collapse_time) : "",
                       s.at_start ? s.at_start->damage.index : 0.0);
        csv += residual_columns(s.of_stage) + residual_columns(s.of_sequence) + "\n";
    }
    return csv;
}

std::string make_sequence_levels_csv(const SequenceSummary& summary) {
    std::string csv = "stage,level";
    for (const char* since : {"stage", "total"}) {
        fmt::format_to(std::back_inserter(csv), ",residual_x_m_{0},residual_y_m_{0},residual_z_m_{0},in_plane_deg_{0},vertical_deg_{0}",
                       since);
    }
    csv += ",name\n";
    for (std::size_t k = 0; k < summary.stages.size(); ++k) {
        const StageSummary& stage = summary.stages[k];
        for (std::size_t s = 0; s < stage.of_stage.spine.size(); ++s) {
            fmt::format_to(std::back_inserter(csv), "{},{}", k + 1, stage.of_stage.spine[s].level);
            for (const Residual* residual : {&stage.of_stage, &stage.of_sequence}) {
                const SpineLevel& l = residual->spine[s];
                const Vector3& moved = l.residual_displacement;
                fmt::format_to(std::back_inserter(csv), ",{},{},{},{},{}", moved.x(), moved.y(), moved.z(), l.in_plane_residual / kDegree,
                               l.vertical_residual / kDegree);
            }
            fmt::format_to(std::back_inserter(csv), ",{}\n", stage.of_stage.spine[s].name);
        }
    }
    return csv;
}

}  // namespace musim::lsdem
