#include <algorithm>
#include <CLI/CLI.hpp>
#include <cstddef>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cli/commands.hpp"
#include "cli/files.hpp"
#include "cli/interruption.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/progress_line.hpp"
#include "cli/record_source.hpp"
#include "cli/records/design_output.hpp"
#include "cli/uncertain_options.hpp"
#include "records/design/parse_design.hpp"
#include "records/error.hpp"

namespace musim::cli {
namespace {

/// Default number of samples: a share is then known to 1.1 % (standard error at one half) within seconds, as each sample searches the
/// length scales of all limits anew.
constexpr std::size_t kSamples = 2'000;

struct DesignOptions {
    std::string file;
    RecordSourceOptions source;
    MonteCarloOptions monte_carlo;
    scaling::ReportStyle style = scaling::ReportStyle::plain;
    bool json = false;
};

/// A design with all that its files say, to be read more than once.
class DesignFiles {
  public:
    explicit DesignFiles(const DesignOptions& options)
        : options_(options), json_(read_input_file(options.file, "a design (musim-design/1)")), presets_(make_preset_materials()) {}

    records::Setting read(scaling::UncertainReading& reading) {
        records::Setting setting{records::parse_design(json_, options_.file, presets_, &reading), {}};
        const records::Design& design = setting.design;
        if (design.table_file.empty()) return setting;
        const records::ShakeTable table = read_shake_table(find_beside(options_.file, design.table_file), &reading);
        if (const auto* const peaks = std::get_if<std::vector<records::GivenPeaks>>(&design.motion)) {
            setting.loads = make_loads(*peaks, table, options_.file);
            return setting;
        }
        setting.loads = loads_of_record(std::get<records::RecordFile>(design.motion), table);
        return setting;
    }

  private:
    /// A record asks the same of every table: it is measured once.
    std::vector<records::AxisLoad> loads_of_record(const records::RecordFile& record, const records::ShakeTable& table) {
        if (!of_record_) of_record_ = make_loads(options_.source.load_beside(options_.file, record.file), record, table);
        std::vector<records::AxisLoad> loads = *of_record_;
        for (records::AxisLoad& load : loads) load.axis = table.find_axis(load.axis.name);
        return loads;
    }

    const DesignOptions& options_;
    std::string json_;
    std::vector<records::Material> presets_;
    std::optional<std::vector<records::AxisLoad>> of_record_;
};

DesignUncertainty find_uncertainty(DesignFiles& files, const scaling::UncertainReading& reading, const records::Setting& setting,
                                   const std::vector<records::Candidate>& candidates,
                                   const std::optional<scaling::MonteCarloSettings>& monte_carlo) {
    if (reading.inputs().empty() && !monte_carlo) return {};
    const auto read = [&](scaling::UncertainReading& each) { return files.read(each); };
    std::vector<records::MovedSetting> settings;
    for (auto& moved : scaling::read_moved(reading, read)) settings.push_back({std::move(moved.below), std::move(moved.above)});
    DesignUncertainty uncertainty{reading.inputs(), records::propagate(setting, candidates, reading.inputs(), settings), {}};
    if (monte_carlo) {
        ProgressLine progress("samples");
        const auto draw = [&](std::span<const double> values) { return scaling::read_drawn(reading, values, read); };
        uncertainty.samples = records::draw_candidates(setting, candidates, reading.inputs(), draw, *monte_carlo,
                                                       [&](double fraction) { progress.update(fraction); });
    }
    return uncertainty;
}

int run_design(const DesignOptions& options) {
    DesignFiles files(options);
    scaling::UncertainReading reading(options.file);
    const records::Setting setting = files.read(reading);
    const std::vector<records::Candidate> candidates = records::find_candidates(setting);
    const DesignUncertainty uncertainty = find_uncertainty(files, reading, setting, candidates, options.monte_carlo.make());
    if (options.json) {
        print_json(to_json(setting.design, candidates, uncertainty));
    } else {
        print("{}", make_design_report(setting.design, candidates, uncertainty, options.style));
    }
    const bool is_feasible = std::any_of(candidates.begin(), candidates.end(), [](const auto& each) { return each.is_feasible(); });
    if (is_feasible) return kDone;
    note("musim: error: {}: nothing is feasible ({}, law {}: {})\n", options.file, candidates.front().material.name,
         candidates.front().law.name(), candidates.front().problem);
    return kCheckFailed;
}

}  // namespace

void add_design_command(CLI::App& app, Action& action) {
    auto options = std::make_shared<DesignOptions>();
    CLI::App* command = app.add_subcommand("design", "Which length scales, materials and laws a table, a hall and a workshop allow");
    command
        ->add_option("design", options->file,
                     "Prototype, record, table, limits, materials (JSON, musim-design/1; see docs/user/design_files.md)")
        ->required()
        ->type_name("DESIGN");
    options->source.add_to(*command);
    options->monte_carlo.settings.samples = kSamples;
    options->monte_carlo.add_to(*command);
    CLI::Option* const format = add_format_option(*command, options->style, "Form of the report");
    add_json_option(*command, options->json);
    command->get_option("--json")->excludes(format);
    command->footer(
        "Files named in the design are looked for in its folder. Exit code 0: something is feasible; 5: nothing is.\n"
        "Values and limits may carry standard uncertainties, \"6 m +/- 5 cm\", \"0.63+/-5%\", in the design and in its table: ends of the\n"
        "length scales and all that is reported of models then have 95 % intervals, to first order. --monte-carlo also\n"
        "draws all of them at once: in how many samples a candidate is feasible, between which ends, and by which limits.\n"
        "Examples:\n"
        "  musim design examples/design/tower.json\n"
        "  musim design examples/design/laws.json\n"
        "  musim design examples/design/uncertain.json --monte-carlo --seed 7\n"
        "  musim design examples/design/tower.json --format markdown > campaign.md\n"
        "  musim design examples/design/tower.json --json");
    command->callback([&action, options] { action = [options] { return run_whole([&] { return run_design(*options); }); }; });
}

}  // namespace musim::cli
