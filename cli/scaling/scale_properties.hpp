#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "cli/options.hpp"
#include "cli/record_source.hpp"
#include "scaling/text_table.hpp"
#include "scaling/uncertainty/monte_carlo.hpp"

namespace musim::cli {

/// Knowledge of a laboratory about prototype and model, for `musim scale`: --properties FILE (musim-properties/1), and what a record of
/// that file may leave unsaid.
struct PropertiesOptions {
    std::string file;
    RecordSourceOptions source;

    /// Adds the options to a command that has those of SimilitudeOptions, of structures and of motions.
    void add_to(CLI::App& command);

    bool is_given() const { return !file.empty(); }
};

/// Prints the report of distortions and regimes, with uncertainties where the properties have some: to first order, and by
/// samples if `monte_carlo` is given. λ_μ, λ_g and λ_ρ are those of
/// the properties, the law is theirs or the one typed; throws SimilitudeError when `command` was given others, as records::apply_law()
/// does, and what reading properties, records and tables throws. Returns an exit code.
int run_scale_properties(const CLI::App& command, const SimilitudeOptions& scales, const PropertiesOptions& options,
                         const std::optional<scaling::MonteCarloSettings>& monte_carlo, scaling::ReportStyle style, bool json);

}  // namespace musim::cli
