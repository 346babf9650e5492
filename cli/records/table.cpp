#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/files.hpp"
#include "cli/named_values.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/record_source.hpp"
#include "cli/records/table_output.hpp"
#include "cli/report.hpp"
#include "records/atomic_file.hpp"
#include "records/processing/scale_record.hpp"
#include "records/shake_table/shake_table.hpp"
#include "records/shake_table/table_correction.hpp"
#include "records/shake_table/write_drive_file.hpp"
#include "scaling/quantity_text.hpp"

namespace musim::cli {
namespace {

struct TableOptions {
    std::string record;
    RecordSourceOptions source;
    SimilitudeOptions scales;
    std::string limits;
    std::vector<std::string> axes;  ///< COMPONENT=AXIS
    std::string payload, height, prototype_mass, prototype_height;
    std::optional<Number> highpass;
    std::string at_rest = "yes";
    std::vector<Number> periods;
    bool correct = false;
    Number accept{1.5};  ///< largest mean factor of PSA that a correction may bring
    std::string drive, save_recipe;
    bool json = false;
};

using Pairs = std::vector<std::pair<std::string, std::string>>;

Pairs parse_axes(const std::vector<std::string>& texts) {
    Pairs pairs;
    for (const std::string& text : texts) {
        const std::size_t at = text.find('=');
        if (at == std::string::npos || at == 0 || at + 1 == text.size())
            throw CLI::ValidationError("--axis", "\"" + text + "\" is no COMPONENT=AXIS; write for example 360=x");
        pairs.emplace_back(text.substr(0, at), text.substr(at + 1));
    }
    return pairs;
}

template <class Quantity>
Quantity parse(const char* option, const std::string& text) {
    if (text.empty()) return Quantity::from_value(0.0);
    const auto read = [&] { return Quantity::from_value(scaling::parse_si_with_unit(text, scaling::dimension_of<Quantity>())); };
    const auto quantity = read_option(option, read);
    if (!(quantity.value() >= 0.0)) throw CLI::ValidationError(option, "\"" + text + "\" is below zero; give zero or more");
    return quantity;
}

records::Payload find_payload(const TableOptions& options) {
    const bool is_prototype = !options.prototype_mass.empty() || !options.prototype_height.empty();
    if (is_prototype && !(options.payload.empty() && options.height.empty()))
        throw CLI::ValidationError("--payload", "contradicts --prototype-mass and --prototype-height; give the model's or the prototype's");
    if (is_prototype) {
        return {parse<scaling::Mass>("--prototype-mass", options.prototype_mass),
                parse<scaling::Length>("--prototype-height", options.prototype_height), true};
    }
    return {parse<scaling::Mass>("--payload", options.payload), parse<scaling::Length>("--payload-height", options.height), false};
}

std::vector<scaling::Time> find_periods(const TableOptions& options, const scaling::ModelScales& scales,
                                        const std::vector<records::ComponentUse>& uses) {
    if (options.periods.empty()) return records::make_task_periods(uses);
    constexpr std::size_t kPeriods = 50;
    const auto period = [&](std::size_t i) { return scales.time * options.periods[i].value * scaling::si::seconds; };
    return records::make_periods(period(0), period(1), kPeriods);
}

/// The record as it leaves for the controller.
void write_drive(const TableOptions& options, const records::ShakeTable& table, const records::TableTask& task,
                 const records::DriveSettings& settings) {
    std::vector<records::AxisMotion> axes;
    const std::vector<records::DriveMotion> motions = records::make_drive_motions(task.model, settings);
    for (std::size_t c = 0; c < motions.size(); ++c)
        axes.push_back({task.axes[c].name, records::add_rest(motions[c], table.controller->rest)});
    records::write_drive_file(options.drive, axes, *table.controller);
}

/// Verdict on one record on one table.
struct Verdict {
    std::vector<records::ComponentUse> uses;
    std::vector<records::ScaleRange> scales;
    std::vector<records::LimitScales> limit_scales;
    std::vector<records::Correction> corrections;  ///< best first; empty when it fits as it is
    bool fits = false;
};

/// Models of other lengths, by the same law with the same other factors.
records::ScalesOfLength vary_length(const SimilitudeOptions& options) {
    const scaling::UncertainScales scales = options.scales();
    return [make = options.make_scales(), chosen = scales.factors(), others = scaling::values_of(scales.others)](double length) {
        scaling::ScaleFactors factors = chosen;
        factors.length = length;
        return make(factors, others);
    };
}

Verdict judge(const TableOptions& options, const records::TableTask& task, const records::Payload& payload,
              const scaling::ModelScales& scales) {
    Verdict verdict;
    verdict.uses = records::check_task(task);
    std::vector<records::AxisLoad> loads;
    for (std::size_t c = 0; c < verdict.uses.size(); ++c)
        loads.push_back({task.axes[c], to_prototype(verdict.uses[c].demand, scales, find_shaking(task.axes[c]))});
    verdict.limit_scales = find_limit_scales(loads, payload.of_prototype(scales), vary_length(options.scales));
    verdict.scales = find_scales(verdict.limit_scales);
    verdict.fits = records::find_largest_use(verdict.uses) <= 1.0;
    if (!verdict.fits) verdict.corrections = records::find_corrections(task, find_periods(options, scales, verdict.uses));
    return verdict;
}

void print_verdict(const records::ShakeTable& table, const Verdict& verdict, const scaling::ModelScales& scales) {
    const std::string length = scales.similitude ? fmt::format("length {:.6g}, ", scales.height) : describe_lengths(scales);
    print("{}: law {}, {}time {:.6g}, acceleration {:.6g} (model/prototype)\n", table.name, scales.law, length, scales.time,
          scales.acceleration);
    std::vector<std::string> vertical;
    for (const records::ComponentUse& use : verdict.uses) {
        if (records::is_vertical_axis(table.find_axis(use.axis))) vertical.push_back(use.component);
    }
    print("{}\n", describe_vertical(vertical, scales));
    print_uses(verdict.uses, verdict.limit_scales);
    print("\n");
    print_scales(verdict.scales);
    if (verdict.fits) {
        print("The table can make this record.\n");
        return;
    }
    if (verdict.corrections.empty()) {
        print("The table cannot make this record, and no filter or amplitude helps.\n");
        return;
    }
    print("The table cannot make this record as it is. Corrections that fit, the one that changes the response least first:\n");
    for (const records::Correction& correction : verdict.corrections) print_correction(correction, scales);
    print("\n");
    print_spectra(verdict.corrections.front(), scales);
}

nlohmann::json describe(const TableOptions& options, const records::ShakeTable& table, const Verdict& verdict,
                        const scaling::ModelScales& scales) {
    nlohmann::json object = to_json(scales);
    object["table"] = table.name;
    object["fits"] = verdict.fits;
    object["components"] = to_json(verdict.uses, verdict.limit_scales);
    object["scales"] = nlohmann::json::array();
    for (const records::ScaleRange& range : verdict.scales) object["scales"].push_back(to_json(range));
    object["corrections"] = nlohmann::json::array();
    for (const records::Correction& correction : verdict.corrections) object["corrections"].push_back(to_json(correction, scales));
    object["drive"] = text_or_null(options.drive);
    return object;
}

/// Advice about a record that the table does not make.
std::string advise(const TableOptions& options, const Verdict& verdict) {
    const std::string scale = verdict.scales.empty() ? "" : "choose another length scale, or ";
    if (verdict.corrections.empty()) return verdict.scales.empty() ? "; choose another table" : "; choose another length scale or table";
    if (!options.correct) return "; " + scale + "add --correct";
    const double change = std::exp(verdict.corrections.front().mean_change);
    return fmt::format(" (the best correction changes PSA by a factor {:.3g} on average, {:.3g} is accepted); {}add --accept {:.2f}",
                       change, options.accept.value, scale, std::ceil(100.0 * change) / 100.0);
}

int run_table(TableOptions options) {
    require_ascending("--periods", options.periods);
    std::vector<std::string> inputs = options.source.find_files({options.record});
    inputs.push_back(options.limits);
    refuse_overwriting(inputs, {options.drive, options.save_recipe});

    const scaling::ModelScales scales = options.scales.model_scales();
    options.scales.note_values_used();
    if (options.accept < 1.0) {
        throw CLI::ValidationError("--accept",
                                   fmt::format("{:g} is below 1 (a factor between PSA before and after, whichever is larger; 1 is no "
                                               "change); give 1 or more, such as 1.5",
                                               options.accept.value));
    }
    const records::Payload payload = find_payload(options);
    const Pairs pairs = parse_axes(options.axes);
    const records::ShakeTable table = read_shake_table(options.limits);
    if (!options.drive.empty() && !table.controller)
        throw records::ReadError(options.limits +
                                 ": has no controller (a drive file needs its rate and units); add, for example, \"controller\": "
                                 "{\"rate\": \"1024 Hz\", \"displacement\": \"mm\"}");
    const records::AssignedAxes assigned = records::assign_axes(options.source.load(options.record), table, pairs);

    std::vector<scaling::Shaking> directions;
    for (const records::TableAxis& axis : assigned.axes) directions.push_back(find_shaking(axis));
    records::TableTask task{records::rescale(assigned.motion, scales, directions), assigned.axes, payload.on_model(scales),
                            table.energy_share};
    if (options.highpass) task.settings.high_pass = scales.frequency * options.highpass->value / scaling::si::seconds;
    if (table.controller) task.settings.dt = 1.0 / table.controller->rate;
    task.settings.at_rest = find_at_rest(options.at_rest);
    const Verdict verdict = judge(options, task, payload, scales);

    const bool is_correctable = !verdict.corrections.empty() && std::exp(verdict.corrections.front().mean_change) <= options.accept;
    const bool is_made = verdict.fits || (options.correct && is_correctable);
    const records::DriveSettings& settings = verdict.fits || !is_made ? task.settings : verdict.corrections.front().settings;
    if (is_made && !options.drive.empty()) write_drive(options, table, task, settings);
    if (is_made && !options.save_recipe.empty())
        records::write_file_atomically(options.save_recipe, records::write_recipe(records::make_drive_recipe(task.model, settings)));

    std::vector<DriveEffect> effects;
    if (is_made) {
        effects = find_drive_effects(task.model, settings, find_periods(options, scales, verdict.uses));
        warn_of_drive_effects(options.record, effects);
    }

    if (!is_made) options.drive.clear();
    if (options.json) {
        nlohmann::json object = describe(options, table, verdict, scales);
        object["drive_effects"] = to_json(effects);
        print_json(object);
    } else {
        print_verdict(table, verdict, scales);
        if (is_made) print_drive_effects(effects);
    }
    if (!is_made) {
        note("musim: error: {}: the table cannot make it{}\n", options.record, advise(options, verdict));
        return kCheckFailed;
    }
    if (!options.json && !options.drive.empty()) print("\nWritten to {}\n", options.drive);
    return kDone;
}

}  // namespace

void add_table_command(CLI::App& app, Action& action) {
    auto options = std::make_shared<TableOptions>();
    CLI::App* command = app.add_subcommand("table", "Whether a shake table can make a model's record; corrections; the drive file");
    command->add_option("record", options->record, std::string(kRecordArgument) + "; the prototype's")->required()->type_name("RECORD");
    command->add_option("--limits", options->limits, "What the table can do (JSON, musim-table/1)")->required()->type_name("FILE");
    options->scales.add_to(*command);
    command
        ->add_option("--axis", options->axes,
                     "A component and the axis that makes it; may be repeated (default: all, vertical ones by the axis z or vertical, "
                     "rotations by roll, pitch, yaw)")
        ->type_name("COMPONENT=AXIS")
        ->allow_extra_args(false);
    command->add_option("--payload", options->payload, "Mass of the model on the table at this length, such as \"350 kg\" (default 0)")
        ->type_name("MASS");
    command->add_option("--payload-height", options->height, "Its centre of mass above the platen (default 0)")->type_name("LENGTH");
    command->add_option("--prototype-mass", options->prototype_mass, "The prototype's mass instead, scaled with the model")
        ->type_name("MASS");
    command->add_option("--prototype-height", options->prototype_height, "Its centre of mass above ground")->type_name("LENGTH");
    command
        ->add_option("--highpass", options->highpass, "Corner [Hz of the prototype] of a high-pass in any case (default: as record info)")
        ->type_name("NUMBER")
        ->check(above_zero());
    add_at_rest_option(*command, options->at_rest);
    command->add_option("--periods", options->periods, "Band of periods [s of the prototype] in which corrections are weighed")
        ->type_name("FIRST LAST")
        ->expected(2)
        ->check(above_zero());
    command->add_flag("--correct", options->correct, "When the record does not fit, take the best correction, if --accept allows");
    command->add_option("--accept", options->accept, "Factor, 1 or more, by which --correct may change PSA on average (default 1.5)")
        ->type_name("FACTOR");
    command->add_option("--drive", options->drive, "Write the motion as the table's controller reads it")->type_name("FILE");
    command->add_option("--save-recipe", options->save_recipe, "Write what was done to the model's record, as a recipe")->type_name("FILE");
    options->source.add_to(*command);
    add_json_option(*command, options->json);
    command->footer(
        "Exit code 0: the table can make the record, as it is or corrected; 5: it cannot, and nothing is written.\n"
        "Examples:\n"
        "  musim table CICLC.v1 --limits examples/tables/array.json --length 1/25 --axis 360=x --payload \"2 t\"     # too quick: exit "
        "code 5\n"
        "  musim table TCU052-N.AT2 --limits examples/tables/array.json --length 1/40 --friction 0.63/0.59 --axis N=x \\\n"
        "    --prototype-mass \"1.2e5 t\" --drive drive.csv\n"
        "  musim table TCU052-N.AT2 --limits examples/tables/array.json --length 1/40 --friction 0.18/0.59 --law mu_vertical_distortion "
        "--axis N=x\n"
        "  musim table TCU052-N.AT2 --limits examples/tables/outdoor.json --length 1/4 --correct --drive drive.csv --json\n"
        "  musim table turned.csv --limits examples/tables/six_axes.json --length 1/40 --axis 360=x --axis ry=pitch --axis rz=yaw \\\n"
        "    --payload \"400 kg\" --payload-height \"0.8 m\" --drive six.csv     # rotations, such as \"ry (deg/s)\", on a six-axis table");
    command->callback([&action, options] { action = [options] { return run_table(*options); }; });
}

}  // namespace musim::cli
