#include <algorithm>
#include <CLI/CLI.hpp>
#include <cmath>
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
#include "cli/record_source.hpp"
#include "cli/records/record_output.hpp"
#include "cli/records/record_peaks.hpp"
#include "cli/report.hpp"
#include "cli/scaling/uncertainty_output.hpp"
#include "cli/uncertain_options.hpp"
#include "records/measures/intensity.hpp"
#include "records/processing/scale_record.hpp"
#include "records/shake_table/shake_table.hpp"
#include "scaling/laws/model_scales.hpp"

namespace musim::cli {
namespace {

struct RescaleOptions {
    std::string record;
    RecordSourceOptions source;
    SimilitudeOptions scales;
    RecordOutputOptions output;
    MonteCarloOptions monte_carlo;
    bool json = false;
};

/// Names of the components that shake vertically.
std::vector<std::string> list_vertical(const records::GroundMotion& motion) {
    std::vector<std::string> names;
    for (const records::Component& component : motion.components) {
        if (records::is_vertical(component)) names.push_back(component.name);
    }
    return names;
}

bool has_rotation(const records::GroundMotion& motion) {
    return std::any_of(motion.components.begin(), motion.components.end(),
                       [](const records::Component& component) { return records::is_rotation(component); });
}

/// Angles keep their size; where heights and widths, or displacements and lengths, scale apart, points of a turned base then do not move as
/// the prototype's.
void note_turned_distortion(const scaling::ModelScales& scales) {
    constexpr double kSame = 1e-9;
    const auto differs = [&](double factor) { return std::abs(factor / scales.height - 1.0) > kSame; };
    if (!differs(scales.width) && !differs(scales.displacement) && !differs(scales.displacement_vertical)) return;
    note_at_end(fmt::format(
        "musim: note: rotations keep their angles, but law {} scales heights {:.6g}, widths {:.6g} and displacements {:.6g} apart: "
        "what a turned base does to points away from its axis is not similar",
        scales.law, scales.height, scales.width, scales.displacement));
}

/// Uncertain results of a rescaled record, by component.
struct UncertainRescale {
    std::vector<std::string> components;
    std::vector<scaling::UncertainReport> reports;  ///< one for each; they differ in structure and measures only
};

template <class Quantity>
Quantity magnitude(const records::Peak<Quantity>& peak) {
    return Quantity::from_value(std::abs(peak.value.value()));
}

/// Measures of a component; exact, as the record is what is rescaled.
scaling::UncertainMotion measure_component(const records::GroundMotion& motion, const records::Component& component) {
    const records::Intensity intensity = records::compute_intensity(component.series, motion.integration_corner);
    scaling::UncertainMotion measures;
    measures.direction = find_shaking(component);
    if (intensity.pga) measures.pga = {magnitude(*intensity.pga)};
    if (intensity.pgv) measures.pgv = {magnitude(*intensity.pgv)};
    if (intensity.pgd) measures.pgd = {magnitude(*intensity.pgd)};
    if (intensity.arias) measures.arias = {*intensity.arias};
    measures.duration = {component.series.duration()};
    measures.time_step = {component.series.dt()};
    return measures;
}

/// The measures or groups of all components in one table.
void print_pairs(const UncertainRescale& rescale, const std::string& title,
                 std::vector<scaling::UncertainPair> scaling::UncertainReport::*pairs) {
    std::vector<UncertainPairRow> rows;
    for (std::size_t c = 0; c < rescale.reports.size(); ++c) {
        const NamedValues component{{{}, "component", rescale.components[c]}};
        for (const scaling::UncertainPair& pair : rescale.reports[c].*pairs) rows.push_back({component, &pair});
    }
    if (!rows.empty()) print("\n{}", to_plain_text(make_pairs_table(title, rows)));
}

/// Propagates the factors' uncertainties to PGA, PGV, PGD, Arias intensity, duration and time step of every component, and to the groups of
/// the structure that the options give; a vertical component has a_vertical/g alone. Empty when nothing is uncertain and no structure is
/// given. Throws scaling::SimilitudeError.
UncertainRescale find_uncertain_rescale(const records::GroundMotion& prototype, const SimilitudeOptions& options,
                                        const std::optional<scaling::MonteCarloSettings>& monte_carlo) {
    UncertainRescale rescale;
    scaling::UncertainScales scales = options.scales();
    const bool has_structure = scales.friction_prototype || !scales.slenderness.empty() || scales.height;
    if (!scales.is_uncertain() && !has_structure && !monte_carlo) return rescale;
    const scaling::MakeModelScales make_scales = options.make_scales();
    for (const records::Component& component : prototype.components) {
        scales.motion = measure_component(prototype, component);
        rescale.components.push_back(component.name);
        rescale.reports.push_back(scaling::propagate(scales, make_scales, {}, monte_carlo));
    }
    return rescale;
}

/// Adds "uncertainty" to a JSON object, unless there is nothing to give.
void add_uncertainty(nlohmann::json& object, const UncertainRescale& rescale) {
    if (rescale.reports.empty()) return;
    nlohmann::json uncertainty = to_json(rescale.reports.front());
    uncertainty["components"] = nlohmann::json::array();
    for (std::size_t c = 0; c < rescale.reports.size(); ++c) {
        const scaling::UncertainReport& report = rescale.reports[c];
        uncertainty["components"].push_back(
            {{"component", rescale.components[c]}, {"measures", to_json(report.measures)}, {"structure", to_json(report.structure)}});
    }
    object["uncertainty"] = uncertainty;
}

/// Tables of inputs, measures and groups, unless there is nothing to give.
void print_uncertain_rescale(const UncertainRescale& rescale) {
    if (rescale.reports.empty()) return;
    const scaling::UncertainReport& report = rescale.reports.front();
    if (!report.inputs.empty()) print("\n{}", to_plain_text(make_inputs_table(report.inputs)));
    if (report.draws) print("\n{}\n", describe_draws(*report.draws));
    print_pairs(rescale, "measure", &scaling::UncertainReport::measures);
    print_pairs(rescale, "group", &scaling::UncertainReport::structure);
}

int run_rescale(const RescaleOptions& options) {
    const scaling::ModelScales scales = options.scales.model_scales();
    options.output.check();
    refuse_overwriting(options.source.find_files({options.record}), {options.output.out});
    const records::GroundMotion prototype = options.output.select(options.source.load(options.record));
    const records::GroundMotion model = records::rescale(prototype, scales);
    const UncertainRescale uncertain = find_uncertain_rescale(prototype, options.scales, options.monte_carlo.make());
    const auto distortions = scaling::find_distortions(scales, structure_of(options.scales.chosen));
    options.output.write(model);
    options.scales.note_doubtful_factors();

    nlohmann::json components = nlohmann::json::array();
    if (!options.json) {
        print("Law {}: {}time {:.7g}, velocity {:.7g}, acceleration {:.7g} (model/prototype)\n", scales.law, describe_lengths(scales),
              scales.time, scales.velocity, scales.acceleration);
        print("{}\n", describe_vertical(list_vertical(prototype), scales));
        if (has_rotation(prototype)) {
            print("Rotations: angle 1, angular velocity {:.7g}, angular acceleration {:.7g}\n", scales.angular_velocity(),
                  scales.angular_acceleration());
        }
    }
    if (has_rotation(prototype)) note_turned_distortion(scales);
    for (std::size_t c = 0; c < model.components.size(); ++c) {
        const std::string& name = model.components[c].name;
        const NamedValues before = find_peaks(prototype, prototype.components[c]);
        const NamedValues after = find_peaks(model, model.components[c]);
        const bool is_vertical = records::is_vertical(prototype.components[c]);
        components.push_back({{"component", name},
                              {"vertical", is_vertical},
                              {"rotation", records::is_rotation(model.components[c])},
                              {"prototype", to_json(before)},
                              {"model", to_json(after)}});
        if (!options.json) {
            print_peak_titles(model, c, before);
            print_row("prototype", before);
            print_row("model", after);
        }
    }
    if (options.json) {
        nlohmann::json object = to_json(scales);
        object["out"] = options.output.out;
        object["components"] = components;
        object["distortions"] = lsdem::to_json(distortions);
        object["solid_elasticity"] = scaling::find_solid_elasticity(scales);
        add_uncertainty(object, uncertain);
        print_json(object);
    } else {
        print_uncertain_rescale(uncertain);
        print("\n");
        print_distortions(distortions);
        for (const std::string& line : describe_elasticity(scales)) print("{}\n", line);
        print("\nWritten to {}\n", options.output.out);
    }
    return kDone;
}

}  // namespace

void add_rescale_command(CLI::App& app, Action& action) {
    auto options = std::make_shared<RescaleOptions>();
    CLI::App* command = app.add_subcommand("rescale", "The record a model must be shaken with, from the prototype's");
    command->add_option("record", options->record, kRecordArgument)->required()->type_name("RECORD");
    options->scales.add_to(*command);
    options->output.add_to(*command);
    options->source.add_to(*command);
    add_structure_options(*command, options->scales.chosen);
    options->monte_carlo.add_to(*command);
    add_json_option(*command, options->json);
    command->footer(
        "Examples:\n"
        "  musim rescale CICLC.v1 --length 1/107 --friction 0.63/0.59 -o model.csv\n"
        "  musim rescale CICLC.v1 --length 1/25 --component 360 -o model.at2\n"
        "  musim rescale CICLC.v1 --length 1/107+/-0.4% --friction \"(0.63+/-5%)/(0.59+/-5%)\" --height 161.5m --monte-carlo -o model.csv\n"
        "  musim rescale synthetic --length 1/107 --law froude -o model.csv --json\n"
        "  musim rescale CICLC.v1 --length 1/25 --law centrifuge -o model.csv\n"
        "  musim rescale CICLC.v1 --length 1/107 --friction 0.18/0.59 --law mu_vertical_distortion -o model.csv   # heights 1:107, widths "
        "by "
        "the law\n"
        "  musim rescale CICLC.v1 --length 1/25 --law examples/laws/bolted.json --set k_b=1/100 -o model.csv\n"
        "  musim rescale six.csv --length 1/25 -o model.csv   # columns such as \"ry (deg/s)\": angles times 1, rates over the time\n"
        "Vertical components (Up, UD, Z, HNZ and the like) are scaled by the law's own factor, as `musim scale` gives it: that of gravity "
        "where weights matter.\n"
        "Where factors carry uncertainties, e.g. 0.63+/-0.03, the record is scaled by their values, and the model's measures are reported "
        "with "
        "u, a\n"
        "standard uncertainty; those of --monte-carlo with intervals that cover 95 %.");
    command->callback([&action, options] { action = [options] { return run_whole([&] { return run_rescale(*options); }); }; });
}

}  // namespace musim::cli
