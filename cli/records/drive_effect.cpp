#include "cli/records/drive_effect.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/named_values.hpp"
#include "cli/output.hpp"
#include "cli/records/record_peaks.hpp"
#include "records/measures/response_spectrum.hpp"

namespace musim::cli {
namespace {

using BeforeAndAfter = std::pair<std::optional<double>, std::optional<double>>;

BeforeAndAfter find_pga(const DriveEffect& effect) {
    const double g = scaling::kStandardGravity.value();
    return {size_of(effect.before.pga, g), size_of(effect.after.pga, g)};
}

BeforeAndAfter find_pgv(const DriveEffect& effect) { return {size_of(effect.before.pgv, 0.01), size_of(effect.after.pgv, 0.01)}; }

BeforeAndAfter find_pgd(const DriveEffect& effect) { return {size_of(effect.before.pgd, 0.01), size_of(effect.after.pgd, 0.01)}; }

std::optional<double> find_mean_psa_factor(const records::TimeSeries& before, const records::TimeSeries& after,
                                           std::span<const scaling::Time> periods) {
    if (before.quantity() != records::SampleQuantity::acceleration || periods.empty()) return std::nullopt;
    const auto psa = [&](const records::TimeSeries& series) {
        return records::compute_response_spectrum(series, periods).pseudo_acceleration();
    };
    const std::vector<double> one = psa(before), two = psa(after);
    double sum = 0.0;
    for (std::size_t i = 0; i < periods.size(); ++i) sum += std::abs(std::log(two[i] / one[i]));
    const double factor = std::exp(sum / static_cast<double>(periods.size()));
    return std::isfinite(factor) ? std::optional(factor) : std::nullopt;
}

nlohmann::json to_pair(const BeforeAndAfter& pair) { return nlohmann::json::array({or_null(pair.first), or_null(pair.second)}); }

}  // namespace

std::vector<DriveEffect> find_drive_effects(const records::GroundMotion& model, const records::DriveSettings& settings,
                                            std::span<const scaling::Time> periods) {
    const std::vector<records::DriveMotion> motions = records::make_drive_motions(model, settings);
    std::vector<DriveEffect> effects;
    for (std::size_t c = 0; c < motions.size(); ++c) {
        const records::TimeSeries& series = model.components[c].series;
        const auto& corner = model.integration_corner;
        records::Intensity after;
        after.pga = records::find_peak_acceleration(motions[c].acceleration);
        after.pgv = records::find_peak_velocity(motions[c].velocity);
        after.pgd = records::find_peak_displacement(motions[c].displacement);
        effects.push_back({model.components[c].name, records::compute_intensity(series, corner), after,
                           find_mean_psa_factor(records::level_uncorrected(series, corner), motions[c].acceleration, periods)});
    }
    return effects;
}

void print_drive_effects(const std::vector<DriveEffect>& effects) {
    print(
        "The table's motion is the model's record tapered over {:g} % of its length at each end, filtered and scaled as said, and "
        "corrected\n"
        "to end at rest. From the record to the table:\n",
        100.0 * records::kDefaultTaper);
    for (const DriveEffect& effect : effects) {
        const auto change = [](const BeforeAndAfter& pair) { return or_dash(pair.first, 4) + " -> " + or_dash(pair.second, 4); };
        print("  {}: PGA {} g, PGV {} cm/s, PGD {} cm{}\n", effect.component, change(find_pga(effect)), change(find_pgv(effect)),
              change(find_pgd(effect)),
              effect.mean_psa_factor ? fmt::format("; PSA by a factor {:.4g} on average", *effect.mean_psa_factor) : "");
    }
}

nlohmann::json to_json(const std::vector<DriveEffect>& effects) {
    nlohmann::json list = nlohmann::json::array();
    for (const DriveEffect& effect : effects) {
        list.push_back({{"component", effect.component},
                        {"pga_g", to_pair(find_pga(effect))},
                        {"pgv_cm_s", to_pair(find_pgv(effect))},
                        {"pgd_cm", to_pair(find_pgd(effect))},
                        {"mean_psa_factor", or_null(effect.mean_psa_factor)}});
    }
    return list;
}

}  // namespace musim::cli
