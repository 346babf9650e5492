#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/named_values.hpp"
#include "scaling/text_table.hpp"
#include "scaling/uncertainty/propagate.hpp"
#include "scaling/uncertainty/uncertain_similitude.hpp"

namespace musim::cli {

/// An uncertainty with two digits [JCGM100] 7.2.6 in the unit of its value; with more where two would need a power of ten.
std::string format_uncertainty(double uncertainty, double value, const scaling::RationalDimension& dimension);

/// A relative uncertainty as "7.07 %"; "-" for none.
std::string format_share(double share);

/// Samples of a quantity, and a result with its uncertainty, both given in a unit [SI].
nlohmann::json to_json(const scaling::SampleSummary& samples, double unit);
nlohmann::json to_json(const scaling::UncertainResult& result, double unit);

/// A result to first order: value, standard and relative uncertainty, the coverage interval, and the exponents of those inputs that it
/// depends on, by their names; what its samples say if there are any.
nlohmann::json to_json(const scaling::FirstOrder& result, const std::vector<scaling::UncertainInput>& inputs,
                       const scaling::SampleSummary* samples = nullptr);

/// The coverage interval of a plain number as "0.9 to 1.1", four digits, that of its samples if there are any; "-" where it is certain.
std::string describe_interval(const scaling::FirstOrder& result, const scaling::SampleSummary* samples = nullptr);

/// "95 %".
std::string coverage_title();

/// The input that contributes most to a variance, with its share: "limits: hall_height (82 %)"; "-" for a certain result.
std::string describe_main_input(const scaling::FirstOrder& result, const std::vector<scaling::UncertainInput>& inputs);

/// Results by name, with the exponents of the inputs; the inputs; how samples were drawn.
nlohmann::json to_json(const std::vector<scaling::UncertainResult>& results, const std::vector<scaling::UncertainInput>& inputs);
nlohmann::json to_json(const std::vector<scaling::UncertainInput>& inputs);
nlohmann::json to_json(const scaling::Draws& draws);

/// Everything of a report but groups and measures at both scales: inputs, factors, groups, how samples were drawn.
nlohmann::json to_json(const scaling::UncertainReport& report);

/// Groups or measures at both scales, measures under keys with their unit ("pga_g"): values alone, or with uncertainties.
nlohmann::json values_to_json(const std::vector<scaling::UncertainPair>& pairs);
nlohmann::json to_json(const std::vector<scaling::UncertainPair>& pairs);

/// The uncertain inputs.
scaling::TextTable make_inputs_table(const std::vector<scaling::UncertainInput>& inputs);

/// Factors or groups under a title, with standard uncertainty, and mean, standard deviation, median and coverage interval of the samples if
/// there are any.
scaling::TextTable make_results_table(const std::string& title, const std::vector<scaling::UncertainResult>& results);

/// Groups and measures at both scales; `first` stands before the name, such as a component.
struct UncertainPairRow {
    NamedValues first;
    const scaling::UncertainPair* pair = nullptr;
};
scaling::TextTable make_pairs_table(const std::string& title, const std::vector<UncertainPairRow>& rows);
scaling::TextTable make_pairs_table(const std::string& title, const std::vector<scaling::UncertainPair>& pairs);

/// "100000 samples, normal, seed 1; 95 % intervals; 12 draws were not positive and drawn again."
std::string describe_draws(const scaling::Draws& draws);

}  // namespace musim::cli
