#include "cli/report.hpp"

#include <nlohmann/json.hpp>

#include "cli/output.hpp"
#include "lsdem/study/verdict.hpp"

namespace musim::cli {

nlohmann::json to_json(const std::vector<scaling::NamedFactor>& factors) {
    nlohmann::json object = nlohmann::json::object();
    for (const scaling::NamedFactor& factor : factors) object[std::string(factor.name)] = factor.value;
    return object;
}

scaling::TextTable make_factors_table(const std::string& title, const std::vector<scaling::NamedFactor>& factors) {
    scaling::TextTable table{{title, "value"}};
    for (const scaling::NamedFactor& factor : factors)
        table.rows.push_back({std::string(factor.name), fmt::format("{:.7g}", factor.value)});
    return table;
}

std::vector<std::string> describe_distortions(const std::vector<scaling::Distortion>& distortions) {
    if (distortions.empty()) return {"No distortion: every known group is kept."};
    std::vector<std::string> lines;
    for (const scaling::Distortion& distortion : distortions) {
        lines.push_back(fmt::format("{}: {} is off by a factor {:.4g}: {}", scaling::to_string(distortion.severity), distortion.group,
                                    distortion.factor, distortion.effect));
    }
    return lines;
}

void print_distortions(const std::vector<scaling::Distortion>& distortions) {
    for (const std::string& line : describe_distortions(distortions)) print("{}\n", line);
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
