#include "cli/records/design_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/length_ranges.hpp"
#include "cli/named_values.hpp"
#include "cli/report.hpp"
#include "cli/scaling/uncertainty_output.hpp"
#include "scaling/quantity_text.hpp"

namespace musim::cli {
namespace {

using records::Candidate;
using records::ModelState;
using scaling::describe_scale;

/// "1", "2", ...; "-" for what changes the regime or is infeasible.
std::string describe_rank(const Candidate& candidate, std::size_t index) {
    return candidate.is_feasible() && !candidate.changes_regime() ? std::to_string(index + 1) : "-";
}

std::string describe_end(const std::string& limit) { return limit.empty() ? "the end of the search" : limit; }

std::string describe_remark(const Candidate& candidate) {
    if (!candidate.is_feasible()) return "infeasible";
    return candidate.changes_regime() ? "excluded: changes between sliding and rocking" : "";
}

std::string describe_mass(const ModelState& state) {
    const std::string mass = scaling::format_quantity(state.mass, 4);
    return state.added_mass.value() > 0.0 ? fmt::format("{} ({} added)", mass, scaling::format_quantity(state.added_mass, 4)) : mass;
}

scaling::TextTable make_ranking(const std::vector<Candidate>& candidates) {
    scaling::TextTable table{{"rank", "material", "law", "length scales", "smaller: governing limit", "larger: governing limit",
                              "ranked at", "sum |ln d|", "mass", "cost", "remark"}};
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const Candidate& candidate = candidates[i];
        std::string scales, below, above;
        for (const records::FeasibleRange& range : candidate.ranges) {
            const std::string separator = scales.empty() ? "" : ", ";
            scales += separator + describe_scale(range.scales.smallest) + " ... " + describe_scale(range.scales.largest);
            below += separator + describe_end(range.binds_below);
            above += separator + describe_end(range.binds_above);
        }
        std::vector<std::string> row{
            describe_rank(candidate, i), candidate.material.name, candidate.law.name(), scales.empty() ? "none" : scales, below, above};
        if (const auto& state = candidate.ranked) {
            row.insert(row.end(), {describe_scale(state->length), fmt::format("{:.4g}", state->measure), describe_mass(*state),
                                   state->cost ? fmt::format("{:.4g}", *state->cost) : ""});
        } else {
            row.insert(row.end(), 4, "");
        }
        row.push_back(describe_remark(candidate));
        table.rows.push_back(row);
    }
    return table;
}

/// A model that a candidate is looked at, with its uncertain side; null where all is certain.
struct ReportedState {
    const ModelState* state;
    const records::UncertainState* uncertain;
};

/// The ends of its ranges, and the length in mind.
std::vector<ReportedState> find_states(const Candidate& candidate, const records::UncertainCandidate* uncertain) {
    std::vector<ReportedState> states;
    for (std::size_t i = 0; i < candidate.ends.size(); ++i) {
        states.push_back({&candidate.ends[i], uncertain == nullptr ? nullptr : &uncertain->ends[i]});
    }
    if (candidate.chosen) states.push_back({&*candidate.chosen, uncertain == nullptr ? nullptr : &*uncertain->chosen});
    return states;
}

scaling::TextTable make_limits(const Candidate& candidate, const records::UncertainCandidate* uncertain_candidate) {
    scaling::TextTable table{{"limit", "length scales"}};
    for (const records::LimitRanges& limit : candidate.limits) table.rows.push_back({limit.limit, describe_ranges(limit.ranges)});
    if (uncertain_candidate != nullptr) {
        table.header.push_back(coverage_title());
        for (std::size_t i = 0; i < table.rows.size(); ++i) table.rows[i].push_back(describe_ends(uncertain_candidate->limits[i]));
    }
    const std::vector<ReportedState> states = find_states(candidate, uncertain_candidate);
    for (const auto& [state, uncertain] : states) {
        table.header.push_back("used at " + describe_scale(state->length));
        for (std::size_t i = 0; i < state->uses.size(); ++i) {
            const double used = state->uses[i].used();
            table.rows[i].push_back(fmt::format("{:.4f}{}", used, used > 1.0 ? " too much" : ""));
        }
        if (uncertain != nullptr) add_intervals(table, uncertain->used);
    }
    if (states.empty()) return table;
    const ModelState& last = *states.back().state;
    table.header.push_back("asked at " + describe_scale(last.length));
    table.header.emplace_back("limit is");
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const records::Use& use = last.uses[i];
        table.rows[i].push_back(records::describe_amount(use.demand, use.unit));
        table.rows[i].push_back(records::describe_amount(use.bound, use.unit));
    }
    return table;
}

std::string find_remark(const std::vector<scaling::Distortion>& distortions, std::string_view group) {
    for (const scaling::Distortion& each : distortions) {
        if (each.group == group) return fmt::format("{}: {}", to_string(each.severity), each.effect);
    }
    return "";
}

scaling::TextTable make_factors(const std::vector<ReportedState>& states) {
    scaling::TextTable table{{"factor"}};
    for (const scaling::ModelScale& scale : scaling::kModelScales) table.rows.push_back({std::string(scale.name)});
    for (const auto& [state, uncertain] : states) {
        table.header.push_back("at " + describe_scale(state->length));
        for (std::size_t i = 0; i < table.rows.size(); ++i) {
            table.rows[i].push_back(fmt::format("{:.5g}", state->scales.*scaling::kModelScales[i].factor));
        }
        if (uncertain != nullptr) add_intervals(table, uncertain->scales);
    }
    return table;
}

scaling::TextTable make_groups(const records::Design& design, const Candidate& candidate, const std::vector<ReportedState>& states) {
    scaling::TextTable table{{"group", "weighed"}};
    for (const records::GroupFactor& group : states.front().state->groups) {
        const bool is_weighed = std::find(design.groups.begin(), design.groups.end(), group.name) != design.groups.end();
        table.rows.push_back({group.name, is_weighed ? "yes" : ""});
    }
    for (const auto& [state, uncertain] : states) {
        table.header.push_back("d at " + describe_scale(state->length));
        for (std::size_t i = 0; i < state->groups.size(); ++i) table.rows[i].push_back(fmt::format("{:.4f}", state->groups[i].value));
        if (uncertain != nullptr) add_intervals(table, uncertain->groups);
    }
    table.header.emplace_back("remark");
    const ModelState& remarked = candidate.ranked ? *candidate.ranked : *states.front().state;
    for (std::size_t i = 0; i < table.rows.size(); ++i) table.rows[i].push_back(find_remark(remarked.distortions, remarked.groups[i].name));
    return table;
}

std::string name_candidate(const Candidate& candidate) { return fmt::format("{}, law {}", candidate.material.name, candidate.law.name()); }

nlohmann::json to_json(const scaling::LengthRange& range) { return {range.smallest, range.largest}; }

nlohmann::json to_json(const std::vector<records::GroupFactor>& groups) {
    nlohmann::json object = nlohmann::json::object();
    for (const records::GroupFactor& group : groups) object[group.name] = group.value;
    return object;
}

nlohmann::json to_json(const ReportedState& given, const std::vector<scaling::UncertainInput>& inputs) {
    const ModelState& state = *given.state;
    nlohmann::json uses = nlohmann::json::array();
    for (const records::Use& use : state.uses) {
        uses.push_back({{"limit", use.limit},
                        {"unit", use.unit},
                        {"demand", use.demand},
                        {"bound", use.bound},
                        {"floor", use.is_floor},
                        {"used", use.used()}});
    }
    nlohmann::json factors = nlohmann::json::object();
    for (const scaling::ModelScale& scale : scaling::kModelScales) factors[std::string(scale.name)] = state.scales.*scale.factor;
    nlohmann::json object = {{"length", state.length},
                             {"factors", factors},
                             {"uses", uses},
                             {"groups", to_json(state.groups)},
                             {"distortions", lsdem::to_json(state.distortions)},
                             {"measure", state.measure},
                             {"mass_kg", state.mass.value()},
                             {"added_mass_kg", state.added_mass.value()},
                             {"cost", or_null(state.cost)}};
    if (given.uncertain != nullptr) object["uncertainty"] = cli::to_json(state, *given.uncertain, inputs);
    return object;
}

nlohmann::json to_json(const Candidate& candidate, const records::UncertainCandidate* uncertain,
                       const std::vector<scaling::UncertainInput>& inputs) {
    const std::vector<ReportedState> states = find_states(candidate, uncertain);
    nlohmann::json ranges = nlohmann::json::array(), limits = nlohmann::json::array(), conflict, ranked;
    if (candidate.ranked) ranked = to_json({&*candidate.ranked, uncertain == nullptr ? nullptr : &*uncertain->ranked}, inputs);
    for (std::size_t i = 0; i < candidate.ranges.size(); ++i) {
        const records::FeasibleRange& range = candidate.ranges[i];
        ranges.push_back({{"smallest", range.scales.smallest},
                          {"largest", range.scales.largest},
                          {"binds_below", text_or_null(range.binds_below)},
                          {"binds_above", text_or_null(range.binds_above)},
                          {"at_smallest", to_json(states[2 * i], inputs)},
                          {"at_largest", to_json(states[2 * i + 1], inputs)}});
        if (uncertain != nullptr) ranges.back()["uncertainty"] = cli::to_json(uncertain->ranges[i], inputs);
    }
    for (std::size_t i = 0; i < candidate.limits.size(); ++i) {
        const records::LimitRanges& limit = candidate.limits[i];
        limits.push_back({{"limit", limit.limit}, {"scales", nlohmann::json::array()}});
        for (const scaling::LengthRange& range : limit.ranges) limits.back()["scales"].push_back(to_json(range));
        if (uncertain == nullptr) continue;
        limits.back()["uncertainty"] = nlohmann::json::array();
        for (const records::UncertainRange& range : uncertain->limits[i]) {
            limits.back()["uncertainty"].push_back(cli::to_json(range, inputs));
        }
    }
    if (candidate.conflict) {
        conflict = {{"upper", candidate.conflict->upper},
                    {"lower", candidate.conflict->lower},
                    {"at_most", candidate.conflict->at_most},
                    {"at_least", candidate.conflict->at_least}};
    }
    return {{"material", candidate.material.name},
            {"law", candidate.law.name()},
            {"feasible", candidate.is_feasible()},
            {"changes_regime", candidate.changes_regime()},
            {"ranges", ranges},
            {"limits", limits},
            {"conflict", conflict},
            {"problem", text_or_null(candidate.problem)},
            {"ranked_at", ranked},
            {"at_length", candidate.chosen ? to_json(states.back(), inputs) : nlohmann::json()}};
}

}  // namespace

std::string make_design_report(const records::Design& design, const std::vector<Candidate>& candidates,
                               const DesignUncertainty& uncertainty, scaling::ReportStyle style) {
    std::string text = make_title(design.name.empty() ? "Design" : design.name, style) + make_table(make_ranking(candidates), style);
    for (const Candidate& candidate : candidates) {
        if (candidate.is_feasible()) continue;
        text += "\n" + make_paragraph(fmt::format("{} is infeasible: {}", name_candidate(candidate), candidate.problem), style);
    }
    if (!uncertainty.is_certain()) {
        text += make_heading("Uncertain values, u standard", style) + make_table(make_inputs_table(uncertainty.inputs), style);
        text +=
            make_heading("Ends of the length scales, to first order", style) + make_table(make_ends_table(candidates, uncertainty), style);
        if (uncertainty.samples) {
            text += make_heading("Length scales that are feasible, by samples", style) +
                    make_lines({describe_draws(uncertainty.samples->draws)}, style) + "\n" +
                    make_table(make_sampled_ends_table(candidates, *uncertainty.samples), style) +
                    make_heading("Governing limits, by samples", style) +
                    make_table(make_sampled_limits_table(candidates, *uncertainty.samples), style);
        }
    }
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const Candidate& candidate = candidates[i];
        if (candidate.limits.empty()) continue;
        const records::UncertainCandidate* const uncertain = uncertainty.find(i);
        text += make_heading(name_candidate(candidate) + ": limits", style) + make_table(make_limits(candidate, uncertain), style);
        const std::vector<ReportedState> states = find_states(candidate, uncertain);
        if (states.empty()) continue;
        text += make_heading(name_candidate(candidate) + ": factors, model/prototype", style) + make_table(make_factors(states), style);
        text += make_heading(name_candidate(candidate) + ": groups, d = model/prototype", style) +
                make_table(make_groups(design, candidate, states), style);
    }
    return text;
}

nlohmann::json to_json(const records::Design& design, const std::vector<Candidate>& candidates, const DesignUncertainty& uncertainty) {
    nlohmann::json list = nlohmann::json::array();
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        list.push_back(to_json(candidates[i], uncertainty.find(i), uncertainty.inputs));
        if (uncertainty.samples) list.back()["monte_carlo"] = cli::to_json(candidates[i], uncertainty.samples->candidates[i]);
    }
    nlohmann::json object = {
        {"name", design.name}, {"gravity", design.gravity.value_or(1.0)}, {"groups", design.groups}, {"candidates", list}};
    if (!uncertainty.is_certain()) object["uncertainty"] = {{"inputs", cli::to_json(uncertainty.inputs)}, {"coverage", scaling::kCoverage}};
    if (uncertainty.samples) object["uncertainty"]["monte_carlo"] = cli::to_json(uncertainty.samples->draws);
    return object;
}

}  // namespace musim::cli
