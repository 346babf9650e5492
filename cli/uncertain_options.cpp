#include "cli/uncertain_options.hpp"

#include <fmt/format.h>

#include <CLI/Error.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>

#include "cli/options.hpp"
#include "cli/whole_option.hpp"
#include "scaling/number.hpp"
#include "scaling/unlikely.hpp"

namespace musim::cli {
namespace {

/// An option whose texts `read` takes; its errors begin with the option's name.
template <class Read>
CLI::Option* add_read_option(CLI::App& command, const std::string& name, const std::string& help, const char* type, const Read& read) {
    const auto take = [name, read](const CLI::results_t& texts) {
        try {
            for (const std::string& text : texts) read(text);
        } catch (const scaling::ParseError& error) {
            throw CLI::ConversionError(name + ": " + error.what());
        }
        return true;
    };
    return command.add_option(name, CLI::callback_t(take), help)->type_name(type);
}

void require_above_zero(double value, const std::string& text) {
    if (value > 0.0) return;
    throw scaling::ParseError(fmt::format("\"{}\": the value must be positive; correct it, or leave the option out", text));
}

/// A number above zero.
scaling::Uncertain parse_positive(const std::string& text) {
    const scaling::Uncertain number = scaling::parse_uncertain(text);
    require_above_zero(number.value, text);
    return number;
}

template <class Quantity>
void add_quantity_option(CLI::App& command, const std::string& name, std::optional<scaling::UncertainQuantity<Quantity>>& quantity,
                         const std::string& help, const char* type) {
    add_read_option(command, name, help, type, [&quantity](const std::string& text) {
        quantity = scaling::parse_uncertain_quantity<Quantity>(text);
        require_above_zero(quantity->value.value(), text);
    });
}

}  // namespace

scaling::UncertainRatio parse_factor(const std::string& text) {
    const scaling::UncertainRatio factor = scaling::parse_uncertain_ratio(text);
    require_above_zero(factor.value(), text);
    return factor;
}

CLI::Option* add_uncertain_option(CLI::App& command, const std::string& name, scaling::UncertainRatio& ratio, const std::string& help) {
    return add_read_option(command, name, help, "NUMBER", [&ratio](const std::string& text) { ratio = parse_factor(text); });
}

CLI::Option* add_uncertain_option(CLI::App& command, const std::string& name, std::optional<scaling::Uncertain>& number,
                                  const std::string& help) {
    return add_read_option(command, name, help, "NUMBER", [&number](const std::string& text) { number = parse_positive(text); });
}

CLI::Option* add_uncertain_option(CLI::App& command, const std::string& name, std::vector<scaling::Uncertain>& numbers,
                                  const std::string& help) {
    return add_read_option(command, name, help, "NUMBER", [&numbers](const std::string& text) { numbers.push_back(parse_positive(text)); })
        ->expected(1, CLI::detail::expected_max_vector_size)
        ->allow_extra_args();
}

void add_structure_options(CLI::App& command, scaling::UncertainScales& scales) {
    add_uncertain_option(
        command, "--friction-prototype", scales.friction_prototype,
        "Friction coefficient of the prototype, to distinguish sliding from rocking (default: below the / of --friction, if in "
        "brackets)");
    add_uncertain_option(command, "--slenderness", scales.slenderness, "Width/height of the blocks; repeat for several directions");
    add_quantity_option(command, "--height", scales.height, "Height of the prototype, for its mu number", "LENGTH");
}

scaling::ModelProperties structure_of(const scaling::UncertainScales& scales) {
    scaling::ModelProperties properties;
    if (scales.friction_prototype) {
        properties.friction_prototype = scales.friction_prototype->value;
        note_unlikely("--friction-prototype", scaling::describe_unlikely_friction(scales.friction_prototype->value));
    }
    for (const scaling::Uncertain& each : scales.slenderness) properties.slenderness.push_back(each.value);
    return properties;
}

void add_motion_options(CLI::App& command, scaling::UncertainMotion& motion) {
    add_quantity_option(command, "--pga", motion.pga, "Peak acceleration of the prototype's motion, e.g. 0.511g", "ACCELERATION");
    add_quantity_option(command, "--pgv", motion.pgv, "Peak velocity of it, e.g. \"42.4+/-0.4 cm/s\"", "VELOCITY");
    add_quantity_option(command, "--pgd", motion.pgd, "Peak displacement of it", "LENGTH");
    add_quantity_option(command, "--arias", motion.arias, "Arias intensity of it, e.g. \"2.1 m/s\"", "VELOCITY");
    add_quantity_option(command, "--duration", motion.duration, "Duration of it", "TIME");
    add_quantity_option(command, "--time-step", motion.time_step, "Time step of its record", "TIME");
}

void MonteCarloOptions::add_to(CLI::App& command) {
    const auto take_samples = [this](const std::string& text) {
        wanted = true;
        if (!text.empty()) settings.samples = parse_whole(text, {scaling::kFewestSamples, scaling::kMostSamples});
    };
    CLI::Option* samples =
        add_read_option(command, "--monte-carlo", fmt::format("Also draw N samples of the uncertain inputs (default {})", settings.samples),
                        "N", take_samples)
            ->expected(0, 1);
    add_whole_option(command, "--seed", settings.seed, fmt::format("Seed of the samples (default {})", settings.seed))
        ->type_name("S")
        ->needs(samples);
    command
        .add_option("--distribution", distribution,
                    fmt::format("Of the inputs: normal, lognormal or uniform, with the value as mean and the uncertainty as standard "
                                "deviation (default {})",
                                distribution))
        ->type_name("NAME")
        ->check(one_of({"normal", "lognormal", "uniform"}))
        ->needs(samples);
}

std::optional<scaling::MonteCarloSettings> MonteCarloOptions::make() const {
    if (!wanted) return std::nullopt;
    scaling::MonteCarloSettings made = settings;
    made.distribution = scaling::parse_distribution(distribution);
    return made;
}

}  // namespace musim::cli
