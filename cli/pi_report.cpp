#include "cli/pi_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/output.hpp"
#include "scaling/named_groups.hpp"
#include "scaling/pi_remarks.hpp"
#include "scaling/pi_text.hpp"

namespace musim::cli {
namespace {

using nlohmann::json;
using scaling::PiBasis;
using scaling::PiGroup;
using scaling::PiNotation;
using scaling::PiQuantity;

std::vector<std::string> names_of(const std::vector<PiQuantity>& quantities, const std::vector<std::size_t>& positions) {
    std::vector<std::string> names;
    names.reserve(positions.size());
    for (const std::size_t position : positions) names.push_back(quantities[position].name);
    return names;
}

std::string group_name(const PiGroup& group, const std::vector<PiQuantity>& quantities) {
    return scaling::recognised_text(scaling::recognise(group, quantities));
}

/// What cannot take part and what else there is to say, one line each.
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

json group_json(const PiGroup& group, std::size_t number, const std::vector<PiQuantity>& quantities) {
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
    return object;
}

json basis_json(const PiBasis& basis, const std::vector<PiQuantity>& quantities) {
    json groups = json::array();
    for (const PiGroup& group : basis.groups) groups.push_back(group_json(group, groups.size() + 1, quantities));
    return {{"repeating", names_of(quantities, basis.repeating)}, {"groups", groups}};
}

void print_groups(const PiBasis& basis, const std::vector<PiQuantity>& quantities) {
    std::size_t widest = 0;
    for (const PiGroup& group : basis.groups) widest = std::max(widest, scaling::format_group(group, quantities).size());
    for (std::size_t k = 0; k < basis.groups.size(); ++k) {
        const auto value = scaling::group_value(basis.groups[k], quantities);
        const std::string number = value ? fmt::format("= {:.7g}", *value) : "";
        const std::string line = fmt::format("  Pi_{:<3} {:<{}}  {:<16} {}", k + 1, scaling::format_group(basis.groups[k], quantities),
                                             widest, number, group_name(basis.groups[k], quantities));
        print("{}\n", line.substr(0, line.find_last_not_of(' ') + 1));
    }
}

std::string join(const std::vector<std::string>& names) { return fmt::format("{}", fmt::join(names, ", ")); }

}  // namespace

json to_json(const PiReport& report) {
    json object = basis_json(report.basis, report.quantities);
    object["rank"] = report.basis.rank();
    object["unused"] = json::array();
    for (const auto& unused : scaling::explain_unused(report.quantities, report.basis)) {
        object["unused"].push_back({{"name", report.quantities[unused.quantity].name}, {"why", unused.why}});
    }
    object["remarks"] = scaling::find_remarks(report.quantities, report.basis);
    if (report.all) {
        object["bases"] = json::array();
        for (const PiBasis& basis : report.all->bases) object["bases"].push_back(basis_json(basis, report.quantities));
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

void print_text(const PiReport& report) {
    const auto& quantities = report.quantities;
    print("{} quantities, rank {}, {} groups; repeating {}\n", quantities.size(), report.basis.rank(), report.basis.groups.size(),
          join(names_of(quantities, report.basis.repeating)));
    print_groups(report.basis, quantities);
    for (const ExpressedProduct& product : report.expressed) {
        const std::string name = scaling::recognised_text(scaling::recognise(product.exponents, quantities));
        print("{} = {}{}{}\n", product.text, powers_text(product.powers, PiNotation::text), name.empty() ? "" : "   ", name);
    }
    if (report.all) {
        for (const PiBasis& basis : report.all->bases) {
            print("repeating {}\n", join(names_of(quantities, basis.repeating)));
            print_groups(basis, quantities);
        }
    }
    for (const std::string& line : list_remarks(report)) print("{}\n", line);
}

void print_markdown(const PiReport& report) {
    const auto& quantities = report.quantities;
    const auto print_table = [&](const PiBasis& basis) {
        print("Repeating: {}.\n\n| group | product | value | known as |\n|---|---|---|---|\n", join(names_of(quantities, basis.repeating)));
        for (std::size_t k = 0; k < basis.groups.size(); ++k) {
            const auto value = scaling::group_value(basis.groups[k], quantities);
            print("| $\\Pi_{{{}}}$ | ${}$ | {} | {} |\n", k + 1, scaling::format_group(basis.groups[k], quantities, PiNotation::latex),
                  value ? fmt::format("{:.7g}", *value) : "", group_name(basis.groups[k], quantities));
        }
        print("\n");
    };
    print_table(report.basis);
    if (report.all) std::for_each(report.all->bases.begin(), report.all->bases.end(), print_table);
    for (const ExpressedProduct& product : report.expressed) {
        print("- ${} = {}$\n", scaling::format_group(product.exponents, quantities, PiNotation::latex),
              powers_text(product.powers, PiNotation::latex));
    }
    for (const std::string& line : list_remarks(report)) print("- {}\n", line);
}

void print_latex(const PiReport& report) {
    const auto& quantities = report.quantities;
    const auto print_lines = [&](const PiBasis& basis) {
        print("% repeating {}\n\\begin{{align}}\n", join(names_of(quantities, basis.repeating)));
        for (std::size_t k = 0; k < basis.groups.size(); ++k) {
            const std::string name = group_name(basis.groups[k], quantities);
            print("  \\Pi_{{{}}} &= {}{}{}{}\n", k + 1, scaling::format_group(basis.groups[k], quantities, PiNotation::latex),
                  k + 1 < basis.groups.size() ? " \\\\" : "", name.empty() ? "" : "  % ", name);
        }
        print("\\end{{align}}\n");
    };
    print_lines(report.basis);
    if (report.all) std::for_each(report.all->bases.begin(), report.all->bases.end(), print_lines);
    for (const ExpressedProduct& product : report.expressed) {
        print("\\[ {} = {} \\]\n", scaling::format_group(product.exponents, quantities, PiNotation::latex),
              powers_text(product.powers, PiNotation::latex));
    }
    for (const std::string& line : list_remarks(report)) print("% {}\n", line);
}

}  // namespace musim::cli
