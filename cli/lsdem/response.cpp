#include "lsdem/response/response.hpp"

#include <algorithm>
#include <array>
#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/lsdem/field_options.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "lsdem/response/field_picture.hpp"
#include "lsdem/results/write_results.hpp"
#include "scaling/angle.hpp"

namespace musim::cli {
namespace {

using scaling::kDegree;

struct ResponseOptions {
    std::string directory;
    std::string out;
    std::string axis;
    Number threshold{0.1};
    std::vector<Number> window;
    std::vector<Number> fields;  ///< times [s]
    FieldOptions look;
    bool json = false;
};

void print_losses(const lsdem::Damage& damage) {
    if (!damage.loss) {
        print("\n  energy dissipated per level: not in these results; run the scene again\n");
        return;
    }
    print("\n  energy dissipated: friction {:.4g} J, damping {:.4g} J\n", damage.loss->friction, damage.loss->damping);
    print("  below level: {:>14} {:>14} {:>8}\n", "friction [J]", "damping [J]", "share");
    for (const lsdem::LevelDamage& l : damage.levels) {
        print("  {:>11}  {:>14.4g} {:>14.4g} {:>7.2f}%\n", l.level, l.loss->friction, l.loss->damping,
              100.0 * lsdem::find_loss_share(l, damage));
    }
}

void print_response(const lsdem::Response& r) {
    print("{}: motion along {}, {}\n", lsdem::to_string(r.status), lsdem::axis_name(r.axis),
          lsdem::describe_base(r.pga[r.axis], r.base_changes[static_cast<std::size_t>(r.axis)]));
    if (r.collapsed_before) {
        print("  collapsed while it was prepared; the motion was not run\n");
    } else if (r.collapse_time) {
        print("  collapsed at {:.4g} s\n", *r.collapse_time);
    }
    if (r.failure) print("  {}\n", lsdem::describe(*r.failure));
    print("  elastic speed H sqrt(k/m) {:.5g} m/s, sqrt(mu g l) {:.5g} m/s\n", r.scales.elastic_speed, r.scales.sliding_speed());
    for (const lsdem::SpeedEstimate& e : r.speeds) {
        if (e.speed) {
            print("  {:<17} {:>9.5g} +- {:<8.3g} m/s, S^N {:.4g}, {} levels\n", e.method, *e.speed, e.speed_error,
                  *e.speed / r.scales.sliding_speed(), e.height.size());
        } else {
            print("  {:<17} none: {}\n", e.method, e.why);
        }
    }
    const std::string axis = lsdem::axis_name(r.axis);
    print("\n  spine: {:>5} {:>14} {:>14} {:>14} {:>19} {:>19}\n", "level", "residual " + axis + " [mm]", "peak " + axis + " [mm]",
          "peak v [m/s]", "in plane [deg]", "vertical [deg]");
    for (const lsdem::SpineLevel& l : r.spine) {
        print("         {:>5} {:>14.4g} {:>14.4g} {:>14.4g} {:>9.3g} {:>9.3g} {:>9.3g} {:>9.3g}  {}\n", l.level,
              1e3 * l.residual_displacement[r.axis], 1e3 * l.peak_displacement[r.axis], l.peak_velocity[r.axis], l.in_plane_peak / kDegree,
              l.in_plane_residual / kDegree, l.vertical_peak / kDegree, l.vertical_residual / kDegree, l.name);
    }
    print("  (rotations: peak and residual)\n");
    const lsdem::Damage& d = r.damage;
    print("\n  damage index {:.4g}; {} of {} blocks fallen\n", d.index, d.fallen, d.blocks);
    print("  level: {:>6} {:>20} {:>20} {:>20} {:>9}\n", "fallen", "slip below [mm]", "rotation [deg]", "tilt at end [deg]", "index");
    for (const lsdem::LevelDamage& l : d.levels) {
        print("  {:>5}  {:>6} {:>10.3g} {:>9.3g} {:>10.3g} {:>9.3g} {:>10.3g} {:>9.3g} {:>9.3g}\n", l.level, l.fallen, 1e3 * l.slip.mean,
              1e3 * l.slip.max, l.rotation.mean / kDegree, l.rotation.max / kDegree, l.final_tilt.mean / kDegree,
              l.final_tilt.max / kDegree, l.index);
    }
    print("  (each: mean and largest)\n");
    print_losses(d);
}

/// Pictures of the velocity field at the times wanted, all with the same colours.
nlohmann::json add_fields(lsdem::ResultFolder& folder, const lsdem::StoredRun& run, const ResponseOptions& options, int axis) {
    const lsdem::CameraSettings camera = options.look.camera(axis);
    lsdem::FieldPicture picture{.side = camera.side, .component = options.look.shown(), .limit = 0.0, .name = options.directory};
    const std::vector<lsdem::FieldView> views = lsdem::take_views(run, {options.fields.begin(), options.fields.end()}, camera);
    picture.limit = lsdem::find_field_limit(run, views, picture.side, picture.component);
    nlohmann::json list = nlohmann::json::array();
    for (const lsdem::FieldView& view : views) {
        const std::string name = fmt::format("field_{:.6g}s", view.image.time);
        folder.add_text(name + ".svg", lsdem::make_field_svg(run, {view}, picture));
        nlohmann::json& field = list.emplace_back(nlohmann::json{{"time_s", view.image.time}, {"picture", name + ".svg"}});
        if (!options.look.csv) continue;
        folder.add_text(name + ".csv", lsdem::make_field_csv(run, view.frame, view.image, camera.side));
        field["grid"] = name + ".csv";
    }
    return list;
}

int run_response(const ResponseOptions& options) {
    require_ascending("--window", options.window);
    const lsdem::StoredRun run = lsdem::read_run(options.directory);
    lsdem::ResponseSettings settings{.axis = {}, .threshold = options.threshold, .window = {}};
    if (!options.axis.empty()) settings.axis = static_cast<int>(std::string("xyz").find(options.axis));
    if (!options.window.empty()) settings.window = {{options.window[0], options.window[1]}};
    const lsdem::Response response = lsdem::measure_response(run, settings);

    nlohmann::json object = lsdem::to_json(response);
    if (!options.out.empty()) {
        lsdem::ResultFolder folder(options.out);
        if (!options.fields.empty()) object["fields"] = add_fields(folder, run, options, response.axis);
        folder.add_text("response.json", object.dump(2) + "\n");
        folder.add_text("response_spine.csv", lsdem::make_spine_levels_csv(response));
        folder.add_text("response_levels.csv", lsdem::make_damage_csv(response.damage));
        folder.add_text("residual.svg", make_svg(lsdem::make_residual_plot(response, options.directory)));
        folder.add_text("rotation.svg", make_svg(lsdem::make_rotation_plot(response, options.directory)));
        folder.add_text("lag.svg", make_svg(lsdem::make_lag_plot(response, options.directory)));
        folder.commit();
    }
    if (options.json) {
        print_json(object);
    } else {
        print_response(response);
        if (!options.out.empty()) print("Tables and pictures in {}\n", options.out);
    }
    return kDone;
}

}  // namespace

void add_response_command(CLI::App& app, Action& action) {
    auto options = std::make_shared<ResponseOptions>();
    CLI::App* command = app.add_subcommand(
        "response", "Structural speed, residual displacement, rotation, damage, energy dissipated and failure mode of a run");
    command->add_option("directory", options->directory, "Directory of results, as `musim run -o` writes it")->required()->type_name("DIR");
    CLI::Option* out = command->add_option("-o,--out", options->out, "Directory for tables and pictures")->type_name("OUT");
    command->add_option("--axis", options->axis, "Axis of the speeds (default: along which the base moves most)")
        ->check(one_of({"x", "y", "z"}));
    add_positive_option(*command, "--threshold", options->threshold, "Velocity that counts as arrival, over the base's peak")
        ->default_str("0.1");
    command->add_option("--window", options->window, "Part of the histories for the speeds [s]")->expected(2)->type_name("FROM TO");
    command->add_option("--field", options->fields, "Times at which the velocity field is drawn [s]; needs frames")
        ->type_name("TIME")
        ->needs(out);
    options->look.add_to(*command);
    add_json_option(*command, options->json);
    command->footer(
        "Examples:\n"
        "  musim response out/tower\n"
        "  musim response out/tower --field 0.4 0.5 0.6 -o out/tower/response\n"
        "  musim response out/tower --axis x --window 0.3 0.8 --json\n"
        "The speed is the slope of height over lag, by first arrival, cross-correlation, peak and deconvolution; S^N is it over sqrt(mu g "
        "l).\n"
        "First arrival is the plainest of them; the others want a whole pulse in the window. Where they differ, blocks stick and slip.");
    command->callback([&action, options] { action = [options] { return run_response(*options); }; });
}

}  // namespace musim::cli
