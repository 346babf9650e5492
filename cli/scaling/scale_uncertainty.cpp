#include "cli/scaling/scale_uncertainty.hpp"

#include <nlohmann/json.hpp>

#include "cli/scaling/uncertainty_output.hpp"

namespace musim::cli {

scaling::UncertainReport find_uncertain_scale(const SimilitudeOptions& factors, const UncertainStructureOptions& structure,
                                              const scaling::UncertainMotion& motion, const scaling::ModelProperties& properties,
                                              const std::optional<scaling::MonteCarloSettings>& monte_carlo) {
    scaling::UncertainScales scales = factors.scales();
    structure.put_into(scales);
    scales.motion = motion;
    return scaling::propagate(scales, factors.make_scales(), properties, monte_carlo);
}

void add_to_json(nlohmann::json& object, const scaling::UncertainReport& report) {
    if (!report.structure.empty()) object["structure"] = values_to_json(report.structure);
    if (!report.measures.empty()) object["measures"] = values_to_json(report.measures);
    if (report.is_certain()) return;
    nlohmann::json uncertainty = to_json(report);
    uncertainty["structure"] = to_json(report.structure);
    uncertainty["measures"] = to_json(report.measures);
    object["uncertainty"] = uncertainty;
}

std::string make_uncertain_factors(const scaling::UncertainReport& report, scaling::ReportStyle style) {
    std::string text = make_table(make_inputs_table(report.inputs), style) + "\n";
    if (report.draws) text += make_paragraph(describe_draws(*report.draws), style) + "\n";
    for (const auto& table : {make_results_table("factor", report.factors), make_results_table("group (1 = kept)", report.groups),
                              make_results_table("group as shaken", report.shaken)}) {
        text += make_table(table, style) + "\n";
    }
    return text;
}

std::string make_structure_and_measures(const scaling::UncertainReport& report, scaling::ReportStyle style) {
    std::string text;
    if (!report.structure.empty()) text += make_table(make_pairs_table("group", report.structure), style) + "\n";
    if (!report.measures.empty()) text += make_table(make_pairs_table("measure", report.measures), style) + "\n";
    return text;
}

}  // namespace musim::cli
