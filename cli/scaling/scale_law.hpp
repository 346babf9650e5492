#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scaling/text_table.hpp"
#include "scaling/uncertainty/uncertain_law.hpp"

namespace musim::cli {

/// A solved law, and --value of the prototype with their uncertainties.
struct SolvedWithValues {
    scaling::SolvedLaw solved;
    std::vector<scaling::UncertainPrototype> prototype;
};

/// `musim scale` by the quantities of a law: options --hold, --watch, --define, --value, --format, --laws.
struct ScaleLawOptions {
    std::vector<std::string> held;
    std::vector<std::string> watched;
    std::vector<std::string> quantities;
    std::vector<std::string> values;
    scaling::ReportStyle style = scaling::ReportStyle::plain;
    bool lists_laws = false;

    void add_to(CLI::App& command);

    /// Whether --hold, --watch, --define or --value is given, which ask for a report by the quantities of the law.
    bool name_products() const;

    /// Solves `law` (a name or file; empty for none, quantities then come from --define and, by their usual names, from mechanics) with
    /// the given factors. Throws scaling::SimilitudeError, CLI::ValidationError for a malformed option.
    SolvedWithValues solve(const std::string& law, const std::vector<scaling::GivenFactor>& given) const;
};

/// Lists the laws that come with musim, as a table or as JSON.
int list_scale_laws(scaling::ReportStyle style, bool json);

/// Solves, propagates the uncertainties of factors and values if there are any, and prints in the wanted form. Throws
/// scaling::SimilitudeError as scaling::propagate() does, and when samples are wanted and nothing is uncertain.
int run_scale_law(const ScaleLawOptions& options, const std::string& law, const std::vector<scaling::UncertainFactor>& given,
                  const std::optional<scaling::MonteCarloSettings>& monte_carlo, bool json);

}  // namespace musim::cli
