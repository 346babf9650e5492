#include "cli/scale_uncertainty.hpp"

#include <nlohmann/json.hpp>

#include "cli/output.hpp"
#include "cli/uncertainty_output.hpp"

namespace musim::cli {

UncertainScale find_uncertain_scale(const SimilitudeOptions& factors, const UncertainStructureOptions& structure,
                                    const scaling::UncertainMotion& motion, const scaling::ModelFacts& facts,
                                    const std::optional<scaling::MonteCarloSettings>& monte_carlo) {
    scaling::UncertainScales scales = factors.scales();
    structure.put_into(scales);
    scales.motion = motion;
    return {scaling::propagate(scales, factors.make_scales(), facts, monte_carlo), monte_carlo};
}

void add_to_json(nlohmann::json& object, const UncertainScale& scale) {
    const scaling::UncertainReport& report = scale.report;
    if (!report.structure.empty()) object["structure"] = values_to_json(report.structure);
    if (!report.measures.empty()) object["measures"] = values_to_json(report.measures);
    if (!scale.is_uncertain()) return;
    nlohmann::json uncertainty = to_json(report, scale.monte_carlo);
    uncertainty["structure"] = to_json(report.structure);
    uncertainty["measures"] = to_json(report.measures);
    object["uncertainty"] = uncertainty;
}

void print_uncertain_factors(const UncertainScale& scale) {
    const scaling::UncertainReport& report = scale.report;
    print("{}\n", to_plain_text(make_inputs_table(report.inputs)));
    if (scale.monte_carlo) print("{}\n\n", describe_samples(*scale.monte_carlo, report.rejected));
    print("{}\n", to_plain_text(make_results_table("factor", report.factors)));
    print("{}\n", to_plain_text(make_results_table("group (1 = kept)", report.groups)));
    print("{}\n", to_plain_text(make_results_table("group as shaken", report.shaken)));
}

void print_structure_and_measures(const UncertainScale& scale) {
    const scaling::UncertainReport& report = scale.report;
    if (!report.structure.empty()) print("{}\n", to_plain_text(make_pairs_table("group", report.structure)));
    if (!report.measures.empty()) print("{}\n", to_plain_text(make_pairs_table("measure", report.measures)));
}

}  // namespace musim::cli
