#include "cli/scaling/properties_output.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "cli/named_values.hpp"
#include "cli/report.hpp"
#include "cli/scaling/uncertainty_output.hpp"
#include "scaling/angle.hpp"
#include "scaling/dimension.hpp"
#include "scaling/laws/length_range.hpp"
#include "scaling/quantity_text.hpp"
#include "scaling/structures/structural_speed.hpp"

namespace musim::cli {
namespace {

using scaling::Direction;
using scaling::GroupClass;
using scaling::GroupComparison;
using scaling::RegimeStatement;
using scaling::Severity;
using scaling::StructuralSpeeds;
using scaling::StructureProperties;

template <class Named>
std::string name_or(const std::optional<Named>& named, const char* none) {
    return named ? std::string(to_string(*named)) : none;
}

std::string join_keys(const std::vector<std::string>& keys) { return fmt::format("{}", fmt::join(keys, ", ")); }

/// "29 groups: 1 error, 3 warnings, 22 notes".
template <class Entries>
std::string count_severities(const Entries& entries, const std::string& what) {
    int counts[3] = {};
    for (const auto& entry : entries) {
        if (entry.severity) ++counts[static_cast<int>(*entry.severity)];
    }
    const auto name = [](int count, const std::string& word) { return fmt::format("{} {}{}", count, word, count == 1 ? "" : "s"); };
    return fmt::format("{} {}: {}, {}, {}", entries.size(), what, name(counts[static_cast<int>(Severity::error)], "error"),
                       name(counts[static_cast<int>(Severity::warning)], "warning"),
                       name(counts[static_cast<int>(Severity::note)], "note"));
}

/// One regime, by its position in the report.
NamedValues list_regime(const PropertiesReport& report, std::size_t i) {
    const RegimeStatement& regime = report.report.regimes[i];
    const scaling::UncertainRegimes& uncertain = report.uncertain;
    NamedValues values{in_words("severity", "verdict", name_or_null(regime.severity), name_or(regime.severity, "same")),
                       {"topic", "regime", regime.topic},
                       in_words("direction", "direction", name_or_null(regime.direction), name_or(regime.direction, ""))};
    if (uncertain.samples) {
        const double share = uncertain.samples->shares_elsewhere[i];
        values.push_back(in_words("share_elsewhere", "another in", share, format_share(share)));
    }
    if (!uncertain.is_certain()) values.push_back({"limit_within_uncertainty", {}, regime.is_open});
    values.push_back(in_words("sources", "sources", regime.sources, join_keys(regime.sources)));
    values.push_back({"statement", "prototype and model", regime.statement});
    return values;
}

/// One group, by its position in the report.
NamedValues list_group(const PropertiesReport& report, std::size_t i) {
    const GroupComparison& group = report.report.groups[i];
    NamedValues values{{"group", "group", group.name},
                       {"class", {}, to_string(group.kind)},
                       in_words("direction", "direction", name_or_null(group.direction), name_or(group.direction, ""))};
    nlohmann::json uncertainty;
    const auto add = [&](const char* key, const char* title, double value, scaling::FirstOrder scaling::UncertainComparison::*side,
                         scaling::SampleSummary scaling::ComparisonSamples::*sampled) {
        values.push_back({key, title, value, ".5g"});
        if (report.uncertain.is_certain()) return;
        const scaling::UncertainComparison& uncertain = report.uncertain.groups[i];
        const scaling::SampleSummary* const samples = uncertain.samples ? &((*uncertain.samples).*sampled) : nullptr;
        values.push_back({{}, coverage_title(), describe_interval(uncertain.*side, samples)});
        uncertainty[key] = to_json(uncertain.*side, report.uncertain.inputs, samples);
    };
    add("prototype", "prototype", group.prototype, &scaling::UncertainComparison::prototype, &scaling::ComparisonSamples::prototype);
    add("model", "model", group.model, &scaling::UncertainComparison::model, &scaling::ComparisonSamples::model);
    add("factor", "model/prototype", group.factor(), &scaling::UncertainComparison::factor, &scaling::ComparisonSamples::factor);
    if (!uncertainty.is_null()) values.push_back({"uncertainty", {}, uncertainty});
    values.insert(values.end(), {{"required", "required", group.is_required},
                                 in_words("severity", "verdict", name_or_null(group.severity), name_or(group.severity, "kept")),
                                 in_words("sources", "sources", group.sources, group.severity ? join_keys(group.sources) : ""),
                                 {"effect", "what changes", group.effect}});
    return values;
}

std::vector<NamedValues> list_regimes(const PropertiesReport& report) {
    std::vector<NamedValues> rows;
    rows.reserve(report.report.regimes.size());
    for (std::size_t i = 0; i < report.report.regimes.size(); ++i) rows.push_back(list_regime(report, i));
    return rows;
}

/// Those that `accepts`.
template <class Accept>
std::vector<NamedValues> list_groups(const PropertiesReport& report, const Accept& accepts) {
    std::vector<NamedValues> rows;
    for (std::size_t i = 0; i < report.report.groups.size(); ++i) {
        if (accepts(report.report.groups[i])) rows.push_back(list_group(report, i));
    }
    return rows;
}

/// A quantity of prototype and model, with what the model would need, and the factor that similarity asks of it.
struct PairRow {
    std::string key;  ///< in JSON: "shear_wave_speed_m_s"
    NamedValues values;
};

/// Values in SI units in JSON, and in units of their size in tables.
template <class Quantity>
PairRow make_row(const std::string& key, const std::string& title, const std::optional<Quantity>& prototype,
                 const std::optional<Quantity>& model, double required_factor) {
    const auto in_its_unit = [](const char* name, const char* column, const std::optional<double>& value) {
        return in_words(name, column, or_null(value), value ? scaling::format_si(*value, scaling::dimension_of<Quantity>(), 5) : "-");
    };
    std::optional<double> required, factor;
    if (prototype) required = prototype->value() * required_factor;
    if (prototype && model) factor = model->value() / prototype->value();
    return {key,
            {{{}, "", title},
             in_its_unit("prototype", "prototype", in_si(prototype)),
             in_its_unit("model", "model", in_si(model)),
             in_its_unit("required", "similar model", required),
             {"factor", "model/prototype", or_null(factor), ".5g"},
             {"required_factor", "by the law", required_factor, ".5g"}}};
}

std::optional<scaling::Ratio> to_ratio(const std::optional<double>& number) {
    return number ? std::optional(scaling::Ratio::from_value(*number)) : std::nullopt;
}

std::optional<scaling::Velocity> find_sway_speed(const StructureProperties& properties, const StructuralSpeeds& speeds,
                                                 Direction direction) {
    const auto chain = find_rotating_chain(properties, direction);
    if (!chain) return std::nullopt;
    return find_fastest_sway(*chain).speed * *speeds.shear;
}

/// Stiffnesses, moduli, wave speeds and times to climb, S_e^N; of a column whose blocks turn the fastest sway.
std::vector<PairRow> make_speed_rows(const scaling::PairProperties& properties, const scaling::Similitude& similitude) {
    const StructureProperties &prototype = properties.prototype, &model = properties.model;
    const StructuralSpeeds of_prototype = find_structural_speeds(prototype), of_model = find_structural_speeds(model);
    const double velocity = similitude.velocity(), time = similitude.time();
    std::vector<PairRow> rows = {
        make_row("normal_stiffness_n_m", "k_n of a face", prototype.normal_stiffness, model.normal_stiffness,
                 similitude.stiffness_static()),
        make_row("shear_stiffness_n_m", "k_s of a face", prototype.shear_stiffness, model.shear_stiffness, similitude.stiffness()),
        make_row("modulus_pa", "E_eff = k_n H/A", of_prototype.modulus, of_model.modulus, similitude.stress_vertical()),
        make_row("shear_modulus_pa", "G_eff = k_s H/A", of_prototype.shear_modulus, of_model.shear_modulus, similitude.stress()),
        make_row("normal_wave_speed_m_s", "c_n, normal waves", of_prototype.normal, of_model.normal, velocity),
        make_row("shear_wave_speed_m_s", "c_e, interfaces stick", of_prototype.shear, of_model.shear, velocity),
        make_row("slip_front_speed_m_s", "c_e/2, interfaces slip", of_prototype.slip_front, of_model.slip_front, velocity),
    };
    for (const Direction direction : {Direction::thin, Direction::wide}) {
        rows.push_back(make_row(fmt::format("fastest_sway_{}_m_s", to_string(direction)),
                                fmt::format("fastest sway of a column, {} side", to_string(direction)),
                                find_sway_speed(prototype, of_prototype, direction), find_sway_speed(model, of_model, direction),
                                velocity));
    }
    rows.push_back(make_row("climb_stick_s", "base to top, interfaces stick", of_prototype.climb_stick, of_model.climb_stick, time));
    rows.push_back(make_row("climb_slip_s", "base to top, interfaces slip", of_prototype.climb_slip, of_model.climb_slip, time));
    rows.push_back(make_row("structural_speed_number", "S_e^N", to_ratio(of_prototype.number), to_ratio(of_model.number), 1.0));
    return rows;
}

/// R, α, p, e_r and r of the block in one direction.
std::vector<PairRow> make_rocking_rows(const scaling::PairProperties& properties, const scaling::Similitude& similitude,
                                       Direction direction) {
    const scaling::RockingBlock prototype = properties.prototype.rocking_block(direction),
                                model = properties.model.rocking_block(direction);
    // a plain number: as a frequency it would be written in Hz, 2π times too large
    const auto find_p = [](const scaling::RockingBlock& block, const StructureProperties& structure) {
        return scaling::Ratio::from_value(block.frequency_parameter(structure.gravity).value());
    };
    const std::string side = fmt::format(", {}", to_string(direction));
    const auto make = [&](const std::string& key, const std::string& title, auto of_prototype, auto of_model, double required_factor) {
        return make_row(key, title + side, std::optional(of_prototype), std::optional(of_model), required_factor);
    };
    const auto make_plain = [&](const std::string& key, const std::string& title, double of_prototype, double of_model) {
        return make(key, title, *to_ratio(of_prototype), *to_ratio(of_model), 1.0);
    };
    return {make("half_diagonal_m", "R", prototype.half_diagonal(), model.half_diagonal(), similitude.length()),
            make_plain("angle_deg", "alpha [deg]", prototype.angle() / scaling::kDegree, model.angle() / scaling::kDegree),
            make("frequency_parameter_rad_s", "p [rad/s]", find_p(prototype, properties.prototype), find_p(model, properties.model),
                 similitude.frequency()),
            make_plain("angular_restitution", "e_r", prototype.angular_restitution(), model.angular_restitution()),
            make_plain("energy_restitution", "r = e_r^2", prototype.energy_restitution(), model.energy_restitution())};
}

/// Peaks, periods and frequencies of a motion, as far as either gives them.
std::vector<PairRow> make_motion_rows(const scaling::MotionProperties& prototype, const scaling::MotionProperties& model,
                                      const scaling::Similitude& similitude) {
    using scaling::MotionProperties;
    std::vector<PairRow> rows;
    const auto add = [&](const std::string& key, const std::string& title, auto MotionProperties::*value, double required_factor) {
        if (prototype.*value || model.*value) rows.push_back(make_row(key, title, prototype.*value, model.*value, required_factor));
    };
    const double time = similitude.time(), frequency = similitude.frequency();
    rows.push_back(
        make_row("pga_m_s2", "PGA", std::optional(prototype.acceleration), std::optional(model.acceleration), similitude.acceleration()));
    add("pgv_m_s", "PGV", &MotionProperties::velocity, similitude.velocity());
    add("pgd_m", "PGD", &MotionProperties::displacement, similitude.length());
    add("vertical_pga_m_s2", "vertical PGA", &MotionProperties::vertical_acceleration, similitude.acceleration_vertical());
    add("predominant_period_s", "predominant period", &MotionProperties::predominant_period, time);
    add("pulse_period_s", "pulse period", &MotionProperties::pulse_period, time);
    add("duration_s", "duration", &MotionProperties::duration, time);
    add("step_s", "step", &MotionProperties::step, time);
    add("lowest_frequency_hz", "lowest frequency", &MotionProperties::lowest_frequency, frequency);
    add("highest_frequency_hz", "highest frequency", &MotionProperties::highest_frequency, frequency);
    return rows;
}

scaling::TextTable to_table(const std::string& first, const std::vector<PairRow>& rows) {
    std::vector<NamedValues> lines;
    for (const PairRow& row : rows) lines.push_back(row.values);
    scaling::TextTable table = cli::to_table(lines);
    table.header.front() = first;
    return table;
}

std::string describe_untold(const std::vector<scaling::UntoldGroup>& untold) {
    std::string text;
    for (const scaling::UntoldGroup& group : untold) {
        text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", group.name, group.missing == "both" ? "either" : group.missing);
    }
    return text;
}

nlohmann::json make_json(const std::vector<PairRow>& rows) {
    nlohmann::json object = nlohmann::json::object();
    for (const PairRow& row : rows) object[row.key] = to_json(row.values);
    return object;
}

}  // namespace

std::string make_properties_report(const PropertiesReport& report, scaling::ReportStyle style) {
    const scaling::PairProperties& properties = report.properties;
    const scaling::Similitude& similitude = report.similitude;
    std::string text = make_title(report.name.empty() ? properties.model.name + " for " + properties.prototype.name : report.name, style);
    const std::vector<std::string> lines = {
        fmt::format("{} for {}, law {}: length {}, friction {:.7g}, gravity {:.7g}, density {:.7g} (model/prototype)",
                    properties.model.name, properties.prototype.name, similitude.law_name(), scaling::describe_scale(similitude.length()),
                    similitude.friction(), similitude.gravity(), similitude.density()),
        fmt::format("time {:.7g}, velocity {:.7g}, acceleration {:.7g}, force {:.7g}", similitude.time(), similitude.velocity(),
                    similitude.acceleration(), similitude.force()),
        fmt::format("{}; {}", count_severities(report.report.regimes, "regimes"), count_severities(report.report.groups, "groups"))};
    text += make_lines(lines, style);
    if (!report.uncertain.is_certain()) {
        text += make_heading("Uncertain properties, u standard", style) + make_table(make_inputs_table(report.uncertain.inputs), style);
        if (report.uncertain.samples) {
            text += "\n" + make_lines({describe_draws(report.uncertain.samples->draws)}, style);
        }
        text += make_heading("Factors asked for, model/prototype", style) +
                make_table(make_results_table("factor", report.uncertain.factors), style);
    }
    text += make_heading("Regimes", style) + make_table(cli::to_table(list_regimes(report)), style);
    for (const GroupClass kind :
         {GroupClass::geometry, GroupClass::friction, GroupClass::contact, GroupClass::rocking, GroupClass::loading}) {
        const auto groups = list_groups(report, [&](const GroupComparison& group) { return group.kind == kind; });
        if (!groups.empty())
            text += make_heading("Groups of " + std::string(to_string(kind)), style) + make_table(cli::to_table(groups), style);
    }
    if (properties.motion && properties.model_motion) {
        text += make_heading("Motion", style) +
                make_table(to_table("motion", make_motion_rows(*properties.motion, *properties.model_motion, similitude)), style);
    }
    std::vector<PairRow> rocking;
    for (const Direction direction : {Direction::thin, Direction::wide}) {
        const std::vector<PairRow> rows = make_rocking_rows(properties, similitude, direction);
        rocking.insert(rocking.end(), rows.begin(), rows.end());
    }
    text += make_heading("Structural speed: derived, Rosakis21 for the number", style) +
            make_table(to_table("structural speed", make_speed_rows(properties, similitude)), style);
    text += make_heading("Rocking blocks: Housner63", style) + make_table(to_table("rocking block", rocking), style);
    if (!report.report.untold.empty()) {
        text += "\n" + make_paragraph("Not given by prototype or model: " + describe_untold(report.report.untold), style);
    }
    return text;
}

nlohmann::json to_json(const PropertiesReport& report) {
    nlohmann::json untold = nlohmann::json::array(), rocking = nlohmann::json::object();
    const scaling::UncertainRegimes& uncertain = report.uncertain;
    for (const scaling::UntoldGroup& group : report.report.untold) {
        untold.push_back({{"group", std::string(group.name)}, {"missing", std::string(group.missing)}});
    }
    for (const Direction direction : {Direction::thin, Direction::wide}) {
        rocking[std::string(to_string(direction))] = make_json(make_rocking_rows(report.properties, report.similitude, direction));
    }
    nlohmann::json object = lsdem::to_json(report.similitude);
    object["groups"] = to_json(group_factors(report.similitude, make_model_properties(report.properties)));
    object["distortions"] = to_json(list_groups(report, [](const GroupComparison& group) { return group.severity.has_value(); }));
    nlohmann::json motion;
    if (report.properties.motion && report.properties.model_motion) {
        motion = make_json(make_motion_rows(*report.properties.motion, *report.properties.model_motion, report.similitude));
    }
    object["properties"] = {{"name", report.name},
                            {"prototype", report.properties.prototype.name},
                            {"model", report.properties.model.name},
                            {"groups", to_json(list_groups(report, [](const GroupComparison&) { return true; }))},
                            {"regimes", to_json(list_regimes(report))},
                            {"motion", motion},
                            {"speeds", make_json(make_speed_rows(report.properties, report.similitude))},
                            {"rocking", rocking},
                            {"untold", untold}};
    if (!uncertain.is_certain()) {
        object["uncertainty"] = {{"inputs", to_json(uncertain.inputs)},
                                 {"factors", to_json(uncertain.factors, uncertain.inputs)},
                                 {"coverage", scaling::kCoverage}};
        if (uncertain.samples) object["uncertainty"]["monte_carlo"] = to_json(uncertain.samples->draws);
    }
    return object;
}

}  // namespace musim::cli
