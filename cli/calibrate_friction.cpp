#include "cli/calibrate_tests.hpp"

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "cli/interruption.hpp"
#include "cli/output.hpp"
#include "cli/progress_line.hpp"
#include "lsdem/study/calibration_files.hpp"
#include "lsdem/study/tilt_test.hpp"
#include "scaling/side_by_side.hpp"

namespace musim::cli {
namespace {

namespace study = lsdem::study;

struct FrictionOptions {
    TestOptions test;
    Number resolution{0.001};  ///< [degree]
};

int run_friction(const FrictionOptions& options) {
    std::optional<study::ResultFolder> folder = options.test.make_folder();
    const study::BlockSample sample = options.test.sample.sample();
    std::vector<study::TiltCase> cases;
    for (const auto pose : {study::TiltPose::lying, study::TiltPose::upright}) {
        for (const auto support : {study::TiltSupport::ground, study::TiltSupport::block}) {
            for (const auto side : {study::TiltSide::wide, study::TiltSide::other}) cases.push_back({support, pose, side});
        }
    }
    std::vector<study::TiltResult> results(cases.size());
    std::vector<std::function<void()>> jobs;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        jobs.emplace_back([&, i] { results[i] = study::run_tilt_test(sample, cases[i], options.resolution * kDegree); });
    }
    {
        ProgressLine progress("friction");
        scaling::run_side_by_side(jobs, options.test.threads, [&](double fraction) { progress.update(fraction); });
    }
    if (folder) {
        folder->add_text("friction.csv", study::make_tilt_csv(cases, results));
        folder->commit();
    }

    if (options.test.json) {
        nlohmann::json list = nlohmann::json::array();
        for (std::size_t i = 0; i < cases.size(); ++i) {
            const study::TiltResult& r = results[i];
            list.push_back({{"pose", to_string(cases[i].pose)},
                            {"support", to_string(cases[i].support)},
                            {"downhill", study::downhill_edge(cases[i])},
                            {"event", to_string(r.event)},
                            {"angle_deg", r.angle() / kDegree},
                            {"half_interval_deg", 0.5 * (r.high - r.low) / kDegree},
                            {"friction", r.event == study::TiltEvent::slips ? nlohmann::json(r.friction()) : nlohmann::json()},
                            {"expected_slip_deg", r.expected_slip / kDegree},
                            {"expected_topple_deg", r.expected_fall / kDegree}});
        }
        print_json({{"material", options.test.sample.material}, {"sample", describe_sample(sample)}, {"tests", list}});
    } else {
        print("{}: tilt tests, friction {} on blocks, {} on the ground\n", options.test.sample.material, sample.friction,
              sample.ground_friction);
        print("  {:<8} {:<7} {:<9} {:<8} {:>17} {:>10}   {:>11} {:>13}\n", "pose", "support", "downhill", "first", "angle [deg]",
              "tan(angle)", "atan(mu)", "atan(edge/h)");
        for (std::size_t i = 0; i < cases.size(); ++i) {
            const study::TiltResult& r = results[i];
            print("  {:<8} {:<7} {:<9} {:<8} {:>8.4f} +-{:.4f} {:>10.5f}   {:>11.4f} {:>13.4f}\n", to_string(cases[i].pose),
                  to_string(cases[i].support), study::downhill_edge(cases[i]), to_string(r.event), r.angle() / kDegree,
                  0.5 * (r.high - r.low) / kDegree, r.friction(), r.expected_slip / kDegree, r.expected_fall / kDegree);
        }
    }
    return kDone;
}

}  // namespace

void add_friction_command(CLI::App& calibrate, Action& action) {
    auto options = std::make_shared<FrictionOptions>();
    CLI::App* command = calibrate.add_subcommand("friction", "Angle at which a block slips or topples");
    options->test.add_to(*command, "friction.csv");
    command->add_option("--resolution", options->resolution, "Interval in which the angle is enclosed [degrees]")
        ->default_str("0.001")
        ->type_name("NUMBER")
        ->check(above_zero());
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
