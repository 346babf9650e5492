#include <CLI/CLI.hpp>
#include <cmath>
#include <cstddef>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/input_file.hpp"
#include "cli/interruption.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/progress_line.hpp"
#include "cli/scaling/pi_report.hpp"
#include "cli/uncertain_options.hpp"
#include "scaling/pi/pi_problem.hpp"

namespace musim::cli {
namespace {

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
        print_json(to_json(report));
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
    command->add_option("--limit", options->limit, "Largest number of choices that --all lists")
        ->check([](const std::string& text) -> std::string {
            const bool is_whole = text.find_first_not_of("0123456789") == std::string::npos;
            if (is_whole && text.find_first_not_of('0') != std::string::npos) return "";
            return text + " is no whole number from 1; write one such as 100";
        })
        ->capture_default_str();
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
