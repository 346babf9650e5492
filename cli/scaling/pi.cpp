#include <fmt/format.h>

#include <algorithm>
#include <CLI/CLI.hpp>
#include <cstddef>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/files.hpp"
#include "cli/interruption.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/progress_line.hpp"
#include "cli/scaling/uncertainty_output.hpp"
#include "cli/uncertain_options.hpp"
#include "cli/whole_option.hpp"
#include "scaling/laws/named_groups.hpp"
#include "scaling/pi/pi_express.hpp"
#include "scaling/pi/pi_problem.hpp"
#include "scaling/pi/pi_remarks.hpp"
#include "scaling/pi/pi_text.hpp"
#include "scaling/uncertainty/uncertain_groups.hpp"

namespace musim::cli {
namespace {

using nlohmann::json;
using scaling::PiBasis;
using scaling::PiGroup;
using scaling::PiNotation;
using scaling::PiQuantity;
using scaling::ReportStyle;

struct PiOptions {
    std::string problem;
    std::vector<std::string> repeating;
    bool all = false;
    std::size_t limit = 100;
    std::vector<std::string> products;
    MonteCarloOptions monte_carlo;
    scaling::ReportStyle style = scaling::ReportStyle::plain;
    bool json = false;
};

/// A product that the user gave, over the groups.
struct ExpressedProduct {
    std::string text;
    std::vector<scaling::Rational> exponents;  ///< one per quantity
    std::vector<scaling::Rational> powers;     ///< one per group
};

/// Report of `musim pi`.
struct PiReport {
    nlohmann::json problem;  ///< as the file has it
    std::vector<scaling::PiQuantity> quantities;
    scaling::PiBasis basis;
    std::optional<scaling::PiBases> all;
    std::vector<ExpressedProduct> expressed;
    scaling::SampledGroups samples = {};
};

/// The basis of the report, then all others if they are wanted.
std::vector<PiBasis> list_bases(const PiReport& report) {
    std::vector<PiBasis> bases{report.basis};
    if (report.all) bases.insert(bases.end(), report.all->bases.begin(), report.all->bases.end());
    return bases;
}

std::vector<std::string> names_of(const std::vector<PiQuantity>& quantities, const std::vector<std::size_t>& positions) {
    std::vector<std::string> names;
    names.reserve(positions.size());
    for (const std::size_t position : positions) names.push_back(quantities[position].name);
    return names;
}

std::string group_name(const PiGroup& group, const std::vector<PiQuantity>& quantities) {
    return scaling::recognised_text(scaling::recognise(group, quantities));
}

/// Remarks on quantities that cannot take part and others, one line each.
std::vector<std::string> list_remarks(const PiReport& report) {
    std::vector<std::string> lines;
    for (const auto& unused : scaling::explain_unused(report.quantities, report.basis)) lines.push_back(unused.why);
    for (const std::string& remark : scaling::find_remarks(report.quantities, report.basis)) lines.push_back(remark);
    if (report.all && !report.all->complete) {
        lines.push_back(
            fmt::format("there are more choices than these {}; raise --limit, or name some with --repeating", report.all->bases.size()));
    }
    return lines;
}

/// "Pi_1^(1/2)*Pi_2", as a product of the groups.
std::string powers_text(const std::vector<scaling::Rational>& powers, PiNotation notation) {
    std::vector<PiQuantity> groups;
    for (std::size_t k = 0; k < powers.size(); ++k) groups.push_back({.name = fmt::format("Pi_{}", k + 1), .dimension = {}, .value = {}});
    return scaling::format_group(powers, groups, notation);
}

bool is_uncertain(const PiReport& report) { return !list_uncertain(report.quantities).empty(); }

/// Samples of a group; null without any.
const scaling::SampleSummary* find_samples(const PiReport& report, const PiGroup& group) {
    const auto found = report.samples.groups.find(group);
    return found == report.samples.groups.end() ? nullptr : &found->second;
}

/// Value, u, u/value and coverage interval of a group; empty where it has no value.
std::vector<std::string> describe_value(const PiReport& report, const PiGroup& group) {
    const auto value = find_uncertain_value(group, report.quantities);
    if (!value) return {"", "", "", ""};
    return {fmt::format("{:.7g}", value->value), value->relative == 0.0 ? "-" : format_uncertainty(value->uncertainty(), value->value, {}),
            format_share(value->relative), describe_interval(*value, find_samples(report, group))};
}

json group_json(const PiGroup& group, std::size_t number, const PiReport& report) {
    const std::vector<PiQuantity>& quantities = report.quantities;
    json exponents = json::object();
    for (std::size_t i = 0; i < quantities.size(); ++i) {
        if (group[i] != 0) exponents[quantities[i].name] = group[i];
    }
    const auto names = scaling::recognise(group, quantities);
    json object = {{"exponents", exponents},
                   {"name", names.empty() ? fmt::format("Pi_{}", number) : scaling::recognised_text(names)},
                   {"product", scaling::format_group(group, quantities)},
                   {"latex", scaling::format_group(group, quantities, PiNotation::latex)},
                   {"known", json::array()}};
    for (const auto& name : names) object["known"].push_back({{"name", name.name}, {"formula", name.formula}, {"as", name.as}});
    if (const auto value = scaling::group_value(group, quantities)) object["value"] = *value;
    if (const auto value = find_uncertain_value(group, quantities); value && is_uncertain(report)) {
        object["uncertainty"] = to_json(*value, list_uncertain(quantities), find_samples(report, group));
    }
    return object;
}

json basis_json(const PiBasis& basis, const PiReport& report) {
    json groups = json::array();
    for (const PiGroup& group : basis.groups) groups.push_back(group_json(group, groups.size() + 1, report));
    return {{"repeating", names_of(report.quantities, basis.repeating)}, {"groups", groups}};
}

/// "= 0.866", or "= 0.866, u 0.043 (5 %), 95 %: 0.785 to 0.955" where quantities are uncertain; empty without a value.
std::string equate_value(const PiReport& report, const PiGroup& group) {
    const std::vector<std::string> cells = describe_value(report, group);
    if (cells[0].empty()) return "";
    return cells[1] == "-" ? "= " + cells[0]
                           : fmt::format("= {}, u {} ({}), {}: {}", cells[0], cells[1], cells[2], coverage_title(), cells[3]);
}

std::string make_group_lines(const PiBasis& basis, const PiReport& report) {
    const std::vector<PiQuantity>& quantities = report.quantities;
    std::size_t widest = 0, widest_value = 16;
    for (const PiGroup& group : basis.groups) {
        widest = std::max(widest, scaling::format_group(group, quantities).size());
        widest_value = std::max(widest_value, equate_value(report, group).size());
    }
    std::string text;
    for (std::size_t k = 0; k < basis.groups.size(); ++k) {
        const std::string line =
            fmt::format("  Pi_{:<3} {:<{}}  {:<{}} {}", k + 1, scaling::format_group(basis.groups[k], quantities), widest,
                        equate_value(report, basis.groups[k]), widest_value, group_name(basis.groups[k], quantities));
        text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
    return text;
}

std::string join(const std::vector<std::string>& names) { return fmt::format("{}", fmt::join(names, ", ")); }

/// The uncertain quantities, and how samples of them were drawn.
std::string make_inputs(const PiReport& report, ReportStyle style) {
    if (!is_uncertain(report)) return "";
    std::string text =
        make_heading("Uncertain quantities, u standard", style) + make_table(make_inputs_table(list_uncertain(report.quantities)), style);
    if (report.samples.draws) text += "\n" + make_lines({describe_draws(*report.samples.draws)}, style);
    return text;
}

/// "\Pi_{1}".
std::string latex_number(std::size_t k) { return fmt::format("\\Pi_{{{}}}", k + 1); }

/// A product of the user's and the powers of the groups that it is, in LaTeX.
std::string equate(const ExpressedProduct& product, const std::vector<PiQuantity>& quantities) {
    return fmt::format("{} = {}", scaling::format_group(product.exponents, quantities, PiNotation::latex),
                       powers_text(product.powers, PiNotation::latex));
}

std::string make_text(const PiReport& report) {
    const auto& quantities = report.quantities;
    std::string text = fmt::format("{} quantities, rank {}, {} groups; repeating {}\n", quantities.size(), report.basis.rank(),
                                   report.basis.groups.size(), join(names_of(quantities, report.basis.repeating)));
    text += make_group_lines(report.basis, report);
    for (const ExpressedProduct& product : report.expressed) {
        const std::string name = scaling::recognised_text(scaling::recognise(product.exponents, quantities));
        text += fmt::format("{} = {}{}{}\n", product.text, powers_text(product.powers, PiNotation::text), name.empty() ? "" : "   ", name);
    }
    if (report.all) {
        for (const PiBasis& basis : report.all->bases) {
            text += fmt::format("repeating {}\n", join(names_of(quantities, basis.repeating))) + make_group_lines(basis, report);
        }
    }
    return text + make_lines(list_remarks(report), ReportStyle::plain) + make_inputs(report, ReportStyle::plain);
}

std::string make_markdown(const PiReport& report) {
    const auto& quantities = report.quantities;
    std::string text;
    for (const PiBasis& basis : list_bases(report)) {
        scaling::TextTable table{{"group", "product", "value"}};
        if (is_uncertain(report)) table.header.insert(table.header.end(), {"u", "u/value", coverage_title()});
        table.header.emplace_back("known as");
        for (std::size_t k = 0; k < basis.groups.size(); ++k) {
            std::vector<std::string> row{fmt::format("${}$", latex_number(k)),
                                         fmt::format("${}$", scaling::format_group(basis.groups[k], quantities, PiNotation::latex))};
            const std::vector<std::string> cells = describe_value(report, basis.groups[k]);
            row.insert(row.end(), cells.begin(), is_uncertain(report) ? cells.end() : std::next(cells.begin()));
            row.push_back(group_name(basis.groups[k], quantities));
            table.rows.push_back(row);
        }
        text += fmt::format("Repeating: {}.\n\n{}\n", join(names_of(quantities, basis.repeating)), to_markdown(table));
    }
    std::vector<std::string> lines;
    for (const ExpressedProduct& product : report.expressed) lines.push_back(fmt::format("${}$", equate(product, quantities)));
    const std::vector<std::string> remarks = list_remarks(report);
    lines.insert(lines.end(), remarks.begin(), remarks.end());
    return text + make_lines(lines, ReportStyle::markdown) + make_inputs(report, ReportStyle::markdown);
}

/// A number in LaTeX's mathematics: "1.924e-04" is 1.924 \times 10^{-4}.
std::string latex_value(const std::string& number) {
    const std::size_t mark = number.find('e');
    if (mark == std::string::npos) return number;
    return fmt::format("{} \\times 10^{{{}}}", number.substr(0, mark), std::stoi(number.substr(mark + 1)));
}

/// " = 0.866 \pm 0.043" behind a group whose value is uncertain, else nothing.
std::string equate_latex(const PiReport& report, const PiGroup& group) {
    const std::vector<std::string> cells = describe_value(report, group);
    return cells[0].empty() || cells[1] == "-" ? "" : fmt::format(" = {} \\pm {}", latex_value(cells[0]), latex_value(cells[1]));
}

std::string make_latex(const PiReport& report) {
    const auto& quantities = report.quantities;
    std::string text;
    for (const PiBasis& basis : list_bases(report)) {
        text += fmt::format("% repeating {}\n\\begin{{align}}\n", join(names_of(quantities, basis.repeating)));
        for (std::size_t k = 0; k < basis.groups.size(); ++k) {
            const std::string name = group_name(basis.groups[k], quantities);
            text += fmt::format(
                "  {} &= {}{}{}{}{}\n", latex_number(k), scaling::format_group(basis.groups[k], quantities, PiNotation::latex),
                equate_latex(report, basis.groups[k]), k + 1 < basis.groups.size() ? " \\\\" : "", name.empty() ? "" : "  % ", name);
        }
        text += "\\end{align}\n";
    }
    for (const ExpressedProduct& product : report.expressed) text += fmt::format("\\[ {} \\]\n", equate(product, quantities));
    for (const std::string& line : list_remarks(report)) text += fmt::format("% {}\n", line);
    return text + make_inputs(report, ReportStyle::latex);
}

/// One JSON object: "problem" (which parse_pi_problem() reads back from it), "rank", "groups", "unused", and "repeating", "remarks",
/// "bases", "complete", "expressed". A group has "exponents" (of the quantities it holds), "name" (as recognised, else "Pi_1", ...),
/// "product", "latex", "known" (the names one by one) and, where its quantities have values, "value", and "uncertainty" of it where some
/// are uncertain, with "monte_carlo" if samples were drawn; "uncertainty" of the whole has the inputs. Powers of an expressed product are
/// texts such as "-1/2".
json report_json(const PiReport& report) {
    json object = basis_json(report.basis, report);
    object["problem"] = report.problem;
    if (is_uncertain(report)) {
        object["uncertainty"] = {{"inputs", to_json(list_uncertain(report.quantities))}, {"coverage", scaling::kCoverage}};
        if (report.samples.draws) object["uncertainty"]["monte_carlo"] = to_json(*report.samples.draws);
    }
    object["rank"] = report.basis.rank();
    object["unused"] = json::array();
    for (const auto& unused : scaling::explain_unused(report.quantities, report.basis)) {
        object["unused"].push_back({{"name", report.quantities[unused.quantity].name}, {"why", unused.why}});
    }
    object["remarks"] = scaling::find_remarks(report.quantities, report.basis);
    if (report.all) {
        object["bases"] = json::array();
        for (const PiBasis& basis : report.all->bases) object["bases"].push_back(basis_json(basis, report));
        object["complete"] = report.all->complete;
    }
    if (!report.expressed.empty()) object["expressed"] = json::array();
    for (const ExpressedProduct& product : report.expressed) {
        json powers = json::array();
        for (const scaling::Rational& power : product.powers) powers.push_back(to_string(power));
        object["expressed"].push_back({{"product", product.text},
                                       {"powers", powers},
                                       {"name", scaling::recognised_text(scaling::recognise(product.exponents, report.quantities))}});
    }
    return object;
}

/// Groups with names and values, and remarks, uncertainties where there are some: lines of text, tables in Markdown, an align environment
/// of amsmath in LaTeX with one group a line and remarks as comments.
std::string make_pi_report(const PiReport& report, ReportStyle style) {
    switch (style) {
        case ReportStyle::markdown:
            return make_markdown(report);
        case ReportStyle::latex:
            return make_latex(report);
        case ReportStyle::plain:
            break;
    }
    return make_text(report);
}

int run_pi(const PiOptions& options) {
    PiReport report;
    const std::string problem = read_input_file(options.problem, R"(a file with {"quantities": [...]})");
    report.quantities = scaling::parse_pi_problem(problem, options.problem);
    const nlohmann::json document = nlohmann::json::parse(problem);
    report.problem = document.value("problem", document);
    report.basis = scaling::find_pi_basis(report.quantities, options.repeating);
    if (options.all) report.all = scaling::find_all_pi_bases(report.quantities, options.limit);
    for (const std::string& text : options.products) {
        const auto exponents = scaling::parse_group(text, report.quantities);
        report.expressed.push_back({text, exponents, scaling::express(exponents, report.basis.groups, report.quantities)});
    }
    if (const auto monte_carlo = options.monte_carlo.make()) {
        std::vector<scaling::PiGroup> groups;
        for (const scaling::PiBasis& basis : list_bases(report)) groups.insert(groups.end(), basis.groups.begin(), basis.groups.end());
        ProgressLine progress("samples");
        report.samples = draw_groups(groups, report.quantities, *monte_carlo, [&](double fraction) { progress.update(fraction); });
    }
    if (options.json) {
        print_json(report_json(report));
    } else {
        print("{}", make_pi_report(report, options.style));
    }
    return kDone;
}

}  // namespace

void add_pi_command(CLI::App& app, Action& action) {
    auto options = std::make_shared<PiOptions>();
    CLI::App* command =
        app.add_subcommand("pi", "Dimensionless groups of a problem (Pi theorem), exact, with names and with what cannot take part");
    command->add_option("problem", options->problem, R"(JSON file, {"quantities": [{"name": "v", "unit": "m/s", "value": 0.424}, ...]})")
        ->required()
        ->type_name("PROBLEM.json");
    command->add_option("--repeating", options->repeating, "Repeating quantities; without it the first independent ones of the file")
        ->delimiter(',')
        ->type_name("NAMES");
    command->add_flag("--all", options->all, "The groups of every choice of repeating quantities");
    add_whole_option(*command, "--limit", options->limit, "Largest number of choices that --all lists", {1})->capture_default_str();
    command->add_option("--express", options->products, "A group of yours as a product of these; repeat for several")
        ->type_name("PRODUCT")
        ->expected(1)
        ->take_all();
    options->monte_carlo.add_to(*command);
    add_format_option(*command, options->style, "Form of the answer");
    add_json_option(*command, options->json);
    command->get_option("--json")->excludes("--format");
    command->footer(
        "Units as everywhere (\"MN/m\", \"MPa m^0.5\", \"W/(m K)\"); \"1\" for a plain number; \"g\" is gram, \"gn\" gravity.\n"
        "A value may carry its standard uncertainty, \"value\": \"42.4 +/- 0.4\" or \"0.59 +/- 5%\": groups then have u and 95 % "
        "intervals, to\n"
        "first order or of the samples.\n"
        "What --json prints holds the problem and is a PROBLEM.json itself.\n"
        "Examples:\n"
        "  musim pi examples/pi/tower.json\n"
        "  musim pi examples/pi/tower.json --repeating rho,l,g --express \"v/sqrt(mu*g*l)\"\n"
        "  musim pi examples/pi/uncertain.json --monte-carlo --seed 7\n"
        "  musim pi examples/pi/sphere_drag.json --all --format markdown");
    command->callback([&action, options] { action = [options] { return run_whole([&] { return run_pi(*options); }); }; });
}

}  // namespace musim::cli
