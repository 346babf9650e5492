#include "cli/scaling/scale_properties.hpp"

#include <fmt/format.h>

#include <CLI/Option.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "cli/files.hpp"
#include "cli/output.hpp"
#include "cli/progress_line.hpp"
#include "cli/scaling/properties_output.hpp"
#include "records/design/parse_properties.hpp"
#include "records/design/properties_law.hpp"
#include "scaling/laws/group_meaning.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "scaling/laws/scale_law_catalogue.hpp"
#include "scaling/uncertainty/uncertain_regimes.hpp"

namespace musim::cli {
namespace {

/// Largest relative distance of a factor typed on the command line from that of the properties [-]: four digits of it. The properties' own
/// is used.
constexpr double kTypedAgreement = 1e-3;

void require_agreement(const CLI::App& command, const std::string& file, const char* name, double typed, double given) {
    if (command.get_option(name)->count() == 0 || std::abs(typed / given - 1.0) <= kTypedAgreement) return;
    throw scaling::SimilitudeError(
        fmt::format("{}: {} is {:.6g}, but prototype and model have the ratio {:.6g}; leave the option out, or "
                    "correct the properties",
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

/// A file of structure properties with all that it says, to be read more than once.
class PropertiesFiles {
  public:
    PropertiesFiles(const CLI::App& command, const SimilitudeOptions& scales, const PropertiesOptions& options)
        : command_(command),
          scales_(scales),
          options_(options),
          // the model's default size needs a length scale that makes sense
          length_(scaling::make_similitude("exact", {.length = scales.scales().factors().length}).length()),
          object_(records::parse_properties_text(read_input_file(options.file, "what is known of prototype and model (musim-properties/1)"),
                                                 options.file)),
          presets_(make_preset_materials()) {}

    struct Read {
        std::string name;
        scaling::PairProperties pair;
        scaling::Similitude similitude;
    };

    /// Properties, and the similitude that they ask for; the motion of a model that was not given one is left open. The law is solved at
    /// the first call, others may come from any thread.
    Read read(scaling::UncertainReading& reading) {
        const records::Properties properties = records::read_properties(object_, options_.file, presets_, length_, &reading);
        scaling::PairProperties pair{.prototype = properties.prototype,
                                     .model = properties.model,
                                     .motion = find_motion(properties.motion, measured_motion_),
                                     .model_motion = find_motion(properties.model_motion, measured_model_motion_),
                                     .table = find_table(properties, reading)};
        check(pair);
        return {properties.name, pair, apply_law(properties, pair, reading)};
    }

    /// Law of the first call of read().
    const scaling::SolvedLaw& solved() const { return formulas_->solved(); }

  private:
    scaling::Similitude apply_law(const records::Properties& properties, const scaling::PairProperties& pair,
                                  const scaling::UncertainReading& reading) {
        if (!law_) law_ = find_law(command_, scales_, options_.file, properties.law);
        // a law of the file may have set another value by now
        const records::DesignLaw& law = properties.law ? *properties.law : *law_;
        try {
            if (!formulas_) formulas_ = records::solve_for(law, pair, length_);
            return records::apply_law(law, *formulas_, pair, length_);
        } catch (const scaling::SimilitudeError& error) {
            const scaling::UncertainInput* const moved = reading.moved_input();
            if (moved == nullptr) throw error.seen_from<scaling::SimilitudeError>(options_.file);
            throw scaling::SimilitudeError(
                fmt::format("{}: {} is uncertain, and law {} admits its value alone ({}); give the value alone, or choose another law",
                            options_.file, moved->name, law.name(), error.what()));
        }
    }

    /// A record says the same whatever the properties: it is measured once.
    std::optional<scaling::MotionProperties> find_motion(const std::optional<records::MotionSource>& source,
                                                         std::optional<scaling::MotionProperties>& measured) const {
        if (!source) return std::nullopt;
        if (const auto* const given = std::get_if<scaling::MotionProperties>(&*source)) return *given;
        const auto& record = std::get<records::RecordOfMotion>(*source);
        if (!measured) measured = records::measure_motion(options_.source.load_beside(options_.file, record.file), record);
        return measured;
    }

    std::optional<scaling::Bandwidth> find_table(const records::Properties& properties, scaling::UncertainReading& reading) const {
        if (const auto* const given = std::get_if<scaling::Bandwidth>(&properties.table)) return *given;
        const auto* const named = std::get_if<records::AxisOfTable>(&properties.table);
        if (named == nullptr) return std::nullopt;
        const records::ShakeTable table = read_shake_table(find_beside(options_.file, named->file), &reading);
        return records::find_bandwidth(table.find_axis(named->axis), records::find_mass(properties.model));
    }

    const CLI::App& command_;
    const SimilitudeOptions& scales_;
    const PropertiesOptions& options_;
    double length_;
    nlohmann::ordered_json object_;
    std::vector<records::Material> presets_;
    std::optional<records::DesignLaw> law_;
    std::optional<scaling::LawFormulas> formulas_;
    std::optional<scaling::MotionProperties> measured_motion_, measured_model_motion_;
};

/// Properties whose model is shaken as it was given, or else by `shaken`.
scaling::PropertiesAndLaw with_motion(const PropertiesFiles::Read& read, const scaling::Similitude& shaken) {
    scaling::PropertiesAndLaw properties{read.pair, read.similitude};
    if (properties.properties.motion && !properties.properties.model_motion) {
        properties.properties.model_motion = to_model(*properties.properties.motion, shaken);
    }
    return properties;
}

scaling::UncertainRegimes find_uncertain_regimes(PropertiesFiles& files, const scaling::UncertainReading& reading,
                                                 const scaling::PropertiesAndLaw& properties, const scaling::KeptNumbers& kept,
                                                 const std::optional<scaling::MonteCarloSettings>& monte_carlo,
                                                 scaling::RegimeReport& report) {
    if (reading.inputs().empty() && !monte_carlo) return {};
    const auto read = [&](scaling::UncertainReading& each) { return with_motion(files.read(each), properties.similitude); };
    std::vector<scaling::MovedProperties> moved;
    for (const auto& each : scaling::read_moved(reading, read)) moved.push_back({each.below, each.above});
    scaling::UncertainRegimes uncertain = propagate(report, properties, kept, reading.inputs(), moved);
    if (monte_carlo) {
        ProgressLine progress("samples");
        const auto draw = [&](std::span<const double> values) { return scaling::read_drawn(reading, values, read); };
        add_samples(uncertain, report, properties, kept, draw, *monte_carlo, [&](double fraction) { progress.update(fraction); });
    }
    return uncertain;
}

}  // namespace

void PropertiesOptions::add_to(CLI::App& command) {
    CLI::Option* const properties = command
                                        .add_option("--properties", file,
                                                    "What is known of prototype and model (JSON, musim-properties/1; see "
                                                    "docs/user/design_files.md): reports every group of both, "
                                                    "regimes, structural speed and rocking")
                                        ->type_name("PROPERTIES.json");
    // what the properties themselves give
    for (const char* const name :
         {"--friction-prototype", "--slenderness", "--height", "--pga", "--pgv", "--pgd", "--arias", "--duration", "--time-step"}) {
        properties->excludes(name);
    }
    source.add_to(command);
    for (const char* const name : {"--dt", "--unit", "--quantity", "--sensitivity", "--station-xml"}) {
        command.get_option(name)->needs(properties);
    }
}

int run_scale_properties(const CLI::App& command, const SimilitudeOptions& scales, const PropertiesOptions& options,
                         const std::optional<scaling::MonteCarloSettings>& monte_carlo, scaling::ReportStyle style, bool json) {
    scales.note_values_used();
    PropertiesFiles files(command, scales, options);
    scaling::UncertainReading reading(options.file);
    const PropertiesFiles::Read read = files.read(reading);
    const scaling::ScaleFactors typed = scales.scales().factors(), given = make_scale_factors(read.pair, typed.length);
    require_agreement(command, options.file, "--friction", typed.friction, given.friction);
    require_agreement(command, options.file, "--gravity", typed.gravity, given.gravity);
    require_agreement(command, options.file, "--density", typed.density, given.density);
    note_overruled(files.solved());
    const scaling::PropertiesAndLaw properties = with_motion(read, read.similitude);
    const scaling::KeptNumbers kept = find_kept_numbers(files.solved());
    scaling::RegimeReport regimes = make_regime_report(properties.properties, properties.similitude, kept);
    const scaling::UncertainRegimes uncertain = find_uncertain_regimes(files, reading, properties, kept, monte_carlo, regimes);
    const PropertiesReport report{read.name, properties.properties, properties.similitude, regimes, uncertain};
    if (json) {
        print_json(to_json(report));
    } else {
        print("{}", make_properties_report(report, style));
    }
    return kDone;
}

}  // namespace musim::cli
