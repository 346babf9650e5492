#include "cli/scaling/scale_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "cli/named_values.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/scaling/law_output.hpp"
#include "scaling/laws/scale_law_catalogue.hpp"
#include "scaling/text_table.hpp"

namespace musim::cli {
namespace {

using scaling::LawQuantity;
using scaling::ScaleLaw;

/// A law without products, whose quantities are those of mechanics; the names that nobody uses go later.
ScaleLaw make_free_law() {
    ScaleLaw law;
    law.name = "free";
    law.title = "products held on the command line";
    law.quantities = scaling::find_scale_law("mechanics")->quantities;
    return law;
}

/// Adds a quantity of the command line, in place of one of the same name; in front of the others where the law is free, to be free first.
void add_quantity(ScaleLaw& law, LawQuantity quantity, std::size_t position) {
    std::erase_if(law.quantities, [&](const LawQuantity& other) { return other.quantity.name == quantity.quantity.name; });
    position = std::min(position, law.quantities.size());
    law.quantities.insert(law.quantities.begin() + static_cast<std::ptrdiff_t>(position), std::move(quantity));
}

/// A product of the command line, with the option in front of the message.
scaling::ScaleProduct parse_product(const char* option, const std::string& text, const ScaleLaw& law) {
    try {
        return scaling::parse_scale_product(text, scaling::quantities_of(law));
    } catch (const scaling::SimilitudeError& error) {
        throw scaling::PiError(fmt::format("{}: {} (others come by --define NAME:UNIT)", option, error.what()));
    }
}

/// Watches a product; when the law holds it, it does no longer.
void watch(ScaleLaw& law, const std::string& text) {
    const auto exponents = parse_product("--watch", text, law).exponents;
    const std::vector<scaling::PiQuantity> quantities = scaling::quantities_of(law);
    std::erase_if(law.held, [&](const std::string& held) { return scaling::parse_scale_product(held, quantities).exponents == exponents; });
    law.watched.push_back(text);
}

/// Leaves the quantities that occur in products, factors or values.
void remove_unused(ScaleLaw& law, const std::vector<std::string>& named) {
    const std::vector<scaling::PiQuantity> all = scaling::quantities_of(law);
    std::vector<bool> is_used(all.size());
    for (const auto* products : {&law.held, &law.watched}) {
        for (const std::string& text : *products) {
            const auto exponents = scaling::parse_scale_product(text, all).exponents;
            for (std::size_t j = 0; j < all.size(); ++j) is_used[j] = is_used[j] || exponents[j] != 0;
        }
    }
    for (const std::string& name : named) is_used[scaling::find_quantity(all, name)] = true;
    std::vector<LawQuantity> used;
    for (std::size_t j = 0; j < all.size(); ++j) {
        if (is_used[j]) used.push_back(std::move(law.quantities[j]));
    }
    law.quantities = std::move(used);
}

}  // namespace

void ScaleLawOptions::add_to(CLI::App& command) {
    const auto add = [&](const char* name, std::vector<std::string>& texts, const char* help, const char* type) {
        command.add_option(name, texts, help)->type_name(type)->expected(1)->take_all();
    };
    add("--hold", held, "A product that model and prototype share, on top of the law's or without a law", "PRODUCT");
    add("--watch", watched, "A product whose distortion is wanted; one that the law holds is held no longer", "PRODUCT");
    add("--define", quantities, "A quantity that neither the law nor mechanics knows, e.g. E:GPa", "NAME:UNIT");
    add("--value", values, "What a quantity is in the prototype, e.g. \"E=29.2 GPa\"; the model's is given", "NAME=QUANTITY");
    add_format_option(command, style, "Form of the answer");
    command.add_flag("--laws", lists_laws, "List the laws that come with musim");
}

bool ScaleLawOptions::name_products() const { return !(held.empty() && watched.empty() && quantities.empty() && values.empty()); }

SolvedWithValues ScaleLawOptions::solve(const std::string& name, const std::vector<scaling::GivenFactor>& given) const {
    const bool is_free = name.empty();
    ScaleLaw law = is_free ? make_free_law() : scaling::load_scale_law(name);
    for (std::size_t i = 0; i < quantities.size(); ++i) {
        const auto [symbol, unit] = split_option("--define", quantities[i], ':', "NAME:UNIT, e.g. E:GPa");
        const auto make = [&name = symbol, &of = unit] { return scaling::make_pi_quantity(name, of); };
        LawQuantity quantity{.quantity = read_option("--define " + symbol, make), .unit = unit, .meaning = {}};
        add_quantity(law, std::move(quantity), is_free ? i : law.quantities.size());
    }
    for (const std::string& text : watched) watch(law, text);
    for (const std::string& text : held) {
        parse_product("--hold", text, law);
        law.held.push_back(text);
    }

    std::vector<scaling::UncertainPrototype> prototype;
    std::vector<std::string> named;
    for (const auto& [symbol, factor] : given) named.push_back(symbol);
    for (const std::string& text : values) {
        const auto [symbol, value] = split_option("--value", text, '=', "NAME=QUANTITY, e.g. \"E=29.2 GPa\"");
        const std::string place = "--value " + symbol;
        const std::vector<scaling::PiQuantity> known = scaling::quantities_of(law);
        const std::size_t position =
            read_option(place, [&known, &name = symbol] { return scaling::find_quantity(known, name, "the law"); });
        scaling::PiQuantity& quantity = law.quantities[position].quantity;
        const scaling::Uncertain uncertain =
            read_option(place, [&quantity, &text = value] { return scaling::parse_uncertain_value(text, quantity); });
        if (quantity.value) throw CLI::ValidationError("--value", symbol + " is given twice; give it once");
        quantity.value = uncertain.value;
        prototype.push_back({symbol, uncertain});
        named.push_back(symbol);
    }
    if (is_free) remove_unused(law, named);
    scaling::check_law(law);
    return {scaling::solve_law(law, given), prototype};
}

int list_scale_laws(scaling::ReportStyle style, bool json) {
    std::vector<NamedValues> rows;
    for (const std::string& name : scaling::scale_law_names()) {
        const ScaleLaw law = *scaling::find_scale_law(name);
        std::vector<std::string> needs;
        for (const scaling::LawChoice& choice : law.choices) {
            if (!choice.fallback) needs.push_back(choice.name);
        }
        rows.push_back({{"name", "law", name},
                        {"title", "", law.title},
                        {"description", {}, law.description},
                        in_words("needs", "needs", needs, fmt::format("{}", fmt::join(needs, ", ")))});
    }
    if (json) {
        print_json({{"laws", to_json(rows)}});
    } else {
        print("{}", make_table(to_table(rows), style));
    }
    return kDone;
}

int run_scale_law(const ScaleLawOptions& options, const std::string& law, const std::vector<scaling::UncertainFactor>& given,
                  const std::optional<scaling::MonteCarloSettings>& monte_carlo, bool json) {
    const auto [solved, prototype] = options.solve(law, scaling::values_of(given));
    const scaling::UncertainLawReport uncertain = propagate(solved, given, prototype, monte_carlo);
    const bool is_certain = uncertain.inputs.empty();
    if (json) {
        nlohmann::json object = to_json(solved);
        if (!is_certain) object["uncertainty"] = to_json(solved, uncertain);
        print_json(object);
        return kDone;
    }
    print("{}", make_law_report(solved, options.style));
    if (!is_certain) print("{}", make_uncertainty_report(solved, uncertain, options.style));
    return kDone;
}

}  // namespace musim::cli
