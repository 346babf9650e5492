#include "cli/scaling/law_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/scaling/uncertainty_output.hpp"
#include "scaling/laws/named_groups.hpp"
#include "scaling/laws/scale_law_json.hpp"
#include "scaling/laws/scale_text.hpp"
#include "scaling/quantity_text.hpp"
#include "scaling/structures/distortion.hpp"

namespace musim::cli {
namespace {

using nlohmann::json;
using scaling::PiNotation;
using scaling::PiQuantity;
using scaling::ReportStyle;
using scaling::ScaleFactor;
using scaling::ScaleState;
using scaling::SolvedLaw;
using scaling::UncertainDifference;
using scaling::UncertainLawReport;
using scaling::UncertainResult;

/// Digits of factors, as in the other tables of `scale`.
constexpr int kFactorDigits = 7;
constexpr const char* kFactorFormat = ".7g";

/// A product of the law with its δ.
struct LawGroup {
    const scaling::ScaleProduct& product;
    const ScaleFactor& delta;
    bool is_held;

    std::string name(const SolvedLaw& solved) const {
        return scaling::recognised_text(scaling::recognise(product.exponents, solved.problem.quantities));
    }
};

/// Held products but for definitions, then watched ones.
std::vector<LawGroup> list_groups(const SolvedLaw& solved) {
    std::vector<LawGroup> groups;
    for (std::size_t i = 0; i < solved.problem.held.size(); ++i) {
        if (!solved.problem.held[i].is_definition) groups.push_back({solved.problem.held[i], solved.solution.held[i], true});
    }
    for (std::size_t i = 0; i < solved.problem.watched.size(); ++i) {
        groups.push_back({solved.problem.watched[i], solved.solution.watched[i], false});
    }
    return groups;
}

std::vector<std::string> names_of(const SolvedLaw& solved, const std::vector<std::size_t>& positions) {
    std::vector<std::string> names;
    names.reserve(positions.size());
    for (const std::size_t j : positions) names.push_back(solved.problem.quantities[j].name);
    return names;
}

std::string formula(const SolvedLaw& solved, const ScaleFactor& factor, PiNotation notation = PiNotation::text) {
    return scaling::format_factor(factor.exponents, solved.problem.quantities, notation);
}

/// "chosen", "default", "solved", "free" or "needs l, rho".
std::string describe_state(const SolvedLaw& solved, std::size_t j) {
    const scaling::QuantityScale& scale = solved.solution.quantities[j];
    if (solved.is_default[j]) return "default";
    if (scale.state != ScaleState::needs) return std::string(to_string(scale.state));
    return fmt::format("needs {}", fmt::join(names_of(solved, scale.factor.needs), ", "));
}

/// A quantity of the model, where the prototype's and the factor are known.
std::optional<double> find_model_value(const SolvedLaw& solved, std::size_t j) {
    const auto& prototype = solved.problem.quantities[j].value;
    const auto& factor = solved.solution.quantities[j].factor.value;
    return prototype && factor ? std::optional(*prototype * *factor) : std::nullopt;
}

/// Amount to be added, in the unit of the quantity, where the prototype's is known.
std::optional<double> find_added_value(const SolvedLaw& solved, const scaling::LawAddition& addition) {
    const auto base = solved.find_base(addition);
    const auto factor = solved.added(addition);
    return base && factor ? std::optional(*solved.problem.quantities[*base].value * *factor) : std::nullopt;
}

/// "l^2*E/g - l^3*rho_s".
std::string addition_formula(const SolvedLaw& solved, const scaling::LawAddition& addition, PiNotation notation = PiNotation::text) {
    const auto side = [&](const std::string& name) {
        return formula(solved, solved.solution.quantities[scaling::find_quantity(solved.problem.quantities, name)].factor, notation);
    };
    return fmt::format("{} - {}", side(addition.total), side(addition.own));
}

std::string describe_addition(const SolvedLaw& solved, const scaling::LawAddition& addition) {
    const PiQuantity& own = solved.problem.quantities[scaling::find_quantity(solved.problem.quantities, addition.own)];
    const auto factor = solved.added(addition);
    std::string text = fmt::format("{}: {} = {} of the prototype's {}", addition.name, addition_formula(solved, addition),
                                   or_dash(factor, kFactorDigits), own.name);
    if (const auto value = find_added_value(solved, addition)) text += fmt::format(", {}", scaling::format_value(*value, own));
    if (factor && *factor < 0.0) text += fmt::format("; negative: {} is more than {} already", addition.own, addition.total);
    return text;
}

/// Remarks beside the tables, one line each.
std::vector<std::string> list_remarks(const SolvedLaw& solved) {
    std::vector<std::string> lines;
    for (const scaling::LawAddition& addition : solved.law.additions) lines.push_back(describe_addition(solved, addition));
    if (solved.solution.free_count > 0) {
        lines.push_back(fmt::format("{} more may be chosen, among {}", solved.solution.free_count,
                                    fmt::join(names_of(solved, solved.solution.open), ", ")));
    }
    for (const std::size_t j : solved.overruled) {
        lines.push_back(fmt::format("{} is not the law's default: {} = {} by what is chosen", solved.problem.quantities[j].name,
                                    formula(solved, solved.solution.quantities[j].factor),
                                    or_dash(solved.solution.quantities[j].factor.value, kFactorDigits)));
    }
    if (!solved.law.assumptions.empty()) lines.push_back(fmt::format("assumes: {}", fmt::join(solved.law.assumptions, "; ")));
    if (!solved.law.sources.empty()) lines.push_back(fmt::format("sources: {}", fmt::join(solved.law.sources, ", ")));
    return lines;
}

bool has_values(const SolvedLaw& solved) {
    const auto& quantities = solved.problem.quantities;
    return std::any_of(quantities.begin(), quantities.end(), [](const PiQuantity& q) { return q.value.has_value(); });
}

NamedValues list_values(const SolvedLaw& solved, std::size_t j) {
    const PiQuantity& quantity = solved.problem.quantities[j];
    const scaling::QuantityScale& scale = solved.solution.quantities[j];
    json exponents = json::object();
    for (std::size_t k = 0; k < scale.factor.exponents.size(); ++k) {
        const scaling::Rational& exponent = scale.factor.exponents[k];
        if (exponent != 0) exponents[solved.problem.quantities[k].name] = to_string(exponent);
    }
    NamedValues values{{"name", "quantity", quantity.name},
                       {"factor", "factor", or_null(scale.factor.value), kFactorFormat},
                       {"formula", "formula", formula(solved, scale.factor)},
                       {"latex", {}, formula(solved, scale.factor, PiNotation::latex)},
                       in_words("state", "state", to_string(scale.state), describe_state(solved, j)),
                       {"default", {}, bool(solved.is_default[j])},
                       {"meaning", "meaning", solved.law.quantities[j].meaning},
                       {"unit", {}, solved.law.quantities[j].unit},
                       {"exponents", {}, exponents},
                       {"needs", {}, names_of(solved, scale.factor.needs)}};
    if (!has_values(solved)) return values;
    const auto add = [&](const std::string& name, const std::optional<double>& value) {
        values.push_back({value ? name : "", name, value ? scaling::format_value(*value, quantity) : ""});
        if (value) values.push_back({name + "_si", {}, *value});
    };
    add("prototype", quantity.value);
    add("model", find_model_value(solved, j));
    return values;
}

NamedValues list_values(const SolvedLaw& solved, const LawGroup& group) {
    return {{"product", "group", group.product.text},
            {"delta", "delta", or_null(group.delta.value), kFactorFormat},
            {"formula", "formula", formula(solved, group.delta)},
            {"latex", {}, formula(solved, group.delta, PiNotation::latex)},
            {{}, "", group.is_held ? "held" : "watched"},
            {"name", "known as", group.name(solved)}};
}

json addition_json(const SolvedLaw& solved, const scaling::LawAddition& addition) {
    json object{{"name", addition.name},
                {"meaning", addition.meaning},
                {"factor", or_null(solved.added(addition))},
                {"formula", addition_formula(solved, addition)}};
    if (const auto value = find_added_value(solved, addition)) {
        const auto& quantities = solved.problem.quantities;
        object["model"] = scaling::format_value(*value, quantities[scaling::find_quantity(quantities, addition.own)]);
        object["model_si"] = *value;
    }
    return object;
}

std::string make_latex_report(const SolvedLaw& solved) {
    std::string text = fmt::format("% law {}: {}\n", solved.law.name, solved.law.title);
    const auto add_lines = [&](const std::vector<std::string>& lines) {
        if (!lines.empty()) text += fmt::format("\\begin{{align}}\n  {}\n\\end{{align}}\n", fmt::join(lines, " \\\\\n  "));
    };
    const auto equation = [&](const std::string& left, const ScaleFactor& factor) {
        const std::string right = formula(solved, factor, PiNotation::latex);
        if (!factor.value) return fmt::format("{} &= {}", left, right);
        const std::string value = or_dash(factor.value, kFactorDigits);
        return left == right || right == "1" ? fmt::format("{} &= {}", left, value) : fmt::format("{} &= {} = {}", left, right, value);
    };
    std::vector<std::string> factors;
    for (std::size_t j = 0; j < solved.problem.quantities.size(); ++j) {
        factors.push_back(equation(scaling::latex_factor_name(solved.problem.quantities[j].name), solved.solution.quantities[j].factor));
    }
    add_lines(factors);
    std::vector<std::string> groups;
    for (const LawGroup& group : list_groups(solved)) {
        const std::string product = scaling::format_group(group.product.exponents, solved.problem.quantities, PiNotation::latex);
        groups.push_back(equation(fmt::format("\\delta\\!\\left[{}\\right]", product), group.delta));
    }
    add_lines(groups);
    for (const std::string& line : list_remarks(solved)) text += fmt::format("% {}\n", line);
    return text;
}

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

json make_json(const UncertainDifference& difference) {
    json object{{"value", difference.value}, {"standard_uncertainty", difference.uncertainty}};
    if (difference.samples) object["monte_carlo"] = to_json(*difference.samples, 1.0);
    return object;
}

}  // namespace

json to_json(const SolvedLaw& solved) {
    json object{{"law", json::parse(scaling::write_scale_law(solved.law))},
                {"chosen", json::object()},
                {"factors", json::object()},
                {"quantities", json::array()},
                {"free", {{"count", solved.solution.free_count}, {"among", names_of(solved, solved.solution.open)}}},
                {"groups", json::object()},
                {"held", json::array()},
                {"watched", json::array()},
                {"distortions", json::array()},
                {"additions", json::array()},
                {"overruled", names_of(solved, solved.overruled)}};
    for (std::size_t j = 0; j < solved.problem.quantities.size(); ++j) {
        const std::string& name = solved.problem.quantities[j].name;
        if (solved.problem.chosen[j]) object["chosen"][name] = *solved.problem.chosen[j];
        object["factors"][name] = or_null(solved.solution.quantities[j].factor.value);
        object["quantities"].push_back(to_json(list_values(solved, j)));
    }
    for (const LawGroup& group : list_groups(solved)) {
        object["groups"][group.product.text] = or_null(group.delta.value);
        object[group.is_held ? "held" : "watched"].push_back(to_json(list_values(solved, group)));
        if (group.delta.value && std::abs(*group.delta.value - 1.0) > scaling::kFactorRounding) {
            object["distortions"].push_back(
                {{"group", group.product.text}, {"factor", *group.delta.value}, {"formula", formula(solved, group.delta)}});
        }
    }
    for (const scaling::LawAddition& addition : solved.law.additions) object["additions"].push_back(addition_json(solved, addition));
    return object;
}

std::string make_law_report(const SolvedLaw& solved, ReportStyle style) {
    if (style == ReportStyle::latex) return make_latex_report(solved);
    const bool is_markdown = style == ReportStyle::markdown;
    std::string text = is_markdown ? fmt::format("Law `{}`: {}. Factors are model/prototype.\n\n", solved.law.name, solved.law.title)
                                   : fmt::format("Law {}: {} (factors are model/prototype)\n\n", solved.law.name, solved.law.title);
    if (is_markdown && !solved.law.description.empty()) text += solved.law.description + "\n\n";
    std::vector<NamedValues> quantities, groups;
    quantities.reserve(solved.problem.quantities.size());
    for (std::size_t j = 0; j < solved.problem.quantities.size(); ++j) quantities.push_back(list_values(solved, j));
    for (const LawGroup& group : list_groups(solved)) groups.push_back(list_values(solved, group));
    text += make_table(to_table(quantities), style) + "\n";
    if (!groups.empty()) text += make_table(to_table(groups), style) + "\n";
    return text + make_lines(list_remarks(solved), style);
}

std::string make_uncertainty_report(const SolvedLaw& solved, const UncertainLawReport& report, ReportStyle style) {
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

json to_json(const SolvedLaw& solved, const UncertainLawReport& report) {
    json values = json::object(), additions = json::object();
    for (const scaling::UncertainPair& pair : report.values) {
        values[pair.name] = {{"prototype", to_json(pair.prototype, 1.0)}, {"model", to_json(pair.model, 1.0)}};
    }
    for (std::size_t i = 0; i < report.additions.size(); ++i) {
        const auto& addition = report.additions[i];
        if (!addition) continue;
        json entry{{"factor", make_json(addition->factor)}};
        if (addition->model) entry["model"] = make_json(*addition->model);
        additions[solved.law.additions[i].name] = entry;
    }
    json object{{"inputs", to_json(report.inputs)},
                {"factors", to_json(drop_open(report.factors), report.inputs)},
                {"groups", to_json(list_settled_groups(solved, report), report.inputs)},
                {"groups_as_shaken", to_json(report.shaken, report.inputs)},
                {"values", values},
                {"additions", additions}};
    if (report.draws) object["monte_carlo"] = to_json(*report.draws);
    return object;
}

}  // namespace musim::cli
