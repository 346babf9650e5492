#include "cli/lsdem/calibrate_tests.hpp"

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "cli/interruption.hpp"
#include "cli/named_values.hpp"
#include "cli/output.hpp"
#include "cli/progress_line.hpp"
#include "lsdem/calibration/calibration_files.hpp"
#include "lsdem/calibration/tilt_test.hpp"
#include "scaling/side_by_side.hpp"

namespace musim::cli {
namespace {

struct FrictionOptions {
    TestOptions test;
    Number resolution{0.001};  ///< [degree]
};

/// Every block on every support, on its side and upright.
std::vector<lsdem::TiltCase> list_cases() {
    std::vector<lsdem::TiltCase> cases;
    for (const auto pose : {lsdem::TiltPose::lying, lsdem::TiltPose::upright}) {
        for (const auto support : {lsdem::TiltSupport::ground, lsdem::TiltSupport::block}) {
            for (const auto side : {lsdem::TiltSide::wide, lsdem::TiltSide::other}) cases.push_back({support, pose, side});
        }
    }
    return cases;
}

std::vector<lsdem::TiltResult> compute_tests(const FrictionOptions& options, const lsdem::BlockSample& sample,
                                             const std::vector<lsdem::TiltCase>& cases) {
    std::vector<lsdem::TiltResult> results(cases.size());
    std::vector<std::function<void()>> jobs;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        jobs.emplace_back([&, i] { results[i] = lsdem::run_tilt_test(sample, cases[i], options.resolution * kDegree); });
    }
    ProgressLine progress("friction");
    scaling::run_side_by_side(jobs, options.test.threads, [&](double fraction) { progress.update(fraction); });
    return results;
}

/// One test, its pose in front of a line.
NamedValues list_values(const lsdem::TiltCase& test, const lsdem::TiltResult& result) {
    const double angle = result.angle() / kDegree, half = 0.5 * (result.high - result.low) / kDegree;
    const auto friction = result.event == lsdem::TiltEvent::slips ? std::optional(result.friction()) : std::nullopt;
    return {{"pose", {}, to_string(test.pose)},
            {"support", "support", to_string(test.support), "", -7},
            {"downhill", "downhill", lsdem::downhill_edge(test), "", -9},
            {"event", "first", to_string(result.event), "", -8},
            {{}, "angle [deg]", fmt::format("{:.4f} +-{:.4f}", angle, half), "", 17},
            {"angle_deg", {}, angle},
            {"half_interval_deg", {}, half},
            {{}, "tan(angle)", result.friction(), ".5f", 10},
            {"friction", {}, or_null(friction)},
            {"expected_slip_deg", "atan(mu)", result.expected_slip / kDegree, ".4f", 13},
            {"expected_topple_deg", "atan(edge/h)", result.expected_fall / kDegree, ".4f", 13},
            {"expected_topple_on_springs_deg", "on springs", result.expected_fall_on_springs / kDegree, ".4f", 11}};
}

int run_friction(const FrictionOptions& options) {
    std::optional<lsdem::ResultFolder> folder = options.test.make_folder(options.test.origin_with_options());
    const lsdem::BlockSample sample = options.test.sample.sample();
    const std::vector<lsdem::TiltCase> cases = list_cases();
    const std::vector<lsdem::TiltResult> results = compute_tests(options, sample, cases);
    if (folder) {
        folder->add_text("friction.csv", lsdem::make_tilt_csv(cases, results));
        folder->commit();
    }
    std::vector<NamedValues> rows;
    rows.reserve(cases.size());
    for (std::size_t i = 0; i < cases.size(); ++i) rows.push_back(list_values(cases[i], results[i]));
    if (options.test.json) {
        print_json({{"material", options.test.sample.material}, {"sample", describe_sample(sample)}, {"tests", to_json(rows)}});
        return kDone;
    }
    print("{}: tilt tests, friction {} on blocks, {} on the ground\n", options.test.sample.material, sample.friction,
          sample.ground_friction);
    print_titles("  pose", rows.front());
    for (std::size_t i = 0; i < rows.size(); ++i) print_row("  " + to_string(cases[i].pose), rows[i]);
    return kDone;
}

}  // namespace

void add_friction_command(CLI::App& calibrate, Action& action) {
    auto options = std::make_shared<FrictionOptions>();
    CLI::App* command = calibrate.add_subcommand("friction", "Angle at which a block slips or topples");
    options->test.add_to(*command, "friction.csv");
    add_positive_option(*command, "--resolution", options->resolution, "Interval in which the angle is enclosed [degrees]")
        ->default_str("0.001");
    command->footer(
        "Examples:\n"
        "  musim calibrate friction --material wood\n"
        "  musim calibrate friction --material concrete --ground-friction 0.5 --resolution 1/100 --json\n"
        "A block lying on its largest face slips at atan(mu); one that stands upright topples first when its base is narrower than mu "
        "times\n"
        "its height. Every angle is a run of its own.");
    command->callback([&action, options] { action = [options] { return run_whole([&] { return run_friction(*options); }); }; });
}

}  // namespace musim::cli
