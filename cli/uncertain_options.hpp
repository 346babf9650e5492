#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scaling/structures/distortion.hpp"
#include "scaling/uncertain.hpp"
#include "scaling/uncertainty/monte_carlo.hpp"
#include "scaling/uncertainty/uncertain_similitude.hpp"

namespace musim::cli {

/// A scale factor, model/prototype, with or without an uncertainty. Throws scaling::ParseError, also for one that is not above zero.
scaling::UncertainRatio parse_factor(const std::string& text);

/// Options that take values above zero with standard uncertainties; errors name the option.
CLI::Option* add_uncertain_option(CLI::App& command, const std::string& name, scaling::UncertainRatio& ratio, const std::string& help);
CLI::Option* add_uncertain_option(CLI::App& command, const std::string& name, std::optional<scaling::Uncertain>& number,
                                  const std::string& help);
/// Several numbers, in one option or in several.
CLI::Option* add_uncertain_option(CLI::App& command, const std::string& name, std::vector<scaling::Uncertain>& numbers,
                                  const std::string& help);

/// Knowledge of the prototype's blocks, as options --friction-prototype, --slenderness, --height.
void add_structure_options(CLI::App& command, scaling::UncertainScales& scales);
/// The values of these.
scaling::ModelProperties structure_of(const scaling::UncertainScales& scales);

/// Measures of the prototype's motion, as options --pga, --pgv, --pgd, --arias, --duration, --time-step.
void add_motion_options(CLI::App& command, scaling::UncertainMotion& motion);

/// Whether and how to draw samples, as options --monte-carlo, --seed, --distribution.
struct MonteCarloOptions {
    bool wanted = false;
    scaling::MonteCarloSettings settings;
    std::string distribution{scaling::to_string(settings.distribution)};

    void add_to(CLI::App& command);

    /// None unless wanted. Throws scaling::SimilitudeError for an unknown distribution.
    std::optional<scaling::MonteCarloSettings> make() const;
};

}  // namespace musim::cli
