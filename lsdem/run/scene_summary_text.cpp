#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "lsdem/results/summary.hpp"
#include "lsdem/run/scene_summary.hpp"
#include "scaling/angle.hpp"
#include "scaling/quantity_text.hpp"

namespace musim::lsdem {
namespace {

using nlohmann::json;

template <class Quantity>
std::string write(double value, int digits = 4) {
    return scaling::format_quantity(Quantity::from_value(value), digits);
}

/// Three edges in one unit.
std::string write_size(const Vector3& size) {
    const double largest = size.maxCoeff();
    const bool small = largest < 1.0;
    const double unit = small ? 1e-3 : 1.0;
    return fmt::format("{:.4g} x {:.4g} x {:.4g} {}", size.x() / unit, size.y() / unit, size.z() / unit, small ? "mm" : "m");
}

std::string write_duration(double seconds) {
    if (seconds < 1.0) return "less than a second";
    if (seconds < 100.0) return fmt::format("{:.0f} s", seconds);
    if (seconds < 5400.0) return fmt::format("{:.0f} min", seconds / 60.0);
    return fmt::format("{:.1f} h", seconds / 3600.0);
}

std::string write_bytes(double bytes) {
    if (bytes < 1e5) return fmt::format("{:.0f} kB", std::ceil(1e-3 * bytes));
    const bool large = bytes >= 1e9;
    const double number = (large ? 1e-9 : 1e-6) * bytes;
    return fmt::format("{:.{}f} {}", number, number < 10.0 ? 1 : 0, large ? "GB" : "MB");
}

std::string count(std::size_t number, const std::string& of) { return fmt::format("{} {}{}", number, of, number == 1 ? "" : "s"); }

std::string name_material(const std::string& name) { return name.empty() ? "the scene's material" : name; }

std::string write_per_area(const scaling::Stiffness& stiffness, const SceneSummary& summary) {
    return write<scaling::StiffnessPerArea>(stiffness.value() / summary.stiffness_base.value());
}

/// Properties that a pair of materials has of its own.
std::string describe_pair(const PairEntry& pair, const SceneSummary& summary) {
    std::vector<std::string> parts;
    if (pair.normal_stiffness) parts.push_back("K_n " + write_per_area(*pair.normal_stiffness, summary));
    if (pair.shear_stiffness) parts.push_back("K_s " + write_per_area(*pair.shear_stiffness, summary));
    if (pair.friction) parts.push_back(fmt::format("friction {:.4g}", *pair.friction));
    if (pair.restitution) parts.push_back(fmt::format("restitution {:.4g}", *pair.restitution));
    if (pair.shear_damping_ratio) parts.push_back(fmt::format("shear damping ratio {:.4g}", *pair.shear_damping_ratio));
    return fmt::format("pair        {} on {}: {}", pair.of[0], pair.of[1], fmt::join(parts, ", "));
}

/// Kinds of blocks that a text lists: more is no help, as of blocks that scatter in size.
constexpr std::size_t kMostKinds = 12;

std::string describe_scatter(const Scatter& scatter) {
    std::vector<std::string> parts;
    if (scatter.size.value() > 0.0) parts.push_back("sizes " + scaling::format_quantity(scatter.size, 4));
    if (scatter.place.value() > 0.0) parts.push_back("places " + scaling::format_quantity(scatter.place, 4));
    if (scatter.friction > 0.0) parts.push_back(fmt::format("friction of joints {:.3g} %", 100.0 * scatter.friction));
    return fmt::format("scatter     {}, seed {}", parts.empty() ? "none" : fmt::format("{}", fmt::join(parts, ", ")), scatter.seed);
}

void describe_structure(const SceneSummary& summary, std::vector<std::string>& lines) {
    const Vector3 size = summary.high - summary.low;
    lines.push_back(fmt::format("structure   {} in {}, {}, {} in all", count(summary.specimen.model.blocks.size(), "block"),
                                count(static_cast<std::size_t>(summary.levels), "level"), write_size(size),
                                write<scaling::Mass>(summary.mass)));
    for (std::size_t k = 0; k < std::min(kMostKinds, summary.kinds.size()); ++k) {
        const BlockKind& kind = summary.kinds[k];
        lines.push_back(fmt::format("            {} of {}{}, {} each{}{}", kind.count,
                                    kind.shape.empty() ? "" : fmt::format("\"{}\" in ", kind.shape), write_size(kind.size),
                                    write<scaling::Mass>(kind.mass / static_cast<double>(kind.count)),
                                    summary.materials.size() > 1 ? ", " + name_material(kind.material) : "",
                                    kind.fixed > 0 ? fmt::format(", {} held in place", kind.fixed) : ""));
    }
    if (summary.kinds.size() > kMostKinds)
        lines.push_back(fmt::format("            and {} more kinds of blocks", summary.kinds.size() - kMostKinds));
    if (summary.scatter) lines.push_back(describe_scatter(*summary.scatter));
    for (const auto& [name, material] : summary.materials) {
        lines.push_back(
            fmt::format("material    {}density {}, k_n {}, k_s {} of a face of {} (K_n {}, K_s {}), friction {:.4g}, restitution {:.4g}",
                        name.empty() ? "" : name + ": ", scaling::format_quantity(material.density),
                        scaling::format_quantity(material.normal_stiffness, 4), scaling::format_quantity(material.shear_stiffness, 4),
                        scaling::format_quantity(summary.stiffness_base), write_per_area(material.normal_stiffness, summary),
                        write_per_area(material.shear_stiffness, summary), material.friction, material.restitution));
    }
    for (const PairEntry& pair : summary.pairs) lines.push_back(describe_pair(pair, summary));
    const Ground& ground = summary.specimen.model.ground;
    lines.push_back(fmt::format("contact     {}; {}", summary.contact,
                                ground.present ? fmt::format("ground with friction {:.4g}", ground.material.friction) : "no ground"));
}

void describe_motion(const MotionSummary& motion, std::vector<std::string>& lines) {
    lines.push_back(fmt::format("base        {}{}", motion.name.empty() ? "" : motion.name + ": ", motion.source));
    for (const AxisMotion& axis : motion.axes) {
        const bool has_peaks = axis.change && axis.change->of_record;
        lines.push_back(fmt::format(
            "            along {}: {}{}{}", axis.axis, describe_base(axis.pga, axis.change),
            has_peaks ? "" : fmt::format(", PGV {}, PGD {}", write<scaling::Velocity>(axis.pgv, 3), write<scaling::Length>(axis.pgd, 3)),
            axis.predominant_period ? ", predominant period " + write<scaling::Time>(*axis.predominant_period, 3) : ""));
    }
    for (const AxisTurn& turn : motion.turns) {
        lines.push_back(fmt::format("            about {}: {:.4g} deg, {:.4g} deg/s, {:.4g} deg/s^2 at most", turn.axis,
                                    scaling::kDegrees * turn.angle, scaling::kDegrees * turn.rate, scaling::kDegrees * turn.acceleration));
    }
    if (!motion.similitude) return;
    const scaling::Similitude& s = *motion.similitude;
    const std::string scale =
        s.length() > 1.0 ? fmt::format("{:.6g}:1, larger than its prototype,", s.length()) : fmt::format("1:{:.6g}", 1.0 / s.length());
    lines.push_back(fmt::format("            model at {} by law {}: time {:.4g}, velocity {:.4g}, acceleration {:.4g} of the prototype's",
                                scale, s.law_name(), s.time(), s.velocity(), s.acceleration()));
}

void describe_run(const SceneSummary& summary, const std::optional<RunTimeEstimate>& run_time, std::vector<std::string>& lines) {
    double duration = 0.0;
    for (const MotionSummary& motion : summary.motions) duration += motion.plan.duration();
    lines.push_back(fmt::format(
        "time        {} in {} of {}{}", write<scaling::Time>(duration), count(summary.steps(), "step"),
        write<scaling::Time>(summary.time_step),
        summary.critical_time_step ? fmt::format(", {:.3g} of the critical step", summary.time_step / *summary.critical_time_step) : ""));
    lines.push_back("at rest     " + summary.preparation_text);
    if (summary.standing.statics) lines.push_back("            " + describe(*summary.standing.statics, summary.standing.blocks));
    std::string files;
    for (const OutputSize& output : summary.outputs) {
        if (output.bytes > 0.0) files += fmt::format(", {} about {}", output.file, write_bytes(output.bytes));
    }
    const std::size_t sensors = summary.specimen.sensors.size();
    lines.push_back(fmt::format("output      {} samples of {} spine blocks, {} frames{}{}", summary.samples(),
                                summary.specimen.spine.size(), summary.frames(), sensors > 0 ? ", " + count(sensors, "sensor") : "",
                                files));
    if (!run_time || run_time->steps == 0) return;
    const std::string rest = run_time->most_preparation > 0.0
                                 ? fmt::format(", {} to {} before it until blocks rest", write_duration(run_time->least_preparation),
                                               write_duration(run_time->most_preparation))
                                 : "";
    lines.push_back(fmt::format("run time    {}{} on {}{}; an estimate, from {} steps of this model that took {:.2g} s",
                                run_time->run < 1.0 ? "" : "about ", write_duration(run_time->run),
                                count(static_cast<std::size_t>(run_time->threads), "thread"), rest, run_time->steps, run_time->seconds));
}

json to_list(const Vector3& v) { return json::array({v.x(), v.y(), v.z()}); }

json to_json(const BlockMaterial& material, double stiffness_base) {
    return {{"density_kg_m3", material.density.value()},
            {"normal_stiffness_n_m", material.normal_stiffness.value()},
            {"shear_stiffness_n_m", material.shear_stiffness.value()},
            {"normal_stiffness_per_area_pa_m", material.normal_stiffness.value() / stiffness_base},
            {"shear_stiffness_per_area_pa_m", material.shear_stiffness.value() / stiffness_base},
            {"friction", material.friction},
            {"restitution", material.restitution},
            {"shear_damping_ratio", material.shear_damping_ratio}};
}

json to_json(const PairEntry& pair, double stiffness_base) {
    json object{{"of", pair.of}};
    if (pair.normal_stiffness) object["normal_stiffness_per_area_pa_m"] = pair.normal_stiffness->value() / stiffness_base;
    if (pair.shear_stiffness) object["shear_stiffness_per_area_pa_m"] = pair.shear_stiffness->value() / stiffness_base;
    if (pair.friction) object["friction"] = *pair.friction;
    if (pair.restitution) object["restitution"] = *pair.restitution;
    if (pair.shear_damping_ratio) object["shear_damping_ratio"] = *pair.shear_damping_ratio;
    return object;
}

json to_json(const MotionSummary& motion) {
    json axes = json::array();
    for (const AxisMotion& axis : motion.axes) {
        json object{{"axis", std::string(1, axis.axis)}, {"pga_m_s2", axis.pga}, {"pgv_m_s", axis.pgv}, {"pgd_m", axis.pgd}};
        object["predominant_period_s"] = axis.predominant_period ? json(*axis.predominant_period) : json();
        object["base_change"] = axis.change ? lsdem::to_json(*axis.change) : json();
        axes.push_back(object);
    }
    json object{{"source", motion.source},
                {"axes", axes},
                {"duration_s", motion.plan.duration()},
                {"steps", motion.plan.steps()},
                {"samples", motion.plan.samples + 1}};
    if (!motion.turns.empty()) object["turns"] = json::array();
    for (const AxisTurn& turn : motion.turns) {
        object["turns"].push_back({{"axis", std::string(1, turn.axis)},
                                   {"angle_rad", turn.angle},
                                   {"angular_velocity_rad_s", turn.rate},
                                   {"angular_acceleration_rad_s2", turn.acceleration}});
    }
    if (!motion.name.empty()) object["name"] = motion.name;
    if (motion.similitude) object["similitude"] = lsdem::to_json(*motion.similitude);
    return object;
}

}  // namespace

std::vector<std::string> describe(const SceneSummary& summary, const std::optional<RunTimeEstimate>& run_time) {
    std::vector<std::string> lines;
    describe_structure(summary, lines);
    for (const MotionSummary& motion : summary.motions) describe_motion(motion, lines);
    if (!summary.estimates.empty()) lines.emplace_back("estimates, of rigid blocks in closed form");
    for (const SceneEstimate& estimate : summary.estimates) {
        lines.push_back(fmt::format("            {}: {}   [{}]", estimate.title, estimate.text, estimate.formula));
    }
    describe_run(summary, run_time, lines);
    return lines;
}

std::vector<std::pair<std::string, std::vector<std::string>>> describe_briefly(const SceneSummary& summary) {
    const std::size_t blocks = summary.specimen.model.blocks.size();
    std::vector<std::pair<std::string, std::vector<std::string>>> properties{
        {"structure",
         {fmt::format("{}, {}", count(blocks, "block"), count(static_cast<std::size_t>(summary.levels), "level")),
          write_size(summary.high - summary.low), write<scaling::Mass>(summary.mass)}}};
    if (summary.kinds.size() == 1) properties.push_back({"block", {write_size(summary.kinds.front().size)}});
    for (const auto& [name, material] : summary.materials) {
        properties.push_back({name.empty() ? "material" : "material " + name,
                              {scaling::format_quantity(material.density),
                               fmt::format("k_n {}, k_s {}", scaling::format_quantity(material.normal_stiffness, 4),
                                           scaling::format_quantity(material.shear_stiffness, 4)),
                               fmt::format("friction {:.4g}, restitution {:.4g}", material.friction, material.restitution)}});
    }
    const bool several = summary.motions.size() > 1;
    const MotionSummary& first = summary.motions.front();
    properties.push_back({"base motion", {several ? count(summary.motions.size(), "motion") : first.source}});
    for (std::size_t k = 0; k < first.axes.size() && !several; ++k) {
        const AxisMotion& axis = first.axes[k];
        properties.back().second.push_back(fmt::format("along {}: {:.3g} g, {}", axis.axis, axis.pga / scaling::kStandardGravity.value(),
                                                       write<scaling::Velocity>(axis.pgv, 3)));
    }
    properties.push_back({"time", {fmt::format("{} steps of {}", summary.steps(), write<scaling::Time>(summary.time_step))}});
    return properties;
}

json to_json(const SceneSummary& summary, const std::optional<RunTimeEstimate>& run_time) {
    json object{{"name", summary.name},
                {"blocks", summary.specimen.model.blocks.size()},
                {"levels", summary.levels},
                {"mass_kg", summary.mass},
                {"size_m", to_list(summary.high - summary.low)},
                {"contact", summary.contact},
                {"dt_s", summary.time_step},
                {"critical_dt_s", summary.critical_time_step ? json(*summary.critical_time_step) : json()},
                {"steps", summary.steps()},
                {"samples", summary.samples()},
                {"frames", summary.frames()},
                {"spine_blocks", summary.specimen.spine.size()},
                {"sensors", summary.specimen.sensors.size()},
                {"at_rest", summary.preparation_text},
                {"standing", to_json(summary.standing)},
                {"warnings", summary.warnings}};
    const Ground& ground = summary.specimen.model.ground;
    object["ground_friction"] = ground.present ? json(ground.material.friction) : json();
    object["kinds"] = json::array();
    for (const BlockKind& kind : summary.kinds) {
        object["kinds"].push_back({{"count", kind.count},
                                   {"size_m", to_list(kind.size)},
                                   {"mass_kg", kind.mass},
                                   {"material", kind.material},
                                   {"fixed", kind.fixed}});
        if (!kind.shape.empty()) object["kinds"].back()["shape"] = kind.shape;
    }
    object["materials"] = json::object();
    for (const auto& [name, material] : summary.materials) object["materials"][name] = to_json(material, summary.stiffness_base.value());
    if (summary.scatter) {
        const Scatter& scatter = *summary.scatter;
        object["scatter"] = {
            {"size_m", scatter.size.value()}, {"place_m", scatter.place.value()}, {"friction", scatter.friction}, {"seed", scatter.seed}};
    }
    object["pairs"] = json::array();
    for (const PairEntry& pair : summary.pairs) object["pairs"].push_back(to_json(pair, summary.stiffness_base.value()));
    object["motions"] = json::array();
    for (const MotionSummary& motion : summary.motions) object["motions"].push_back(to_json(motion));
    object["estimates"] = json::object();
    for (const SceneEstimate& estimate : summary.estimates) {
        object["estimates"][estimate.key] = {{"value", estimate.value ? json(*estimate.value) : json(estimate.text)},
                                             {"what", estimate.title},
                                             {"formula", estimate.formula}};
    }
    object["outputs_bytes"] = json::object();
    for (const OutputSize& output : summary.outputs) object["outputs_bytes"][output.file] = output.bytes;
    if (run_time) {
        object["run_time"] = {{"run_s", run_time->run},
                              {"preparation_s", json::array({run_time->least_preparation, run_time->most_preparation})},
                              {"threads", run_time->threads},
                              {"measured_steps", run_time->steps},
                              {"measured_s", run_time->seconds}};
    }
    return object;
}

}  // namespace musim::lsdem
