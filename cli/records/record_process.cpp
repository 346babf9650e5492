#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/files.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/record_source.hpp"
#include "cli/records/record_output.hpp"
#include "cli/records/record_peaks.hpp"
#include "records/atomic_file.hpp"
#include "records/error.hpp"
#include "records/formats/read_record.hpp"
#include "records/processing/align.hpp"
#include "records/processing/recipe.hpp"

namespace musim::cli {
namespace {

struct RecordProcessOptions {
    std::vector<std::string> files;
    RecordSourceOptions source;
    std::string recipe;              ///< file, or a record whose history holds one
    std::vector<std::string> steps;  ///< as JSON objects, after those of the recipe
    std::string save_recipe;
    RecordOutputOptions output;
    bool json = false;
};

/// A recipe, or what the history of a record holds, which musim's own CSV has.
records::Recipe load_recipe(const std::string& file) {
    const std::string text = read_input_file(file, "a recipe, or a record processed before");
    if (!text.starts_with("# musim ground motion")) return records::parse_recipe(text, file);
    const records::Recipe recipe = records::recipe_of(records::read_record(file));
    if (!recipe.empty()) return recipe;
    throw records::ReadError(file +
                             ": its history has no step of a recipe (it was not processed since it was read, made or rescaled); "
                             "give the record that was processed, or a recipe (JSON)");
}

/// Those of --step.
records::Recipe read_steps(const std::string& list) {
    try {
        return records::parse_recipe(R"({"schema": "musim-recipe/1", "steps": [)" + list + "]}", "--step");
    } catch (const records::ReadError& error) {
        throw CLI::ValidationError(error.what());
    }
}

records::Recipe find_recipe(const RecordProcessOptions& options) {
    records::Recipe recipe;
    if (!options.recipe.empty()) recipe = load_recipe(options.recipe);
    if (!options.steps.empty()) {
        std::string list;
        for (const std::string& step : options.steps) list += (list.empty() ? "" : ", ") + step;
        const records::Recipe more = read_steps(list);
        recipe.insert(recipe.end(), more.begin(), more.end());
    }
    if (recipe.empty()) throw CLI::ValidationError("record process", "there is nothing to do: give --recipe FILE or --step JSON");
    return recipe;
}

/// One record, of one file or of several whose components belong together.
records::GroundMotion load(const RecordProcessOptions& options) {
    std::vector<records::GroundMotion> files;
    for (const std::string& file : options.files) files.push_back(options.source.load(file));
    return files.size() == 1 ? files.front() : records::merge(files);
}

int run_record_process(const RecordProcessOptions& options) {
    options.output.check();
    std::vector<std::string> inputs = options.source.find_files(options.files);
    inputs.push_back(options.recipe);
    refuse_overwriting(inputs, {options.output.out, options.save_recipe});
    const records::Recipe recipe = find_recipe(options);
    const records::GroundMotion motion = load(options), processed = records::process(motion, recipe);
    options.output.write(processed);
    if (!options.save_recipe.empty()) records::write_file_atomically(options.save_recipe, records::write_recipe(recipe));

    nlohmann::json components = nlohmann::json::array();
    for (std::size_t c = 0; c < processed.components.size(); ++c) {
        // a step may add components
        const bool is_new = c >= motion.components.size();
        const NamedValues before = is_new ? NamedValues() : find_peaks(motion, motion.components[c]);
        const NamedValues after = find_peaks(processed, processed.components[c]);
        const std::string& name = processed.components[c].name;
        components.push_back({{"component", name}, {"before", is_new ? nlohmann::json() : to_json(before)}, {"after", to_json(after)}});
        if (options.json) continue;
        print_peak_titles(processed, c, after);
        if (!is_new) print_row("before", before);
        print_row(is_new ? "added" : "after", after);
    }
    if (options.json) {
        print_json({{"out", options.output.out}, {"history", processed.history}, {"components", components}});
        return kDone;
    }
    print("\n");
    for (const std::string& line : processed.history) print("{}\n", line);
    print("\nWritten to {}\n", options.output.out);
    return kDone;
}

}  // namespace

void add_record_process_command(CLI::App& record, Action& action) {
    auto options = std::make_shared<RecordProcessOptions>();
    CLI::App* command =
        record.add_subcommand("process", "Filter, cut, align, rotate, resample, integrate: what a recipe says, step by step");
    command->add_option("files", options->files, std::string(kRecordArgument) + "; several files are the components of one record")
        ->required()
        ->type_name("FILE");
    command->add_option("--recipe", options->recipe, "Recipe (JSON), or a CSV record processed before: that of its history")
        ->type_name("FILE");
    command->add_option("--step", options->steps, "One more step, as JSON; may be repeated")->type_name("JSON")->allow_extra_args(false);
    command->add_option("--save-recipe", options->save_recipe, "Write the recipe, every number to the last bit")->type_name("FILE");
    options->output.add_to(*command);
    options->source.add_to(*command);
    add_json_option(*command, options->json);
    command->footer(
        "Steps: align, level, baseline (order), taper (fraction), pad (before, after), cut (window), energy_window (from, to, margin), "
        "amplify (factor),\n"
        "  filter (low, high, order, phase zero|causal), resample (dt, between band_limited|straight), rotate (azimuth_deg), rest,\n"
        "  integrate (by trapezoid|frequency), differentiate, to_acceleration, surface_rotation (velocity, vertical, transverse): rocking "
        "ry "
        "and\n"
        "  torsion rz of the surface in waves along +x with that apparent velocity. Quantities are SI numbers or text such as \"0.064 "
        "Hz\".\n"
        "Examples:\n"
        "  musim record process CICLC.v1 --step '{\"step\": \"level\"}' --step '{\"step\": \"filter\", \"low\": \"0.064 Hz\"}' -o clc.csv\n"
        "  musim record process N.at2 E.at2 --recipe recipe.json -o both.csv --json\n"
        "  musim record process other.v1 --recipe clc.csv -o other.csv\n"
        "  musim record process CICLC.v1 -o six.csv \\\n"
        "    --step '{\"step\": \"surface_rotation\", \"velocity\": \"800 m/s\", \"vertical\": \"Up\", \"transverse\": \"360\"}'");
    command->callback([&action, options] { action = [options] { return run_record_process(*options); }; });
}

}  // namespace musim::cli
