#include "cli/report.hpp"

#include <nlohmann/json.hpp>

#include "cli/output.hpp"

namespace musim::cli {

nlohmann::json to_json(const std::vector<scaling::NamedFactor>& factors) {
    nlohmann::json object = nlohmann::json::object();
    for (const scaling::NamedFactor& factor : factors) object[std::string(factor.name)] = factor.value;
    return object;
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
    const bool is_energy = run.divergence->kind == lsdem::Divergence::Kind::energy_out_of_bounds;
    note("musim: error: {}: diverged at {:.6g} s, block {} ({}); take a smaller time step (\"step\": \"auto\", or a lower \"safety\")\n",
         where, run.divergence->time, run.divergence->block, is_energy ? "more energy than was put in" : "its state is not finite");
    return true;
}

}  // namespace musim::cli
