#include "cli/scaling/scale_facts.hpp"

#include <fmt/format.h>

#include <CLI/Option.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "cli/input_file.hpp"
#include "cli/output.hpp"
#include "cli/preset_materials.hpp"
#include "cli/progress_line.hpp"
#include "cli/scaling/facts_output.hpp"
#include "records/design/facts_law.hpp"
#include "records/design/parse_facts.hpp"
#include "scaling/laws/kept_numbers.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "scaling/laws/scale_law_catalogue.hpp"
#include "scaling/uncertainty/uncertain_regimes.hpp"

namespace musim::cli {
namespace {

/// How far a factor typed on the command line may be from that of the facts [-]: four digits of it. The facts' own is used.
constexpr double kTypedAgreement = 1e-3;

void require_agreement(const CLI::App& command, const std::string& file, const char* name, double typed, double given) {
    if (command.get_option(name)->count() == 0 || std::abs(typed / given - 1.0) <= kTypedAgreement) return;
    throw scaling::SimilitudeError(
        fmt::format("{}: {} is {:.6g}, but prototype and model have the ratio {:.6g}; leave the option out, or "
                    "correct the facts",
                    file, name, typed, given));
}

/// The law of the file, or the one typed; they must not be two.
records::DesignLaw find_law(const CLI::App& command, const SimilitudeOptions& scales, const std::string& file,
                            const std::optional<records::DesignLaw>& given) {
    const bool is_typed = command.count("--law") > 0;
    if (given) {
        if ((is_typed && scales.law != given->name()) || !scales.factors.empty()) {
            throw scaling::SimilitudeError(fmt::format("{}: its law is {}, and {} was typed, too; leave one out", file, given->name(),
                                                       scales.factors.empty() ? "--law " + scales.law : "--set " + scales.factors.front()));
        }
        return *given;
    }
    return {scaling::load_scale_law(scales.law), scaling::values_of(parse_factors(scales.factors))};
}

/// A file of facts with all that it says, to be read more than once.
class FactsFiles {
  public:
    FactsFiles(const CLI::App& command, const SimilitudeOptions& scales, const FactsOptions& options)
        : command_(command),
          scales_(scales),
          options_(options),
          // the model's default size needs a length scale that makes sense
          length_(scaling::make_similitude("exact", {.length = scales.scales().factors().length}).length()),
          json_(read_input_file(options.file, "what is known of prototype and model (musim-facts/1)")),
          presets_(make_preset_materials()) {}

    struct Read {
        std::string name;
        scaling::PairFacts pair;
        scaling::Similitude similitude;
    };

    /// Facts, and the similitude that they ask for; the motion of a model that was not given one is left open. The law is solved at the
    /// first call, others may come from any thread.
    Read read(scaling::UncertainReading& reading) {
        const records::Facts facts = records::parse_facts(json_, options_.file, presets_, length_, &reading);
        scaling::PairFacts pair{.prototype = facts.prototype,
                                .model = facts.model,
                                .motion = find_motion(facts.motion, measured_motion_),
                                .model_motion = find_motion(facts.model_motion, measured_model_motion_),
                                .table = find_table(facts, reading)};
        check(pair);
        return {facts.name, pair, apply_law(facts, pair, reading)};
    }

    /// Of the first call of read().
    const scaling::SolvedLaw& solved() const { return formulas_->solved(); }

  private:
    scaling::Similitude apply_law(const records::Facts& facts, const scaling::PairFacts& pair, const scaling::UncertainReading& reading) {
        if (!law_) law_ = find_law(command_, scales_, options_.file, facts.law);
        // a law of the file may have set another value by now
        const records::DesignLaw& law = facts.law ? *facts.law : *law_;
        try {
            if (!formulas_) formulas_ = records::solve_for(law, pair, length_);
            return records::apply_law(law, *formulas_, pair, length_);
        } catch (const scaling::SimilitudeError& error) {
            const scaling::UncertainInput* const moved = reading.moved_input();
            if (moved == nullptr) throw scaling::SimilitudeError(fmt::format("{}: {}", options_.file, error.what()));
            throw scaling::SimilitudeError(
                fmt::format("{}: {} is uncertain, and law {} admits its value alone ({}); give the value alone, or choose another law",
                            options_.file, moved->name, law.name(), error.what()));
        }
    }

    /// A record says the same whatever the facts: it is measured once.
    std::optional<scaling::MotionFacts> find_motion(const std::optional<records::MotionSource>& source,
                                                    std::optional<scaling::MotionFacts>& measured) const {
        if (!source) return std::nullopt;
        if (const auto* const given = std::get_if<scaling::MotionFacts>(&*source)) return *given;
        const auto& record = std::get<records::RecordOfMotion>(*source);
        if (!measured) measured = records::measure_motion(options_.source.load_beside(options_.file, record.file), record);
        return measured;
    }

    std::optional<scaling::Bandwidth> find_table(const records::Facts& facts, scaling::UncertainReading& reading) const {
        if (const auto* const given = std::get_if<scaling::Bandwidth>(&facts.table)) return *given;
        const auto* const named = std::get_if<records::AxisOfTable>(&facts.table);
        if (named == nullptr) return std::nullopt;
        const records::ShakeTable table = read_shake_table(find_beside(options_.file, named->file), &reading);
        return records::find_bandwidth(table.find_axis(named->axis), records::find_mass(facts.model));
    }

    const CLI::App& command_;
    const SimilitudeOptions& scales_;
    const FactsOptions& options_;
    double length_;
    std::string json_;
    std::vector<records::Material> presets_;
    std::optional<records::DesignLaw> law_;
    std::optional<scaling::LawFormulas> formulas_;
    std::optional<scaling::MotionFacts> measured_motion_, measured_model_motion_;
};

/// Facts whose model is shaken as it was given, or else by `shaken`.
scaling::FactsAndLaw with_motion(const FactsFiles::Read& read, const scaling::Similitude& shaken) {
    scaling::FactsAndLaw facts{read.pair, read.similitude};
    if (facts.facts.motion && !facts.facts.model_motion) facts.facts.model_motion = to_model(*facts.facts.motion, shaken);
    return facts;
}

scaling::UncertainRegimes find_uncertain_regimes(FactsFiles& files, const scaling::UncertainReading& reading,
                                                 const scaling::FactsAndLaw& facts, const scaling::KeptNumbers& kept,
                                                 const std::optional<scaling::MonteCarloSettings>& monte_carlo,
                                                 scaling::RegimeReport& report) {
    if (reading.inputs().empty() && !monte_carlo) return {};
    const auto read = [&](scaling::UncertainReading& each) { return with_motion(files.read(each), facts.similitude); };
    std::vector<scaling::MovedFacts> moved;
    for (const auto& each : scaling::read_moved(reading, read)) moved.push_back({each.below, each.above});
    scaling::UncertainRegimes uncertain = propagate(report, facts, kept, reading.inputs(), moved);
    if (monte_carlo) {
        ProgressLine progress("samples");
        const auto draw = [&](std::span<const double> values) { return scaling::read_drawn(reading, values, read); };
        add_samples(uncertain, report, facts, kept, draw, *monte_carlo, [&](double fraction) { progress.update(fraction); });
    }
    return uncertain;
}

}  // namespace

void FactsOptions::add_to(CLI::App& command) {
    CLI::Option* const facts =
        command
            .add_option(
                "--facts", file,
                "What is known of prototype and model (JSON, musim-facts/1; see docs/user/design_files.md): reports every group of both, "
                "regimes, structural speed and rocking")
            ->type_name("FACTS.json");
    // what the facts themselves give
    for (const char* const name :
         {"--friction-prototype", "--slenderness", "--height", "--pga", "--pgv", "--pgd", "--arias", "--duration", "--time-step"}) {
        facts->excludes(name);
    }
    source.add_to(command);
    for (const char* const name : {"--dt", "--unit", "--quantity", "--sensitivity", "--station-xml"}) {
        command.get_option(name)->needs(facts);
    }
}

int run_scale_facts(const CLI::App& command, const SimilitudeOptions& scales, const FactsOptions& options,
                    const std::optional<scaling::MonteCarloSettings>& monte_carlo, scaling::ReportStyle style, bool json) {
    scales.note_values_used();
    FactsFiles files(command, scales, options);
    scaling::UncertainReading reading(options.file);
    const FactsFiles::Read read = files.read(reading);
    const scaling::ScaleFactors typed = scales.scales().factors(), given = make_scale_factors(read.pair, typed.length);
    require_agreement(command, options.file, "--friction", typed.friction, given.friction);
    require_agreement(command, options.file, "--gravity", typed.gravity, given.gravity);
    require_agreement(command, options.file, "--density", typed.density, given.density);
    note_overruled(files.solved());
    const scaling::FactsAndLaw facts = with_motion(read, read.similitude);
    const scaling::KeptNumbers kept = find_kept_numbers(files.solved());
    scaling::RegimeReport regimes = make_regime_report(facts.facts, facts.similitude, kept);
    const scaling::UncertainRegimes uncertain = find_uncertain_regimes(files, reading, facts, kept, monte_carlo, regimes);
    const FactsReport report{read.name, facts.facts, facts.similitude, regimes, uncertain};
    if (json) {
        print_json(to_json(report));
    } else {
        print("{}", make_facts_report(report, style));
    }
    return kDone;
}

}  // namespace musim::cli
