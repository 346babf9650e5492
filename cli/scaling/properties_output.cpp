#include "cli/scaling/properties_output.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "cli/named_values.hpp"
#include "cli/pair_rows.hpp"
#include "cli/report.hpp"
#include "cli/scaling/uncertainty_output.hpp"
#include "scaling/laws/length_range.hpp"
#include "scaling/quantity_text.hpp"

namespace musim::cli {
namespace {

using scaling::Direction;
using scaling::GroupClass;
using scaling::GroupComparison;
using scaling::RegimeStatement;
using scaling::Severity;

std::string name_direction(const std::optional<Direction>& direction) { return direction ? std::string(to_string(*direction)) : ""; }

std::string name_severity(const std::optional<Severity>& severity) { return severity ? std::string(to_string(*severity)) : "kept"; }

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
    NamedValues values{{{}, "verdict", regime.severity ? name_severity(regime.severity) : "same"},
                       {"severity", {}, name_or_null(regime.severity)},
                       {"topic", "regime", regime.topic},
                       {{}, "direction", name_direction(regime.direction)},
                       {"direction", {}, name_or_null(regime.direction)}};
    if (uncertain.samples) {
        values.push_back({{}, "another in", format_share(uncertain.samples->shares_elsewhere[i])});
        values.push_back({"share_elsewhere", {}, uncertain.samples->shares_elsewhere[i]});
    }
    if (!uncertain.is_certain()) values.push_back({"limit_within_uncertainty", {}, regime.is_open});
    values.insert(values.end(), {{{}, "sources", join_keys(regime.sources)},
                                 {"sources", {}, regime.sources},
                                 {"statement", "prototype and model", regime.statement}});
    return values;
}

/// One group, by its position in the report.
NamedValues list_group(const PropertiesReport& report, std::size_t i) {
    const GroupComparison& group = report.report.groups[i];
    NamedValues values{{"group", "group", group.name},
                       {"class", {}, to_string(group.kind)},
                       {{}, "direction", name_direction(group.direction)},
                       {"direction", {}, name_or_null(group.direction)}};
    nlohmann::json uncertainty;
    const auto add = [&](const char* key, const char* title, double value, scaling::FirstOrder scaling::UncertainComparison::*side,
                         scaling::SampleSummary scaling::ComparisonSamples::*sampled) {
        values.push_back({key, title, value, ".5g"});
        if (report.uncertain.is_certain()) return;
        const scaling::UncertainComparison& uncertain = report.uncertain.groups[i];
        const scaling::SampleSummary* const samples = uncertain.samples ? &((*uncertain.samples).*sampled) : nullptr;
        values.push_back({{}, coverage_title(), describe_interval(uncertain.*side, samples)});
        uncertainty[key] = cli::to_json(uncertain.*side, report.uncertain.inputs, samples);
    };
    add("prototype", "prototype", group.prototype, &scaling::UncertainComparison::prototype, &scaling::ComparisonSamples::prototype);
    add("model", "model", group.model, &scaling::UncertainComparison::model, &scaling::ComparisonSamples::model);
    add("factor", "model/prototype", group.factor(), &scaling::UncertainComparison::factor, &scaling::ComparisonSamples::factor);
    if (!uncertainty.is_null()) values.push_back({"uncertainty", {}, uncertainty});
    values.insert(values.end(), {{"required", "required", group.is_required},
                                 {{}, "verdict", name_severity(group.severity)},
                                 {"severity", {}, name_or_null(group.severity)},
                                 {{}, "sources", group.severity ? join_keys(group.sources) : ""},
                                 {"sources", {}, group.sources},
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

std::string format_or_dash(const std::optional<double>& value, scaling::Dimension dimension) {
    return value ? scaling::format_si(*value, dimension, 5) : "-";
}

void add_rows(scaling::TextTable& table, const std::vector<PairRow>& rows, const std::string& suffix = "") {
    for (const PairRow& row : rows) {
        const auto factor = row.factor();
        table.rows.push_back({row.title + suffix, format_or_dash(row.prototype, row.dimension), format_or_dash(row.model, row.dimension),
                              format_or_dash(row.required(), row.dimension), factor ? fmt::format("{:.5g}", *factor) : "-",
                              fmt::format("{:.5g}", row.required_factor)});
    }
}

/// Titles of a table of PairRows.
scaling::TextTable start_pairs(const std::string& first) {
    return {{first, "prototype", "model", "similar model", "model/prototype", "by the law"}};
}

std::string describe_untold(const std::vector<scaling::UntoldGroup>& untold) {
    std::string text;
    for (const scaling::UntoldGroup& group : untold) {
        text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", group.name, group.missing == "both" ? "either" : group.missing);
    }
    return text;
}

nlohmann::json to_json(const std::vector<PairRow>& rows) {
    nlohmann::json object = nlohmann::json::object();
    for (const PairRow& row : rows) {
        object[row.key] = {{"prototype", or_null(row.prototype)},
                           {"model", or_null(row.model)},
                           {"required", or_null(row.required())},
                           {"factor", or_null(row.factor())},
                           {"required_factor", row.required_factor}};
    }
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
    text += make_heading("Regimes", style) + make_table(to_table(list_regimes(report)), style);
    for (const GroupClass kind :
         {GroupClass::geometry, GroupClass::friction, GroupClass::contact, GroupClass::rocking, GroupClass::loading}) {
        const auto groups = list_groups(report, [&](const GroupComparison& group) { return group.kind == kind; });
        if (!groups.empty()) text += make_heading("Groups of " + std::string(to_string(kind)), style) + make_table(to_table(groups), style);
    }
    if (properties.motion && properties.model_motion) {
        scaling::TextTable motion = start_pairs("motion");
        add_rows(motion, make_motion_rows(*properties.motion, *properties.model_motion, similitude));
        text += make_heading("Motion", style) + make_table(motion, style);
    }
    scaling::TextTable speeds = start_pairs("structural speed"), rocking = start_pairs("rocking block");
    add_rows(speeds, make_speed_rows(properties, similitude));
    for (const Direction direction : {Direction::thin, Direction::wide}) {
        add_rows(rocking, make_rocking_rows(properties, similitude, direction), fmt::format(", {}", to_string(direction)));
    }
    text += make_heading("Structural speed: derived, Rosakis21 for the number", style) + make_table(speeds, style);
    text += make_heading("Rocking blocks: Housner63", style) + make_table(rocking, style);
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
        rocking[std::string(to_string(direction))] = to_json(make_rocking_rows(report.properties, report.similitude, direction));
    }
    nlohmann::json object = lsdem::to_json(report.similitude);
    object["groups"] = cli::to_json(group_factors(report.similitude, make_model_properties(report.properties)));
    object["distortions"] = cli::to_json(list_groups(report, [](const GroupComparison& group) { return group.severity.has_value(); }));
    nlohmann::json motion;
    if (report.properties.motion && report.properties.model_motion) {
        motion = to_json(make_motion_rows(*report.properties.motion, *report.properties.model_motion, report.similitude));
    }
    object["properties"] = {{"name", report.name},
                            {"prototype", report.properties.prototype.name},
                            {"model", report.properties.model.name},
                            {"groups", cli::to_json(list_groups(report, [](const GroupComparison&) { return true; }))},
                            {"regimes", cli::to_json(list_regimes(report))},
                            {"motion", motion},
                            {"speeds", to_json(make_speed_rows(report.properties, report.similitude))},
                            {"rocking", rocking},
                            {"untold", untold}};
    object["facts"] = object["properties"];  // the old name
    if (!uncertain.is_certain()) {
        object["uncertainty"] = {{"inputs", cli::to_json(uncertain.inputs)},
                                 {"factors", cli::to_json(uncertain.factors, uncertain.inputs)},
                                 {"coverage", scaling::kCoverage}};
        if (uncertain.samples) object["uncertainty"]["monte_carlo"] = cli::to_json(uncertain.samples->draws);
    }
    return object;
}

}  // namespace musim::cli
