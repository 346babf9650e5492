#include "cli/lsdem/calibrate_tests.hpp"

#include <algorithm>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/interruption.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/progress_line.hpp"
#include "lsdem/calibration/calibration_files.hpp"
#include "lsdem/calibration/rocking_impact.hpp"
#include "scaling/json_optional.hpp"
#include "scaling/side_by_side.hpp"

namespace musim::cli {
namespace {

struct RestitutionOptions {
    TestOptions test;
    std::vector<Number> restitutions;
    std::vector<Number> angles{{6.0}, {11.0}, {22.0}};  ///< [degree]
    std::string support = "both";
    std::optional<Number> target;
    Number safety{0.2};
};

std::vector<double> to_values(const std::vector<Number>& numbers, double factor = 1.0) {
    std::vector<double> values;
    values.reserve(numbers.size());
    for (const Number& number : numbers) values.push_back(number * factor);
    return values;
}

/// A search on one curve.
struct NamedSearch {
    const lsdem::RockingCurve* curve = nullptr;
    lsdem::RestitutionSearch search;
};

nlohmann::json make_json(const lsdem::BlockSample& sample, const lsdem::RockingCurve& curve) {
    nlohmann::json points = nlohmann::json::array();
    for (std::size_t i = 0; i < curve.restitution.size(); ++i) {
        const lsdem::RockingResult& r = curve.result[i];
        points.push_back({{"restitution", curve.restitution[i]},
                          {"first", r.first},
                          {"mean", r.mean},
                          {"impacts", r.impacts},
                          {"slip_over_side", r.slip_over_side}});
    }
    const std::optional<double> paper = lsdem::find_published_ratio(curve.start);
    return {{"support", to_string(curve.support)},       {"side", to_string(curve.side)},
            {"start_deg", curve.start / kDegree},        {"housner", lsdem::housner_ratio(sample, curve.side)},
            {"published_wood", scaling::or_null(paper)}, {"points", points}};
}

void print_curves(const lsdem::BlockSample& sample, const std::vector<lsdem::RockingCurve>& curves) {
    for (const lsdem::RockingCurve& curve : curves) {
        print("\n  {} side on {}, let go at {:.4g} degrees; Housner {:.3f}", to_string(curve.side), to_string(curve.support),
              curve.start / kDegree, lsdem::housner_ratio(sample, curve.side));
        if (const auto paper = lsdem::find_published_ratio(curve.start)) print("; measured on wood by Harmon et al. about {}", *paper);
        print("\n    {:<22}", "C_res");
        for (const double e : curve.restitution) print(" {:>6.3g}", e);
        print("\n    {:<22}", "r, first impact");
        for (const lsdem::RockingResult& r : curve.result) print(" {:>6.3f}", r.first);
        print("\n    {:<22}", "r, mean of up to five");
        for (const lsdem::RockingResult& r : curve.result) print(" {:>6.3f}", r.mean);
        print("\n");
    }
}

int run_restitution(const RestitutionOptions& options) {
    std::optional<lsdem::ResultFolder> folder = options.test.make_folder(options.test.origin_with_options());
    const lsdem::BlockSample sample = options.test.sample.sample();
    lsdem::RockingSweep sweep{.restitutions = to_values(options.restitutions),
                              .angles = to_values(options.angles, kDegree),
                              .supports = {},
                              .safety = options.safety,
                              .threads = options.test.threads};
    if (sweep.restitutions.empty()) {
        for (int i = 1; i <= 9; ++i) sweep.restitutions.push_back(0.1 * i);
    }
    std::sort(sweep.restitutions.begin(), sweep.restitutions.end());
    if (options.support != "two_blocks") sweep.supports.push_back(lsdem::RockingSupport::ground);
    if (options.support != "ground") sweep.supports.push_back(lsdem::RockingSupport::two_blocks);

    std::vector<lsdem::RockingCurve> curves;
    std::vector<NamedSearch> searches;
    {
        ProgressLine progress("restitution");
        sweep.on_progress = [&](double fraction) { progress.update(fraction); };
        curves = lsdem::sweep_rocking(sample, sweep);
    }
    if (curves.empty()) throw std::invalid_argument("rocking test: at every angle the block overturns; take smaller ones");
    if (options.target) {
        ProgressLine progress("search");
        for (const lsdem::RockingCurve& curve : curves) searches.push_back({&curve, {}});
        std::vector<std::function<void()>> jobs;
        jobs.reserve(searches.size());
        for (NamedSearch& s : searches) {
            jobs.emplace_back([&] { s.search = lsdem::find_restitution(sample, *s.curve, *options.target, options.safety); });
        }
        scaling::run_side_by_side(jobs, options.test.threads, [&](double fraction) { progress.update(fraction); });
    }
    if (folder) {
        folder->add_text("restitution.csv", lsdem::make_rocking_csv(sample, curves));
        for (const lsdem::RockingSupport support : sweep.supports) {
            folder->add_text("restitution_" + to_string(support) + ".svg", lsdem::make_rocking_svg(sample, curves, support));
        }
        folder->commit();
    }

    if (options.test.json) {
        nlohmann::json list = nlohmann::json::array(), found = nlohmann::json::array();
        for (const lsdem::RockingCurve& curve : curves) list.push_back(make_json(sample, curve));
        for (const NamedSearch& s : searches) {
            found.push_back({{"support", to_string(s.curve->support)},
                             {"side", to_string(s.curve->side)},
                             {"start_deg", s.curve->start / kDegree},
                             {"lowest", s.search.lowest},
                             {"highest", s.search.highest},
                             {"restitution", scaling::or_null(s.search.restitution)},
                             {"reached", s.search.restitution ? nlohmann::json(s.search.reached) : nlohmann::json()}});
        }
        nlohmann::json object{{"material", options.test.sample.material}, {"sample", describe_sample(sample)}, {"curves", list}};
        if (options.target) object["target"] = {{"energy_ratio", options.target->value}, {"searches", found}};
        print_json(object);
        return kDone;
    }
    print("{}: rocking tests, energy ratio r after over before an impact\n", options.test.sample.material);
    print_curves(sample, curves);
    for (const NamedSearch& s : searches) {
        const std::string name =
            fmt::format("{} side on {}, {:.4g} degrees", to_string(s.curve->side), to_string(s.curve->support), s.curve->start / kDegree);
        if (s.search.restitution) {
            print("  mean r = {:.4g}, {}: C_res = {:.4f} (gives {:.4f})\n", options.target->value, name, *s.search.restitution,
                  s.search.reached);
        } else {
            print("  mean r = {:.4g}, {}: not reached by any C_res of the curve, which gives {:.3f} to {:.3f}\n", options.target->value,
                  name, s.search.lowest, s.search.highest);
        }
    }
    if (folder) print("Curves in {}\n", options.test.out);
    return kDone;
}

}  // namespace

void add_restitution_command(CLI::App& calibrate, Action& action) {
    auto options = std::make_shared<RestitutionOptions>();
    CLI::App* command = calibrate.add_subcommand("restitution", "Energy a rocking block keeps at an impact, against C_res");
    options->test.add_to(*command, "restitution.csv and a picture per support");
    add_positive_option(*command, "--restitutions", options->restitutions, "C_res to test (default: 0.1, 0.2, ... 0.9)")
        ->check(between(0.0, 1.0));
    add_positive_option(*command, "--angles", options->angles, "Tilts at which the block is let go [degrees] (default: 6 11 22)");
    command->add_option("--support", options->support, "What it rocks on")
        ->capture_default_str()
        ->check(one_of({"ground", "two_blocks", "both"}));
    add_positive_option(*command, "--target", options->target, "Wanted mean energy ratio: C_res is searched on every curve")
        ->check(between(0.0, 1.0));
    add_positive_option(*command, "--safety", options->safety, "Time step over the critical one")->default_str("0.2");
    command->footer(
        "Examples:\n"
        "  musim calibrate restitution --material wood -o out/rocking\n"
        "  musim calibrate restitution --material wood --support two_blocks --angles 22 --target 0.6\n"
        "Angles at which a side overturns are left out there. A rigid block without bounce keeps (1 - 1.5 sin^2 alpha)^2 (Housner).");
    command->callback([&action, options] { action = [options] { return run_whole([&] { return run_restitution(*options); }); }; });
}

}  // namespace musim::cli
