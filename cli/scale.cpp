#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "cli/commands.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/report.hpp"
#include "scaling/distortion.hpp"

namespace musim::cli {
namespace {

struct ScaleOptions {
    SimilitudeOptions scales;
    std::optional<Number> friction_prototype;
    std::vector<Number> slenderness;
    bool json = false;
};

int run_scale(const ScaleOptions& options) {
    const scaling::Similitude similitude = options.scales.similitude();
    scaling::ModelFacts facts;
    if (options.friction_prototype) facts.friction_prototype = options.friction_prototype->value;
    facts.slenderness.assign(options.slenderness.begin(), options.slenderness.end());
    const auto groups = scaling::group_factors(similitude, facts);
    const auto distortions = scaling::find_distortions(similitude, facts);

    if (options.json) {
        nlohmann::json object = study::to_json(similitude);
        object["groups"] = to_json(groups);
        object["distortions"] = study::to_json(distortions);
        print_json(object);
        return kDone;
    }
    print("Law {}: length {:.7g}, friction {:.7g}, gravity {:.7g}, density {:.7g} (model/prototype)\n\n", similitude.law_name(),
          similitude.length(), similitude.friction(), similitude.gravity(), similitude.density());
    print_factors("factor", similitude.factors());
    print("\n");
    print_factors("group (1 = kept)", groups);
    print("\n");
    print_distortions(distortions);
    return kDone;
}

}  // namespace

void add_scale_command(CLI::App& app, Action& action) {
    auto options = std::make_shared<ScaleOptions>();
    CLI::App* command = app.add_subcommand("scale", "Scale factors of every mechanical quantity, and what the model distorts");
    options->scales.add_to(*command);
    command
        ->add_option("--friction-prototype", options->friction_prototype,
                     "Friction coefficient of the prototype, to tell sliding from rocking")
        ->type_name("NUMBER");
    command->add_option("--slenderness", options->slenderness, "Width/height of the blocks; repeat for several directions")
        ->type_name("NUMBER");
    add_json_option(*command, options->json);
    command->footer(
        "Examples:\n"
        "  musim scale --length 1/107 --friction 0.63/0.59\n"
        "  musim scale --length 1/107 --friction 0.18/0.59 --friction-prototype 0.59 --slenderness 0.32 --slenderness 0.6635\n"
        "  musim scale --length 1/25 --gravity 25 --law froude --json");
    command->callback([&action, options] { action = [options] { return run_scale(*options); }; });
}

}  // namespace musim::cli
