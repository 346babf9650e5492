#include "cli/records/rescale_uncertainty.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/output.hpp"
#include "cli/scaling/uncertainty_output.hpp"
#include "records/measures/intensity.hpp"
#include "records/processing/scale_record.hpp"

namespace musim::cli {
namespace {

template <class Quantity>
Quantity magnitude(const records::Peak<Quantity>& peak) {
    return Quantity::from_value(std::abs(peak.value.value()));
}

/// What a component measures; exact, as the record is what is rescaled.
scaling::UncertainMotion measure_component(const records::GroundMotion& motion, const records::Component& component) {
    const records::Intensity intensity = records::compute_intensity(component.series, motion.integration_corner);
    scaling::UncertainMotion measures;
    measures.direction = find_shaking(component);
    if (intensity.pga) measures.pga = {magnitude(*intensity.pga)};
    if (intensity.pgv) measures.pgv = {magnitude(*intensity.pgv)};
    if (intensity.pgd) measures.pgd = {magnitude(*intensity.pgd)};
    if (intensity.arias) measures.arias = {*intensity.arias};
    measures.duration = {component.series.duration()};
    measures.time_step = {component.series.dt()};
    return measures;
}

/// The measures or groups of all components in one table.
using Pairs = std::vector<scaling::UncertainPair> scaling::UncertainReport::*;

void print_pairs(const UncertainRescale& rescale, const std::string& title, Pairs pairs) {
    std::vector<UncertainPairRow> rows;
    for (std::size_t c = 0; c < rescale.reports.size(); ++c) {
        const NamedValues component{{{}, "component", rescale.components[c]}};
        for (const scaling::UncertainPair& pair : rescale.reports[c].*pairs) rows.push_back({component, &pair});
    }
    if (!rows.empty()) print("\n{}", to_plain_text(make_pairs_table(title, rows)));
}

}  // namespace

UncertainRescale find_uncertain_rescale(const records::GroundMotion& prototype, const SimilitudeOptions& factors,
                                        const UncertainStructureOptions& structure,
                                        const std::optional<scaling::MonteCarloSettings>& monte_carlo) {
    UncertainRescale rescale;
    scaling::UncertainScales scales = factors.scales();
    structure.put_into(scales);
    if (!scales.is_uncertain() && !structure.any() && !monte_carlo) return rescale;
    const scaling::MakeModelScales make_scales = factors.make_scales();
    for (const records::Component& component : prototype.components) {
        scales.motion = measure_component(prototype, component);
        rescale.components.push_back(component.name);
        rescale.reports.push_back(scaling::propagate(scales, make_scales, {}, monte_carlo));
    }
    return rescale;
}

void add_to_json(nlohmann::json& object, const UncertainRescale& rescale) {
    if (rescale.reports.empty()) return;
    nlohmann::json uncertainty = to_json(rescale.reports.front());
    uncertainty["components"] = nlohmann::json::array();
    for (std::size_t c = 0; c < rescale.reports.size(); ++c) {
        const scaling::UncertainReport& report = rescale.reports[c];
        uncertainty["components"].push_back(
            {{"component", rescale.components[c]}, {"measures", to_json(report.measures)}, {"structure", to_json(report.structure)}});
    }
    object["uncertainty"] = uncertainty;
}

void print_uncertain_rescale(const UncertainRescale& rescale) {
    if (rescale.reports.empty()) return;
    const scaling::UncertainReport& report = rescale.reports.front();
    if (!report.inputs.empty()) print("\n{}", to_plain_text(make_inputs_table(report.inputs)));
    if (report.draws) print("\n{}\n", describe_draws(*report.draws));
    print_pairs(rescale, "measure", &scaling::UncertainReport::measures);
    print_pairs(rescale, "group", &scaling::UncertainReport::structure);
}

}  // namespace musim::cli
