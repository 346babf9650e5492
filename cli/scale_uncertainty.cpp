#include "cli/scale_uncertainty.hpp"

#include <nlohmann/json.hpp>

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

std::string make_uncertain_factors(const UncertainScale& scale, scaling::ReportStyle style) {
    const scaling::UncertainReport& report = scale.report;
    std::string text = make_table(make_inputs_table(report.inputs), style) + "\n";
    if (scale.monte_carlo) text += make_paragraph(describe_samples(*scale.monte_carlo, report.rejected), style) + "\n";
    for (const auto& table : {make_results_table("factor", report.factors), make_results_table("group (1 = kept)", report.groups),
                              make_results_table("group as shaken", report.shaken)}) {
        text += make_table(table, style) + "\n";
    }
    return text;
}

std::string make_structure_and_measures(const UncertainScale& scale, scaling::ReportStyle style) {
    const scaling::UncertainReport& report = scale.report;
    std::string text;
    if (!report.structure.empty()) text += make_table(make_pairs_table("group", report.structure), style) + "\n";
    if (!report.measures.empty()) text += make_table(make_pairs_table("measure", report.measures), style) + "\n";
    return text;
}

}  // namespace musim::cli
