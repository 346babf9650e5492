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

using End = std::optional<scaling::FirstOrder>;

std::string describe_end_interval(const End& end) {
    if (!end || end->relative == 0.0) return "-";
    const scaling::CoverageInterval interval = scaling::find_interval(*end);
    return fmt::format("{} to {}", scaling::describe_scale(interval.lower), scaling::describe_scale(interval.upper));
}

nlohmann::json end_to_json(const End& end, const std::vector<scaling::UncertainInput>& inputs) {
    return end ? to_json(*end, inputs) : nlohmann::json();
}

/// Median and coverage interval of a length scale.
std::vector<std::string> describe_scales(const scaling::SampleSummary& scales) {
    if (scales.given == 0) return {"-", "-"};
    return {scaling::describe_scale(scales.median),
            fmt::format("{} to {}", scaling::describe_scale(scales.lower), scaling::describe_scale(scales.upper))};
}

nlohmann::json scales_to_json(const scaling::SampleSummary& scales) { return scales.given == 0 ? nlohmann::json() : to_json(scales, 1.0); }

/// A column behind the last one, `cell(i)` in row i.
template <class Cell>
void add_column(scaling::TextTable& table, const std::string& title, const Cell& cell) {
    table.header.push_back(title);
    for (std::size_t i = 0; i < table.rows.size(); ++i) table.rows[i].push_back(cell(i));
}

/// A column for each state, `cell(state, i)` in row i, and one of coverage intervals behind it where something is uncertain.
template <class Cell>
void add_states(scaling::TextTable& table, const std::vector<ReportedState>& states, const std::string& at, const Cell& cell,
                std::vector<scaling::FirstOrder> records::UncertainState::*intervals) {
    for (const ReportedState& each : states) {
        add_column(table, at + describe_scale(each.state->length), [&](std::size_t i) { return cell(*each.state, i); });
        if (each.uncertain == nullptr) continue;
        add_column(table, coverage_title(), [&](std::size_t i) { return describe_interval((each.uncertain->*intervals)[i]); });
    }
}

/// Coverage intervals of the ends of a limit's ranges: "1/149.8 to 1/143.1 ... -"; "-" where all are certain.
std::string describe_ends(const std::vector<records::UncertainRange>& ranges) {
    std::string text;
    const auto is_certain = [](const records::UncertainRange& range) {
        return describe_end_interval(range.smallest) == "-" && describe_end_interval(range.largest) == "-";
    };
    if (std::all_of(ranges.begin(), ranges.end(), is_certain)) return "-";
    for (const records::UncertainRange& range : ranges) {
        text += fmt::format("{}{} ... {}", text.empty() ? "" : ", ", describe_end_interval(range.smallest),
                            describe_end_interval(range.largest));
    }
    return text;
}

scaling::TextTable make_limits(const Candidate& candidate, const records::UncertainCandidate* uncertain) {
    scaling::TextTable table{{"limit", "length scales"}};
    for (const records::LimitRanges& limit : candidate.limits) table.rows.push_back({limit.limit, describe_ranges(limit.ranges)});
    if (uncertain != nullptr) add_column(table, coverage_title(), [&](std::size_t i) { return describe_ends(uncertain->limits[i]); });
    const std::vector<ReportedState> states = find_states(candidate, uncertain);
    const auto describe_use = [](const ModelState& state, std::size_t i) {
        const double used = state.uses[i].used();
        return fmt::format("{:.4f}{}", used, used > 1.0 ? " too much" : "");
    };
    add_states(table, states, "used at ", describe_use, &records::UncertainState::used);
    if (states.empty()) return table;
    const ModelState& last = *states.back().state;
    const auto add_amount = [&](const std::string& title, double records::Use::*amount) {
        add_column(table, title, [&](std::size_t i) { return records::describe_amount(last.uses[i].*amount, last.uses[i].unit); });
    };
    add_amount("asked at " + describe_scale(last.length), &records::Use::demand);
    add_amount("limit is", &records::Use::bound);
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
    const auto describe_factor = [](const ModelState& state, std::size_t i) {
        return fmt::format("{:.5g}", state.scales.*scaling::kModelScales[i].factor);
    };
    add_states(table, states, "at ", describe_factor, &records::UncertainState::scales);
    return table;
}

scaling::TextTable make_groups(const records::Design& design, const Candidate& candidate, const std::vector<ReportedState>& states) {
    scaling::TextTable table{{"group", "weighed"}};
    for (const records::GroupFactor& group : states.front().state->groups) {
        const bool is_weighed = std::find(design.groups.begin(), design.groups.end(), group.name) != design.groups.end();
        table.rows.push_back({group.name, is_weighed ? "yes" : ""});
    }
    const auto describe_group = [](const ModelState& state, std::size_t i) { return fmt::format("{:.4f}", state.groups[i].value); };
    add_states(table, states, "d at ", describe_group, &records::UncertainState::groups);
    const ModelState& remarked = candidate.ranked ? *candidate.ranked : *states.front().state;
    add_column(table, "remark", [&](std::size_t i) { return find_remark(remarked.distortions, remarked.groups[i].name); });
    return table;
}

/// The ends of all feasible ranges that a limit sets: what binds, u, the coverage interval, and the input that matters most.
scaling::TextTable make_ends_table(const std::vector<records::Candidate>& candidates, const DesignUncertainty& uncertainty) {
    scaling::TextTable table{{"material", "law", "end", "governing limit", "length scale", "u/value", coverage_title(), "mostly by"}};
    for (std::size_t c = 0; c < candidates.size(); ++c) {
        const records::Candidate& candidate = candidates[c];
        const auto add = [&](const char* name, const End& end, const std::string& limit) {
            if (!end) return;
            table.rows.push_back({candidate.material.name, candidate.law.name(), name, limit, scaling::describe_scale(end->value),
                                  format_share(end->relative), describe_end_interval(end), describe_main_input(*end, uncertainty.inputs)});
        };
        for (std::size_t i = 0; i < candidate.ranges.size(); ++i) {
            add("smallest", uncertainty.candidates[c].ranges[i].smallest, candidate.ranges[i].binds_below);
            add("largest", uncertainty.candidates[c].ranges[i].largest, candidate.ranges[i].binds_above);
        }
    }
    return table;
}

/// By samples: in how many each candidate is feasible, and the ends of its length scales then.
scaling::TextTable make_sampled_ends_table(const std::vector<records::Candidate>& candidates, const records::SampledDesign& samples) {
    scaling::TextTable table{{"material", "law", "feasible in", "smallest: median", coverage_title(), "largest: median", coverage_title()}};
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const records::SampledCandidate& sampled = samples.candidates[i];
        std::vector<std::string> row{candidates[i].material.name, candidates[i].law.name(), format_share(sampled.feasible)};
        for (const std::string& cell : describe_scales(sampled.smallest)) row.push_back(cell);
        for (const std::string& cell : describe_scales(sampled.largest)) row.push_back(cell);
        table.rows.push_back(row);
    }
    return table;
}

/// By samples: which limits are governing, or broken at the given length. Limits that never are have no row.
scaling::TextTable make_sampled_limits_table(const std::vector<records::Candidate>& candidates, const records::SampledDesign& samples) {
    scaling::TextTable table{{"material", "law", "limit", "smaller: governs in", "larger: governs in", "too much in", "at"}};
    for (std::size_t c = 0; c < candidates.size(); ++c) {
        const records::SampledCandidate& sampled = samples.candidates[c];
        for (std::size_t i = 0; i < sampled.limits.size(); ++i) {
            const records::SampledLimit& limit = sampled.limits[i];
            if (limit.sets_smallest == 0.0 && limit.sets_largest == 0.0 && limit.broken.value_or(0.0) == 0.0) continue;
            table.rows.push_back({candidates[c].material.name, candidates[c].law.name(), candidates[c].limits[i].limit,
                                  format_share(limit.sets_smallest), format_share(limit.sets_largest),
                                  format_share(limit.broken.value_or(0.0)),
                                  sampled.length ? scaling::describe_scale(*sampled.length) : "-"});
        }
    }
    return table;
}

std::string name_candidate(const Candidate& candidate) { return fmt::format("{}, law {}", candidate.material.name, candidate.law.name()); }

nlohmann::json make_json(const scaling::LengthRange& range) { return {range.smallest, range.largest}; }

nlohmann::json make_json(const std::vector<records::GroupFactor>& groups) {
    nlohmann::json object = nlohmann::json::object();
    for (const records::GroupFactor& group : groups) object[group.name] = group.value;
    return object;
}

/// {"groups" and "factors" by name, "used" in the order of the limits, "mass_kg", "cost"}.
nlohmann::json make_json(const records::ModelState& state, const records::UncertainState& uncertain,
                         const std::vector<scaling::UncertainInput>& inputs) {
    nlohmann::json groups = nlohmann::json::object(), factors = nlohmann::json::object(), used = nlohmann::json::array();
    for (std::size_t i = 0; i < state.groups.size(); ++i) groups[state.groups[i].name] = to_json(uncertain.groups[i], inputs);
    for (std::size_t i = 0; i < std::size(scaling::kModelScales); ++i) {
        factors[std::string(scaling::kModelScales[i].name)] = to_json(uncertain.scales[i], inputs);
    }
    for (const scaling::FirstOrder& share : uncertain.used) used.push_back(to_json(share, inputs));
    return {{"groups", groups},
            {"factors", factors},
            {"used", used},
            {"mass_kg", to_json(uncertain.mass, inputs)},
            {"cost", end_to_json(uncertain.cost, inputs)}};
}

/// {"smallest", "largest"}; null for an end that no limit sets.
nlohmann::json make_json(const records::UncertainRange& range, const std::vector<scaling::UncertainInput>& inputs) {
    return {{"smallest", end_to_json(range.smallest, inputs)}, {"largest", end_to_json(range.largest, inputs)}};
}

nlohmann::json make_json(const ReportedState& given, const std::vector<scaling::UncertainInput>& inputs) {
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
                             {"groups", make_json(state.groups)},
                             {"distortions", lsdem::to_json(state.distortions)},
                             {"measure", state.measure},
                             {"mass_kg", state.mass.value()},
                             {"added_mass_kg", state.added_mass.value()},
                             {"cost", or_null(state.cost)}};
    if (given.uncertain != nullptr) object["uncertainty"] = make_json(state, *given.uncertain, inputs);
    return object;
}

nlohmann::json make_json(const Candidate& candidate, const records::UncertainCandidate* uncertain,
                         const std::vector<scaling::UncertainInput>& inputs) {
    const std::vector<ReportedState> states = find_states(candidate, uncertain);
    nlohmann::json ranges = nlohmann::json::array(), limits = nlohmann::json::array(), conflict, ranked;
    if (candidate.ranked) ranked = make_json({&*candidate.ranked, uncertain == nullptr ? nullptr : &*uncertain->ranked}, inputs);
    for (std::size_t i = 0; i < candidate.ranges.size(); ++i) {
        const records::FeasibleRange& range = candidate.ranges[i];
        ranges.push_back({{"smallest", range.scales.smallest},
                          {"largest", range.scales.largest},
                          {"binds_below", text_or_null(range.binds_below)},
                          {"binds_above", text_or_null(range.binds_above)},
                          {"at_smallest", make_json(states[2 * i], inputs)},
                          {"at_largest", make_json(states[2 * i + 1], inputs)}});
        if (uncertain != nullptr) ranges.back()["uncertainty"] = make_json(uncertain->ranges[i], inputs);
    }
    for (std::size_t i = 0; i < candidate.limits.size(); ++i) {
        const records::LimitRanges& limit = candidate.limits[i];
        limits.push_back({{"limit", limit.limit}, {"scales", nlohmann::json::array()}});
        for (const scaling::LengthRange& range : limit.ranges) limits.back()["scales"].push_back(make_json(range));
        if (uncertain == nullptr) continue;
        limits.back()["uncertainty"] = nlohmann::json::array();
        for (const records::UncertainRange& range : uncertain->limits[i]) {
            limits.back()["uncertainty"].push_back(make_json(range, inputs));
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
            {"at_length", candidate.chosen ? make_json(states.back(), inputs) : nlohmann::json()}};
}

/// {"feasible_share", "smallest" and "largest" of the samples that are (null when none is), "length" at which limits are reported broken,
/// "limits": [{"limit", "sets_smallest_share", "sets_largest_share", "broken_share"}]}.
nlohmann::json make_json(const records::Candidate& candidate, const records::SampledCandidate& sampled) {
    nlohmann::json limits = nlohmann::json::array();
    for (std::size_t i = 0; i < sampled.limits.size(); ++i) {
        const records::SampledLimit& limit = sampled.limits[i];
        limits.push_back({{"limit", candidate.limits[i].limit},
                          {"sets_smallest_share", limit.sets_smallest},
                          {"sets_largest_share", limit.sets_largest},
                          {"broken_share", scaling::or_null(limit.broken)}});
    }
    return {{"feasible_share", sampled.feasible},
            {"smallest", scales_to_json(sampled.smallest)},
            {"largest", scales_to_json(sampled.largest)},
            {"length", scaling::or_null(sampled.length)},
            {"limits", limits}};
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
        list.push_back(make_json(candidates[i], uncertainty.find(i), uncertainty.inputs));
        if (uncertainty.samples) list.back()["monte_carlo"] = make_json(candidates[i], uncertainty.samples->candidates[i]);
    }
    nlohmann::json object = {
        {"name", design.name}, {"gravity", design.gravity.value_or(1.0)}, {"groups", design.groups}, {"candidates", list}};
    if (!uncertainty.is_certain()) object["uncertainty"] = {{"inputs", to_json(uncertainty.inputs)}, {"coverage", scaling::kCoverage}};
    if (uncertainty.samples) object["uncertainty"]["monte_carlo"] = to_json(uncertainty.samples->draws);
    return object;
}

}  // namespace musim::cli
