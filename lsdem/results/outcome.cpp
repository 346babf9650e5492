#include "lsdem/results/outcome.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "lsdem/results/base_frame.hpp"
#include "lsdem/results/drift.hpp"
#include "lsdem/results/spine_measures.hpp"
#include "scaling/angle.hpp"
#include "scaling/quantity_text.hpp"

namespace musim::lsdem {
namespace {

template <class Quantity>
std::string write(double value) {
    return scaling::format_quantity(Quantity::from_value(value), 3);
}

/// A block of the spine as results call it when it is a listed one.
std::string name_listed(const RunResult& run, std::size_t spine_block) {
    return run.blocks.is_listed() ? run.blocks.label(run.spine.block[spine_block]) : std::string();
}

void measure_spine(const RunResult& run, Outcome& outcome) {
    const std::vector<std::size_t> order = sort_spine_by_height(run);
    if (order.empty() || run.history.samples() == 0) return;
    const std::size_t top = order.back();
    const std::vector<DriftPair> pairs = find_drift_pairs(run);
    outcome.top_level = run.spine.level[top];
    outcome.top_name = name_listed(run, top);
    double fastest = 0.0;
    for (std::size_t k = 0; k < run.history.samples(); ++k) {
        const std::size_t at = k * run.spine.size() + top;
        const Vector3 velocity = find_velocity_on_base(run.history.base[k], run.history.spine_position[at], run.history.spine_velocity[at]);
        outcome.top_speed = velocity.head<2>().norm();
        fastest = std::max(fastest, outcome.top_speed);
        outcome.top_residual = find_shift(run, top, k).norm();
        outcome.top_peak = std::max(outcome.top_peak, outcome.top_residual);
        const Drift drift = find_drift(run, pairs, k);
        if (!(drift.value > outcome.drift)) continue;
        outcome.drift = drift.value;
        outcome.drift_level = run.spine.level[drift.upper];
        outcome.drift_name = name_listed(run, drift.upper);
    }
    outcome.top_moves = outcome.top_speed > kStillMoving * fastest;
}

void keep_larger(std::optional<LargestAt>& largest, double value, std::size_t block, const RunResult& run) {
    if (largest && !(value > largest->value)) return;
    const std::string& name = run.blocks.is_listed() ? run.blocks.name[block] : std::string();
    largest = LargestAt{value, block, run.blocks.layer[block], name};
}

std::string name_place(const LargestAt& largest) {
    std::string text = fmt::format("block {}", largest.block);
    if (!largest.name.empty()) text += fmt::format(" (\"{}\")", largest.name);
    return largest.level > 0 ? fmt::format("{}, level {}", text, largest.level) : text;
}

/// "level 3", or a listed block at its level.
std::string name_spine_block(int level, const std::string& name) {
    return name.empty() ? fmt::format("level {}", level) : fmt::format("{}, level {}", name, level);
}

/// The members of an object of the outcome that a listed block adds to.
nlohmann::json with_name(nlohmann::json object, const std::string& name) {
    if (!name.empty()) object["name"] = name;
    return object;
}

nlohmann::json write_largest(const std::optional<LargestAt>& largest, const char* key, double unit) {
    if (!largest) return nullptr;
    return with_name({{key, largest->value / unit}, {"block", largest->block}, {"level", largest->level}}, largest->name);
}

}  // namespace

Outcome find_outcome(const RunResult& run) {
    Outcome outcome;
    outcome.axis = find_strongest_axis(run.history);
    outcome.pga = run.peak_base_acceleration;
    outcome.base_changes = run.base_changes;
    for (const BaseState& base : run.history.base) outcome.pgv = outcome.pgv.cwiseMax(base.velocity.cwiseAbs());
    outcome.base_turn = find_base_turn(run.history);
    outcome.shaken = !run.collapsed_before();
    measure_spine(run, outcome);
    const Damage damage = assess_damage(run);
    outcome.blocks = damage.blocks;
    outcome.fallen = damage.fallen;
    for (const Joint& joint : damage.joints) {
        const bool stands = !damage.each[joint.upper].fallen && (joint.on_ground || !damage.each[joint.lower].fallen);
        if (stands) keep_larger(outcome.slip, joint.slip, joint.upper, run);
    }
    for (std::size_t b = 0; b < damage.each.size(); ++b) {
        if (!damage.each[b].fallen) keep_larger(outcome.rotation, damage.each[b].rotation, b, run);
    }
    return outcome;
}

Outcome scale_back(Outcome outcome, const scaling::Similitude& similitude) {
    const double horizontal = similitude.acceleration(), vertical = similitude.acceleration_vertical();
    outcome.pga = outcome.pga.cwiseQuotient(Vector3(horizontal, horizontal, vertical));
    const double displacement = similitude.velocity() * similitude.time(), rise = similitude.velocity_vertical() * similitude.time();
    outcome.base_changes =
        scale_back(outcome.base_changes, {horizontal, horizontal, vertical},
                   {similitude.velocity(), similitude.velocity(), similitude.velocity_vertical()}, {displacement, displacement, rise});
    outcome.pgv = outcome.pgv.cwiseQuotient(Vector3(similitude.velocity(), similitude.velocity(), similitude.velocity_vertical()));
    if (outcome.base_turn) outcome.base_turn->rate /= similitude.frequency();
    outcome.top_peak /= similitude.length();
    outcome.top_residual /= similitude.length();
    outcome.top_speed /= similitude.velocity();
    if (outcome.slip) outcome.slip->value /= similitude.length();
    return outcome;
}

std::vector<std::string> describe(const Outcome& outcome) {
    std::vector<std::string> lines;
    if (!outcome.shaken) {
        return {
            fmt::format("{} of {} blocks fell while the structure was prepared; the motion was not run", outcome.fallen, outcome.blocks)};
    }
    for (int axis = 0; axis < 3; ++axis) {
        if (!(outcome.pgv[axis] > 0.0)) continue;
        const std::optional<BaseChange>& change = outcome.base_changes[static_cast<std::size_t>(axis)];
        const bool has_peaks = change && change->of_record;
        lines.push_back(fmt::format("base motion along {}: {}{}", axis_name(axis), describe_base(outcome.pga[axis], change),
                                    has_peaks ? "" : ", PGV " + write<scaling::Velocity>(outcome.pgv[axis])));
    }
    if (const auto& turn = outcome.base_turn) {
        lines.push_back(fmt::format("base turned by up to {:.4g} deg ({:.4g} deg at the end), at up to {:.3g} deg/s",
                                    turn->angle / scaling::kDegree, turn->angle_at_end / scaling::kDegree, turn->rate / scaling::kDegree));
    }
    if (lines.empty()) lines.emplace_back("base at rest");
    if (outcome.top_level > 0) {
        std::string line = fmt::format("top ({}) against the base, horizontally: peak {}, {} {}",
                                       name_spine_block(outcome.top_level, outcome.top_name), write<scaling::Length>(outcome.top_peak),
                                       outcome.top_moves ? "at the end" : "residual", write<scaling::Length>(outcome.top_residual));
        if (outcome.top_moves) line += fmt::format(" and moving at {}", write<scaling::Velocity>(outcome.top_speed));
        if (outcome.drift_level > 0) {
            line += fmt::format("; largest drift {:.3g} % (below {})", 100.0 * outcome.drift,
                                name_spine_block(outcome.drift_level, outcome.drift_name));
        }
        lines.push_back(line);
    }
    std::string left;
    if (outcome.slip) {
        left = fmt::format("largest slip left {} ({})", write<scaling::Length>(outcome.slip->value), name_place(*outcome.slip));
    }
    if (outcome.rotation) {
        left += fmt::format("{}largest rotation left {:.3g} deg ({})", left.empty() ? "" : "; ", outcome.rotation->value / scaling::kDegree,
                            name_place(*outcome.rotation));
    }
    if (!left.empty()) lines.push_back(left);
    lines.push_back(fmt::format("{} of {} blocks fallen", outcome.fallen, outcome.blocks));
    return lines;
}

nlohmann::json to_json(const Outcome& outcome) {
    const Vector3 pga = outcome.pga / scaling::kStandardGravity.value();
    nlohmann::json top;
    if (outcome.top_level > 0) {
        top = with_name({{"level", outcome.top_level},
                         {"peak_displacement_m", outcome.top_peak},
                         {"residual_displacement_m", outcome.top_residual},
                         {"speed_at_end_m_s", outcome.top_speed},
                         {"moves_at_end", outcome.top_moves}},
                        outcome.top_name);
    }
    nlohmann::json json{{"axis", axis_name(outcome.axis)},
                        {"pga_g", {pga.x(), pga.y(), pga.z()}},
                        {"base_changes", to_json(outcome.base_changes)},
                        {"pgv_m_s", {outcome.pgv.x(), outcome.pgv.y(), outcome.pgv.z()}},
                        {"shaken", outcome.shaken},
                        {"top", top},
                        {"drift", with_name({{"largest", outcome.drift}, {"level", outcome.drift_level}}, outcome.drift_name)},
                        {"largest_slip", write_largest(outcome.slip, "m", 1.0)},
                        {"largest_rotation", write_largest(outcome.rotation, "deg", scaling::kDegree)},
                        {"fallen", outcome.fallen},
                        {"blocks", outcome.blocks}};
    if (const auto& turn = outcome.base_turn) {
        json["base_turn"] = {{"largest_deg", turn->angle / scaling::kDegree},
                             {"at_end_deg", turn->angle_at_end / scaling::kDegree},
                             {"largest_rate_deg_s", turn->rate / scaling::kDegree}};
    }
    return json;
}

}  // namespace musim::lsdem
