#include "lsdem/study/tilt.hpp"

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "cli/commands.hpp"
#include "cli/interruption.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/progress_line.hpp"
#include "cli/report.hpp"
#include "cli/result_options.hpp"
#include "cli/whole_option.hpp"
#include "lsdem/results/write_results.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "scaling/angle.hpp"

namespace musim::cli {
namespace {

using scaling::kDegree;

/// An angle on the command line [rad]: a Number with "deg" or "rad", without a unit in degrees.
struct Angle {
    double value = 0.0;
};

/// Reads an Angle for CLI11. Throws CLI::ConversionError.
bool lexical_cast(const std::string& text, Angle& angle) {
    const auto ends_in = [&](const std::string& unit) { return text.size() > unit.size() && text.ends_with(unit); };
    const bool in_radians = ends_in("rad");
    Number number;
    if (!lexical_cast(in_radians || ends_in("deg") ? text.substr(0, text.size() - 3) : text, number)) return false;
    angle.value = number * (in_radians ? 1.0 : kDegree);
    return true;
}

struct TiltOptions : ResultOptions {
    std::string scene;
    std::string about;  ///< empty: that of the scene's own tilt, or y
    Angle step{2.0 * kDegree}, until{60.0 * kDegree}, tolerance{0.1 * kDegree};
};

lsdem::Vector3 parse_axis(const std::string& text) {
    for (const int i : {0, 1}) {
        const std::string name(1, "xy"[i]);
        if (text == name || text == "+" + name) return lsdem::Vector3::Unit(i);
        if (text == "-" + name) return -lsdem::Vector3::Unit(i);
    }
    Angle angle;
    try {
        lexical_cast(text, angle);
    } catch (const CLI::ConversionError&) {
        throw CLI::ValidationError("--about", "'" + text + "' is neither x, y, -x or -y nor an angle from x, such as 30deg");
    }
    return {std::cos(angle.value), std::sin(angle.value), 0.0};
}

lsdem::TiltSettings find_settings(const TiltOptions& options, const lsdem::Scene& scene) {
    const auto* const tilt = std::get_if<lsdem::TiltMotion>(&scene.base_motion.source);
    const std::string about = !options.about.empty() ? options.about : tilt != nullptr ? lsdem::kMotionAxes.at(tilt->about) : "y";
    lsdem::TiltSettings settings{
        .axis = parse_axis(about), .step = options.step.value, .until = options.until.value, .tolerance = options.tolerance.value};
    if (const std::string why = lsdem::check_tilt(settings); !why.empty()) throw CLI::ValidationError("musim tilt", why);
    return settings;
}

int run_tilt(const TiltOptions& options) {
    const lsdem::Scene scene = read_scene(options.scene);
    const lsdem::TiltSettings settings = find_settings(options, scene);
    lsdem::check_scene(scene, options.scene);
    lsdem::ResultOrigin origin = options.origin_with_options();
    origin.add(scene);
    std::optional<lsdem::ResultFolder> folder = options.make_folder(std::move(origin));
    std::optional<lsdem::TiltCollapse> result;
    {
        ProgressInParts progress(scene.name);
        result = lsdem::find_tilt_of_collapse(scene, settings, {.threads = options.threads, .observer = progress.observer()});
    }
    if (result->divergence) {
        note("musim: error: {}: the run diverged at {:.4g} degrees, block {} first; take a smaller \"safety\"\n", options.scene,
             result->tries.back().angle / kDegree, result->divergence->block);
        return kNumericalFailure;
    }
    if (folder) {
        folder->add_json("tilt.json", lsdem::to_json(*result));
        if (result->fall) folder->add_text("mechanism.svg", lsdem::make_fall_svg(*result, scene.name));
        folder->commit();
    }
    if (options.json) {
        print_json(lsdem::to_json(*result));
        return kDone;
    }
    print("{}\n", scene.name);
    for (const std::string& line : lsdem::describe(*result)) print("  {}\n", line);
    print("{}\n", folder ? "Results in " + options.out : "No file of it is kept; -o DIR keeps results");
    return kDone;
}

}  // namespace

void add_tilt_command(CLI::App& app, Action& action) {
    auto options = std::make_shared<TiltOptions>();
    CLI::App* command = app.add_subcommand("tilt", "Angle at which a structure collapses on a tilting table, and how");
    command->add_option("scene", options->scene, "Scene file (JSON, schema musim-scene/1) without a base motion, or with \"tilt\"")
        ->required()
        ->type_name("SCENE.json");
    command
        ->add_option("--about", options->about,
                     "Axis about which the ground is tilted: x, y, -x, -y, or its angle from x; default: the scene's, or y")
        ->type_name("AXIS");
    command->add_option("--step", options->step, "First step of the angle [degrees]; halved where the structure falls")
        ->default_str("2deg")
        ->type_name("ANGLE");
    command->add_option("--until", options->until, "Largest angle [degrees]")->default_str("60deg")->type_name("ANGLE");
    command->add_option("--tolerance", options->tolerance, "Interval in which the angle is enclosed [degrees]")
        ->default_str("0.1deg")
        ->type_name("ANGLE");
    options->add_out(*command, "Directory for tilt.json and mechanism.svg");
    options->add_to(*command);
    command->footer(
        "Examples:\n"
        "  musim tilt examples/tilted_wall.json --about x\n"
        "  musim tilt examples/tilted_wall.json --about 30deg --tolerance 1/20 -o out/tilt\n"
        "The ground is turned step by step and held after each. The structure stands where nothing has fallen and nothing moves on;\n"
        "where it falls, the last state in which it stood goes on by half the step. Positive turns about y lower the side of +x,\n"
        "about x that of -y. The mechanism is read off the joints once one has opened or slipped by an eighth of a block.");
    command->callback([&action, options] { action = [options] { return run_whole([&] { return run_tilt(*options); }); }; });
}

}  // namespace musim::cli
