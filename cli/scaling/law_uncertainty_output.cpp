#include "cli/scaling/law_uncertainty_output.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/scaling/uncertainty_output.hpp"
#include "scaling/quantity_text.hpp"

namespace musim::cli {
namespace {

using scaling::SolvedLaw;
using scaling::UncertainDifference;
using scaling::UncertainLawReport;
using scaling::UncertainResult;

/// Results that are settled.
std::vector<UncertainResult> drop_open(const std::vector<std::optional<UncertainResult>>& results) {
    std::vector<UncertainResult> settled;
    for (const auto& result : results) {
        if (result) settled.push_back(*result);
    }
    return settled;
}

/// Held products but for definitions, then watched ones.
std::vector<UncertainResult> list_settled_groups(const SolvedLaw& solved, const UncertainLawReport& report) {
    std::vector<std::optional<UncertainResult>> groups;
    for (std::size_t i = 0; i < report.held.size(); ++i) {
        if (!solved.problem.held[i].is_definition) groups.push_back(report.held[i]);
    }
    groups.insert(groups.end(), report.watched.begin(), report.watched.end());
    return drop_open(groups);
}

/// "0.001536, u 2.1e-06, 95 % from 0.00153 to 0.00154".
std::string describe_difference(const UncertainDifference& difference, const scaling::RationalDimension& dimension) {
    const auto in_its_unit = [&](double value, int digits) { return scaling::format_si_like(value, difference.value, dimension, digits); };
    std::string text =
        fmt::format("{}, u {}", in_its_unit(difference.value, 7), format_uncertainty(difference.uncertainty, difference.value, dimension));
    if (difference.samples) {
        text += fmt::format(", {:g} % from {} to {}", 100.0 * scaling::kCoverage, in_its_unit(difference.samples->lower, 4),
                            in_its_unit(difference.samples->upper, 4));
    }
    return text;
}

std::vector<std::string> list_additions(const SolvedLaw& solved, const UncertainLawReport& report) {
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < report.additions.size(); ++i) {
        const auto& addition = report.additions[i];
        if (!addition) continue;
        const scaling::LawAddition& named = solved.law.additions[i];
        lines.push_back(fmt::format("{}, share of the prototype's: {}", named.name, describe_difference(addition->factor, {})));
        if (!addition->model) continue;
        const auto& quantity = solved.problem.quantities[*solved.find_base(named)];
        lines.push_back(fmt::format("{}: {}", named.name, describe_difference(*addition->model, quantity.dimension)));
    }
    return lines;
}

nlohmann::json to_json(const UncertainDifference& difference) {
    nlohmann::json object{{"value", difference.value}, {"standard_uncertainty", difference.uncertainty}};
    if (difference.samples) object["monte_carlo"] = cli::to_json(*difference.samples, 1.0);
    return object;
}

}  // namespace

std::string make_uncertainty_report(const SolvedLaw& solved, const UncertainLawReport& report, scaling::ReportStyle style) {
    std::string text = make_heading("Uncertainty", style) + make_table(make_inputs_table(report.inputs), style);
    const auto add = [&](const scaling::TextTable& table) {
        if (!table.rows.empty()) text += "\n" + make_table(table, style);
    };
    if (report.draws) text += "\n" + make_lines({describe_draws(*report.draws)}, style);
    add(make_results_table("factor", drop_open(report.factors)));
    add(make_results_table("group (1 = kept)", list_settled_groups(solved, report)));
    add(make_results_table("group as shaken", report.shaken));
    add(make_pairs_table("value", report.values));
    const std::vector<std::string> additions = list_additions(solved, report);
    if (!additions.empty()) text += "\n" + make_lines(additions, style);
    return text;
}

nlohmann::json to_json(const SolvedLaw& solved, const UncertainLawReport& report) {
    nlohmann::json values = nlohmann::json::object(), additions = nlohmann::json::object();
    for (const scaling::UncertainPair& pair : report.values) {
        values[pair.name] = {{"prototype", to_json(pair.prototype, 1.0)}, {"model", to_json(pair.model, 1.0)}};
    }
    for (std::size_t i = 0; i < report.additions.size(); ++i) {
        const auto& addition = report.additions[i];
        if (!addition) continue;
        nlohmann::json entry{{"factor", to_json(addition->factor)}};
        if (addition->model) entry["model"] = to_json(*addition->model);
        additions[solved.law.additions[i].name] = entry;
    }
    nlohmann::json object{{"inputs", to_json(report.inputs)},
                          {"factors", to_json(drop_open(report.factors), report.inputs)},
                          {"groups", to_json(list_settled_groups(solved, report), report.inputs)},
                          {"groups_as_shaken", to_json(report.shaken, report.inputs)},
                          {"values", values},
                          {"additions", additions}};
    if (report.draws) object["monte_carlo"] = to_json(*report.draws);
    return object;
}

}  // namespace musim::cli
