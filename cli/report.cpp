#include "cli/report.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/output.hpp"
#include "lsdem/study/verdict.hpp"

namespace musim::cli {

nlohmann::json to_json(const std::vector<scaling::NamedFactor>& factors) {
    nlohmann::json object = nlohmann::json::object();
    for (const scaling::NamedFactor& factor : factors) object[std::string(factor.name)] = factor.value;
    return object;
}

nlohmann::json to_json(const scaling::ModelScales& scales) {
    if (scales.similitude) return study::to_json(*scales.similitude);
    return {{"law", scales.law},
            {"chosen", {{scales.length_name, scales.height}, {"friction", scales.friction}, {"gravity", scales.gravity}}},
            {"factors", to_json(scales.factors())}};
}

std::string describe_lengths(const scaling::ModelScales& scales) {
    if (scales.similitude) return "";
    return fmt::format("height {} {:.7g}, width {:.7g}, ", scales.length_name, scales.height, scales.width);
}

std::string describe_vertical(const std::vector<std::string>& components, const scaling::ModelScales& scales) {
    const auto is_one = [](double factor) { return std::abs(factor - 1.0) <= scaling::kFactorRounding; };
    if (components.empty() || is_one(scales.acceleration_vertical / scales.acceleration)) return "";
    const double shaking = scales.acceleration_vertical / scales.gravity;
    return fmt::format("Vertical component {}: displacement {:.7g}, velocity {:.7g}, acceleration {:.7g}, which {}\n",
                       fmt::join(components, ", "), scales.displacement_vertical, scales.velocity_vertical, scales.acceleration_vertical,
                       is_one(shaking) ? "keeps a_vertical/g" : fmt::format("changes a_vertical/g by {:.7g}", shaking));
}

void print_factors(const std::string& title, const std::vector<scaling::NamedFactor>& factors) {
    print("{:<26} {:>14}\n", title, "value");
    for (const scaling::NamedFactor& factor : factors) print("{:<26} {:>14.7g}\n", factor.name, factor.value);
}

void print_distortions(const std::vector<scaling::Distortion>& distortions) {
    if (distortions.empty()) {
        print("No distortion: every known group is kept.\n");
        return;
    }
    for (const scaling::Distortion& distortion : distortions) {
        print("{}: {} is off by a factor {:.4g}: {}\n", scaling::to_string(distortion.severity), distortion.group, distortion.factor,
              distortion.effect);
    }
}

bool report_divergence(const std::string& where, const study::RunResult& run) {
    if (!run.divergence) return false;
    note("musim: error: {}: {}\n", where, study::describe_divergence(run));
    return true;
}

void report_doubts(const std::string& where, const study::RunResult& run) {
    for (const std::string& doubt : study::find_doubts(run)) note("musim: warning: {}: {}\n", where, doubt);
}

}  // namespace musim::cli
