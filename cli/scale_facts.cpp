#include "cli/scale_facts.hpp"

#include <fmt/format.h>

#include <CLI/Option.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "cli/facts_output.hpp"
#include "cli/input_file.hpp"
#include "cli/output.hpp"
#include "cli/preset_materials.hpp"
#include "design/parse_facts.hpp"

namespace musim::cli {
namespace {

/// How far a factor typed on the command line may be from that of the facts [-]: four digits of it. The facts' own is used.
constexpr double kTypedAgreement = 1e-3;

void require_agreement(const CLI::App& command, const std::string& file, const char* name, double typed, double told) {
    if (command.get_option(name)->count() == 0 || std::abs(typed / told - 1.0) <= kTypedAgreement) return;
    throw scaling::SimilitudeError(
        fmt::format("{}: {} is {:.6g}, but prototype and model have the ratio {:.6g}; leave the option out, or "
                    "correct the facts",
                    file, name, typed, told));
}

scaling::Similitude make_similitude(const CLI::App& command, const SimilitudeOptions& scales, const std::string& file,
                                    const scaling::PairFacts& pair) {
    const scaling::ScaleFactors typed = scales.scales().factors(), told = make_scale_factors(pair, typed.length);
    require_agreement(command, file, "--friction", typed.friction, told.friction);
    require_agreement(command, file, "--gravity", typed.gravity, told.gravity);
    require_agreement(command, file, "--density", typed.density, told.density);
    return scaling::Similitude(told, scaling::parse_law(scales.law));
}

std::optional<scaling::MotionFacts> find_motion(const FactsOptions& options, const std::optional<design::MotionSource>& source) {
    if (!source) return std::nullopt;
    if (const auto* const told = std::get_if<scaling::MotionFacts>(&*source)) return *told;
    const auto& record = std::get<design::RecordOfMotion>(*source);
    return design::measure_motion(options.source.load_beside(options.file, record.file), record);
}

std::optional<scaling::Bandwidth> find_table(const FactsOptions& options, const design::Facts& facts) {
    if (const auto* const told = std::get_if<scaling::Bandwidth>(&facts.table)) return *told;
    const auto* const named = std::get_if<design::AxisOfTable>(&facts.table);
    if (named == nullptr) return std::nullopt;
    const records::ShakeTable table = read_shake_table(find_beside(options.file, named->file));
    return design::find_bandwidth(table.find_axis(named->axis), design::find_mass(facts.model));
}

}  // namespace

void FactsOptions::add_to(CLI::App& command) {
    CLI::Option* const facts =
        command
            .add_option("--facts", file,
                        "What is known of prototype and model (JSON, musim-facts/1; see design/README.md): reports every group of both, "
                        "regimes, structural speed and rocking")
            ->type_name("FACTS.json");
    // what the facts tell themselves, and uncertainties, which this report does not carry
    for (const char* const name : {"--friction-prototype", "--slenderness", "--height", "--pga", "--pgv", "--pgd", "--arias", "--duration",
                                   "--time-step", "--monte-carlo"}) {
        facts->excludes(name);
    }
    source.add_to(command);
    for (const char* const name : {"--dt", "--unit", "--quantity", "--sensitivity", "--station-xml"}) {
        command.get_option(name)->needs(facts);
    }
}

int run_scale_facts(const CLI::App& command, const SimilitudeOptions& scales, const FactsOptions& options, scaling::ReportStyle style,
                    bool json) {
    // the model's default size needs a length scale that makes sense
    const scaling::Similitude by_length({.length = scales.scales().factors().length});
    scales.note_values_used();
    const design::Facts facts = design::parse_facts(read_input_file(options.file, "what is known of prototype and model (musim-facts/1)"),
                                                    options.file, make_preset_materials(), by_length.length());
    scaling::PairFacts pair{.prototype = facts.prototype,
                            .model = facts.model,
                            .motion = find_motion(options, facts.motion),
                            .model_motion = find_motion(options, facts.model_motion),
                            .table = find_table(options, facts)};
    const scaling::Similitude similitude = make_similitude(command, scales, options.file, pair);
    check(pair);
    if (pair.motion && !pair.model_motion) pair.model_motion = to_model(*pair.motion, similitude);
    const FactsReport report{facts.name, pair, similitude, make_regime_report(pair, similitude)};
    if (json) {
        print_json(to_json(report));
    } else {
        print("{}", make_facts_report(report, style));
    }
    return kDone;
}

}  // namespace musim::cli
