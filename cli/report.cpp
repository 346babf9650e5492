#include "cli/report.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/output.hpp"
#include "lsdem/results/run_warnings.hpp"
#include "lsdem/scene/motions.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "scaling/laws/model_scales.hpp"

namespace musim::cli {

nlohmann::json to_json(const std::vector<scaling::NamedFactor>& factors) {
    nlohmann::json object = nlohmann::json::object();
    for (const scaling::NamedFactor& factor : factors) object[std::string(factor.name)] = factor.value;
    return object;
}

nlohmann::json to_json(const scaling::ModelScales& scales) {
    if (scales.similitude) return lsdem::to_json(*scales.similitude);
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

scaling::TextTable make_factors_table(const std::string& title, const std::vector<scaling::NamedFactor>& factors) {
    scaling::TextTable table{{title, "value"}};
    for (const scaling::NamedFactor& factor : factors)
        table.rows.push_back({std::string(factor.name), fmt::format("{:.7g}", factor.value)});
    return table;
}

std::vector<std::string> describe_elasticity(const scaling::ModelScales& scales) {
    const double factor = scaling::find_solid_elasticity(scales);
    if (!scaling::find_severity(factor)) return {};
    return {
        fmt::format("note: elasticity of the blocks themselves is not among these groups: in the same solid E/(rho*g*l) is off by a factor "
                    "{:.4g}; it is kept by a solid with {:.4g} times the E",
                    factor, 1.0 / factor)};
}

std::vector<std::string> describe_distortions(const std::vector<scaling::Distortion>& distortions) {
    std::vector<std::string> lines;
    if (distortions.empty()) lines.emplace_back("No distortion: every known group of rigid blocks in contact is kept.");
    for (const scaling::Distortion& distortion : distortions) {
        lines.push_back(fmt::format("{}: {} is off by a factor {:.4g}: {}", scaling::to_string(distortion.severity), distortion.group,
                                    distortion.factor, distortion.effect));
    }
    return lines;
}

void print_distortions(const std::vector<scaling::Distortion>& distortions) {
    for (const std::string& line : describe_distortions(distortions)) print("{}\n", line);
}

bool report_divergence(const std::string& where, const lsdem::RunResult& run) {
    if (!run.divergence) return false;
    note("musim: error: {}: {}\n", where, lsdem::describe_divergence(run));
    return true;
}

void report_warnings(const std::string& where, const lsdem::RunResult& run) {
    for (const std::string& warning : lsdem::find_warnings(run)) note("musim: warning: {}: {}\n", where, warning);
}

void note_reading(const lsdem::Scene& scene) {
    for (const std::string& line : scene.text.notes) note_at_end(fmt::format("musim: note: {}", line));
    if (scene.text.plain_number.empty()) return;
    note_at_end(
        fmt::format("musim: note: {}: {}: a number without a unit is taken as SI, here and elsewhere in the file; write text with "
                    "a unit",
                    scene.text.origin, scene.text.plain_number));
}

lsdem::Scene read_scene(const std::filesystem::path& file) {
    lsdem::Scene scene = lsdem::read_scene(file);
    for (const std::string& remark : scene.text.remarks) note("musim: warning: {}\n", remark);
    note_reading(scene);
    return scene;
}

void note_cut_motions(const std::string& where, const lsdem::Scene& scene) {
    for (const std::string& line : lsdem::describe_cut_motions(scene)) note("musim: warning: {}: {}\n", where, line);
}

}  // namespace musim::cli
