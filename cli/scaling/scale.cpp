#include <fmt/format.h>

#include <algorithm>
#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "cli/interruption.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/report.hpp"
#include "cli/scaling/scale_law.hpp"
#include "cli/scaling/scale_properties.hpp"
#include "cli/scaling/uncertainty_output.hpp"
#include "cli/uncertain_options.hpp"
#include "scaling/laws/model_scales.hpp"
#include "scaling/structures/distortion.hpp"
#include "scaling/text_table.hpp"

namespace musim::cli {
namespace {

struct ScaleOptions {
    SimilitudeOptions scales;
    ScaleLawOptions data;
    MonteCarloOptions monte_carlo;
    PropertiesOptions properties;
    bool json = false;
};

/// Warns that slenderness alone does not decide the regime.
void note_unknown_regime(const ScaleOptions& options, const scaling::UncertainReport& report) {
    const std::vector<scaling::UncertainPair>& given = report.structure;
    const auto is_regime = [](const scaling::UncertainPair& pair) { return pair.name.starts_with("mu/tan(alpha)"); };
    if (options.scales.chosen.slenderness.empty() || std::any_of(given.begin(), given.end(), is_regime)) return;
    note_at_end(
        "musim: warning: whether blocks slide or rock first (mu/tan(alpha)) is not known: --slenderness needs --friction-prototype");
}

/// Says so when many draws were of no use: what is left is no longer the distribution asked for.
void note_rejected_draws(const scaling::Draws& draws) {
    constexpr double kMany = 0.05;  // of the samples
    if (static_cast<double>(draws.rejected) < kMany * static_cast<double>(draws.settings.samples)) return;
    note_at_end(
        fmt::format("musim: note: {} draws for {} samples were not positive and drawn again, so the results are not of a {} distribution; "
                    "check the uncertainties, or take --distribution lognormal",
                    draws.rejected, draws.settings.samples, scaling::to_string(draws.settings.distribution)));
}

/// Adds "structure" and "measures" with the values at both scales, if there are any, and "uncertainty" if there is one.
void add_uncertainty(nlohmann::json& object, const scaling::UncertainReport& report) {
    if (!report.structure.empty()) object["structure"] = values_to_json(report.structure);
    if (!report.measures.empty()) object["measures"] = values_to_json(report.measures);
    if (report.is_certain()) return;
    nlohmann::json uncertainty = to_json(report);
    uncertainty["structure"] = to_json(report.structure);
    uncertainty["measures"] = to_json(report.measures);
    object["uncertainty"] = uncertainty;
}

/// Tables of inputs, factors and groups with their uncertainties.
std::string make_uncertain_factors(const scaling::UncertainReport& report, scaling::ReportStyle style) {
    std::string text = make_table(make_inputs_table(report.inputs), style) + "\n";
    if (report.draws) text += make_paragraph(describe_draws(*report.draws), style) + "\n";
    for (const auto& table : {make_results_table("factor", report.factors), make_results_table("group (1 = kept)", report.groups),
                              make_results_table("group as shaken", report.shaken)}) {
        text += make_table(table, style) + "\n";
    }
    return text;
}

/// Tables of groups and measures at both scales, if there are any.
std::string make_structure_and_measures(const scaling::UncertainReport& report, scaling::ReportStyle style) {
    std::string text;
    if (!report.structure.empty()) text += make_table(make_pairs_table("group", report.structure), style) + "\n";
    if (!report.measures.empty()) text += make_table(make_pairs_table("measure", report.measures), style) + "\n";
    return text;
}

/// Laws that are reported by the factors of a similitude and the groups of a block structure, unless --set or a product asks for more; all
/// others by the quantities that they name.
constexpr std::string_view kLawsOfStructures[] = {"mu", "froude", "exact", "cauchy"};

bool wants_similitude(const ScaleOptions& options) {
    const bool is_one =
        std::find(std::begin(kLawsOfStructures), std::end(kLawsOfStructures), options.scales.law) != std::end(kLawsOfStructures);
    return is_one && options.scales.factors.empty() && !options.data.name_products();
}

/// One of kLawsOfStructures, with all its options.
int run_similitude(const ScaleOptions& options) {
    const scaling::Similitude similitude = options.scales.similitude();
    const scaling::ModelProperties properties = structure_of(options.scales.chosen);
    const auto groups = scaling::group_factors(similitude, properties);
    const auto distortions = scaling::find_distortions(similitude, properties);
    const scaling::UncertainReport uncertain =
        propagate(options.scales.scales(), options.scales.make_scales(), properties, options.monte_carlo.make());
    note_unknown_regime(options, uncertain);
    if (uncertain.draws) note_rejected_draws(*uncertain.draws);
    options.scales.note_doubtful_factors();

    if (options.json) {
        nlohmann::json object = lsdem::to_json(similitude);
        object["groups"] = to_json(groups);
        object["distortions"] = lsdem::to_json(distortions);
        object["solid_elasticity"] = scaling::find_solid_elasticity(similitude);
        add_uncertainty(object, uncertain);
        print_json(object);
        return kDone;
    }
    const scaling::ReportStyle style = options.data.style;
    std::string text =
        make_paragraph(
            fmt::format("Law {}: length {:.7g}, friction {:.7g}, gravity {:.7g}, density {:.7g} (model/prototype)", similitude.law_name(),
                        similitude.length(), similitude.friction(), similitude.gravity(), similitude.density()),
            style) +
        "\n";
    if (!uncertain.is_certain()) {
        text += make_uncertain_factors(uncertain, style);
    } else {
        for (const auto& table : {make_factors_table("factor", similitude.factors()), make_factors_table("group (1 = kept)", groups)}) {
            text += make_table(table, style) + "\n";
        }
    }
    std::vector<std::string> lines = describe_distortions(distortions);
    for (std::string& line : describe_elasticity(similitude)) lines.push_back(std::move(line));
    print("{}{}{}", text, make_structure_and_measures(uncertain, style), make_lines(lines, style));
    return kDone;
}

int run_scale(const ScaleOptions& options) {
    if (options.data.lists_laws) return list_scale_laws(options.data.style, options.json);
    const CLI::App& command = *options.scales.command;
    const bool by_properties = options.properties.is_given() && !options.data.name_products();
    if (by_properties || wants_similitude(options)) {
        if (command.count("--length") == 0) {
            throw CLI::RequiredError(by_properties ? "--length (of the model, whatever the law; --set takes its other factors)"
                                                   : "--length (or --set for a law as data)");
        }
        return by_properties ? run_scale_properties(command, options.scales, options.properties, options.monte_carlo.make(),
                                                    options.data.style, options.json)
                             : run_similitude(options);
    }
    if (options.properties.is_given()) {
        throw CLI::ValidationError("--properties", "takes no products or values; give the file a \"law\" with \"set\" and \"hold\"");
    }
    for (const char* option :
         {"--friction-prototype", "--slenderness", "--height", "--pga", "--pgv", "--pgd", "--arias", "--duration", "--time-step"}) {
        if (command.count(option) > 0) {
            throw CLI::ValidationError(
                option,
                "belongs to laws mu, froude, exact and cauchy with --length; for a law as data give the prototype's values with --value");
        }
    }
    const bool is_free = command.count("--law") == 0 && !options.data.held.empty();
    return run_scale_law(options.data, is_free ? "" : options.scales.law, options.scales.given(), options.monte_carlo.make(), options.json);
}

}  // namespace

void add_scale_command(CLI::App& app, Action& action) {
    auto options = std::make_shared<ScaleOptions>();
    CLI::App* command = app.add_subcommand("scale", "Scale factors of every mechanical quantity, and what the model distorts");
    options->scales.add_to(*command, LengthOption::optional);
    options->data.add_to(*command);
    add_structure_options(*command, options->scales.chosen);
    add_motion_options(*command, options->scales.chosen.motion);
    options->monte_carlo.add_to(*command);
    options->properties.add_to(*command);
    add_json_option(*command, options->json);
    command->get_option("--json")->excludes("--format");
    command->footer(
        "Laws mu, froude, exact and cauchy take --length; every law, also yours in a file (musim-law/1), takes --set. Without --law,\n"
        "--hold names what model and prototype share; l, t, rho, v, a, m, F, E and others mean what `--laws` and the law files say.\n"
        "Examples:\n"
        "  musim scale --length 1/107 --friction 0.63/0.59\n"
        "  musim scale --length 1/107 --friction 0.18/0.59 --friction-prototype 0.59 --slenderness 0.32 --slenderness 0.6635\n"
        "  musim scale --length 1/107 --friction \"(0.63+/-5%)/(0.59+/-5%)\" --slenderness 0.32+/-1% --monte-carlo --seed 7\n"
        "  musim scale --length 1/107+/-0.4% --friction 1.07+/-7% --pga 0.511g --pgv \"42.4+/-0.4 cm/s\" --json\n"
        "  musim scale --length 1/25 --gravity 25 --law froude --json\n"
        "  musim scale --length 1/107 --properties examples/properties/wood.json --format markdown > wood.md\n"
        "  musim scale --length 1/107 --properties examples/properties/uncertain.json --monte-carlo --seed 7\n"
        "  musim scale --laws\n"
        "  musim scale --law true_replica --set l=1/25 --value \"E=29.2 GPa\"\n"
        "  musim scale --law artificial_mass --set l=1/25 --value \"m_s=270151 t\" --format markdown\n"
        "  musim scale --law true_replica --set l=1/25+/-0.4% --set \"rho=(2310+/-1%)/(2320+/-1%)\" --value \"E=29.2+/-1.5 GPa\" "
        "--monte-carlo\n"
        "  musim scale --law examples/laws/bolted.json --set l=1/25 --set k_b=1/100    # or what --law NAME --json printed, which holds "
        "the law\n"
        "  musim scale --define E:GPa --set l=1/25 --set g=1 --set E=1 --set rho=1 --hold \"v/sqrt(g*l)\" --watch \"rho*g*l/E\"\n"
        "Factors may carry standard uncertainties: 0.63+/-0.03, \"0.63 +/- 5%\", \"(0.63+/-5%)/(0.59+/-5%)\". They are propagated to first "
        "order;\n"
        "u is a standard uncertainty, intervals of --monte-carlo cover 95 %. \"as shaken\": the groups of a test that is shaken with the "
        "factors' values.");
    command->callback([&action, options] { action = [options] { return run_whole([&] { return run_scale(*options); }); }; });
}

}  // namespace musim::cli
