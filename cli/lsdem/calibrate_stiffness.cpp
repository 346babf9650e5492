#include "cli/lsdem/calibrate_tests.hpp"

#include <cmath>
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
#include "cli/whole_option.hpp"
#include "lsdem/calibration/calibration_files.hpp"
#include "lsdem/calibration/wave_speed.hpp"
#include "lsdem/scene/material_presets.hpp"
#include "scaling/json_optional.hpp"
#include "scaling/side_by_side.hpp"

namespace musim::cli {
namespace {

/// Above this ratio of a simulated wave speed to the solid's own, or below its inverse, the stiffness does not fit the solid.
constexpr double kSpeedMisfit = 1.2;

struct StiffnessOptions {
    TestOptions test;
    int layers = 38;
    std::string criterion = "half_velocity";
    bool raw = false;
    bool damped = false;
    std::optional<Number> speed_normal, speed_shear, youngs_modulus, poisson;
};

/// One direction of the stiffness test.
struct TestedDirection {
    lsdem::WaveKind kind = lsdem::WaveKind::normal;
    std::string name;
    std::optional<double> target;
    lsdem::WaveSpeed measured;                     ///< with the sample's own stiffness
    std::optional<lsdem::StiffnessSearch> search;  ///< when a speed is wanted
    lsdem::WaveHistory history;
};

std::vector<TestedDirection> make_directions(const StiffnessOptions& options, const lsdem::BlockSample& sample) {
    TestedDirection normal{.kind = lsdem::WaveKind::normal, .name = "normal", .target = {}, .measured = {}, .search = {}, .history = {}};
    TestedDirection shear{.kind = lsdem::WaveKind::shear, .name = "shear", .target = {}, .measured = {}, .search = {}, .history = {}};
    if (options.youngs_modulus) {
        // bar speeds of an isotropic solid: G = E/(2(1 + nu))
        const double e = *options.youngs_modulus;
        normal.target = std::sqrt(e / sample.density);
        if (options.poisson) shear.target = std::sqrt(e / (2.0 * (1.0 + *options.poisson)) / sample.density);
    }
    if (options.speed_normal) normal.target = *options.speed_normal;
    if (options.speed_shear) shear.target = *options.speed_shear;
    return {normal, shear};
}

nlohmann::json make_json(const TestedDirection& d, const lsdem::BlockSample& sample) {
    const auto speed = [](const lsdem::WaveSpeed& s) {
        return nlohmann::json{{"effective_speed_m_s", s.effective()},   {"criterion_speed_m_s", s.speed},
                              {"standard_error_m_s", s.standard_error}, {"front_factor", s.front_factor},
                              {"first_layer", s.first_layer},           {"last_layer", s.last_layer}};
    };
    nlohmann::json object{{"direction", d.name},
                          {"stiffness_n_m", d.kind == lsdem::WaveKind::normal ? sample.normal_stiffness : sample.shear_stiffness},
                          {"closed_form_speed_m_s", lsdem::closed_form_speed(sample, d.kind)},
                          {"measured", speed(d.measured)}};
    if (d.search) {
        object["search"] = {{"target_m_s", d.search->target},
                            {"stiffness_n_m", d.search->stiffness},
                            {"closed_form_stiffness_n_m", d.search->closed_form},
                            {"runs", d.search->runs},
                            {"of_criterion_speed", d.search->of_raw_speed},
                            {"measured", speed(d.search->measured)}};
    }
    return object;
}

void print_direction(const TestedDirection& d, const lsdem::BlockSample& sample) {
    const double stiffness = d.kind == lsdem::WaveKind::normal ? sample.normal_stiffness : sample.shear_stiffness;
    const lsdem::WaveSpeed& s = d.measured;
    print(
        "  {:<7} k = {:.6g} MN/m: {:.1f} m/s effective; {:.1f} +- {:.1f} m/s by the criterion, layers {} to {}, {:.4f} of an ideal chain's "
        "c0; "
        "closed form H sqrt(k/m) {:.1f} m/s\n",
        d.name, stiffness / kMega, s.effective(), s.speed, s.standard_error, s.first_layer, s.last_layer, s.front_factor,
        lsdem::closed_form_speed(sample, d.kind));
    if (d.search) {
        print("          for {:.6g} m/s: k = {:.6g} MN/m found in {} runs (closed form m (c/H)^2: {:.6g} MN/m)\n", d.search->target,
              d.search->stiffness / kMega, d.search->runs, d.search->closed_form / kMega);
    }
}

/// Judgement of the preset by the simulated speed, when the solid's own is known.
std::optional<std::string> judge_preset(const std::string& material, const TestedDirection& normal) {
    const auto bar = lsdem::find_material_preset(material).bar_wave_speed;
    if (!bar) return std::nullopt;
    const double ratio = normal.measured.effective() / bar->value();
    const bool fits = ratio < kSpeedMisfit && ratio > 1.0 / kSpeedMisfit;
    return fmt::format("the solid's own bar wave speed is {:.0f} m/s: this stiffness gives {:.3f} of it and {} it", bar->value(), ratio,
                       fits ? "fits" : "does not fit");
}

int run_stiffness(const StiffnessOptions& options) {
    std::optional<lsdem::ResultFolder> folder = options.test.make_folder(options.test.origin_with_options());
    const lsdem::BlockSample sample = options.test.sample.sample();
    const lsdem::WaveSettings settings{
        .layers = options.layers,
        .criterion = options.criterion == "displacement" ? lsdem::ArrivalCriterion::displacement : lsdem::ArrivalCriterion::half_velocity,
        .damped = options.damped};
    std::vector<TestedDirection> directions = make_directions(options, sample);
    std::vector<std::function<void()>> jobs;
    jobs.reserve(directions.size());
    for (TestedDirection& d : directions) {
        jobs.emplace_back([&] {
            d.measured = lsdem::measure_wave_speed(sample, d.kind, settings);
            d.history = lsdem::run_wave_test(sample, d.kind, settings);
            if (d.target) d.search = lsdem::find_stiffness(sample, d.kind, *d.target, settings, options.raw);
        });
    }
    {
        ProgressLine progress("stiffness");
        scaling::run_side_by_side(jobs, options.test.threads, [&](double fraction) { progress.update(fraction); });
    }

    const std::optional<std::string> verdict = judge_preset(options.test.sample.material, directions[0]);
    if (folder) {
        for (const TestedDirection& d : directions) {
            folder->add_text("wave_" + d.name + ".csv", lsdem::make_wave_csv(d.history));
            folder->add_text("wave_" + d.name + ".svg",
                             lsdem::make_wave_svg(d.history, sample, options.test.sample.material + ", " + d.name + " wave", d.measured));
        }
        folder->commit();
    }
    if (options.test.json) {
        nlohmann::json list = nlohmann::json::array();
        for (const TestedDirection& d : directions) list.push_back(make_json(d, sample));
        nlohmann::json object{{"material", options.test.sample.material},
                              {"sample", describe_sample(sample)},
                              {"layers", options.layers},
                              {"criterion", options.criterion},
                              {"directions", list},
                              {"bar_speed_verdict", scaling::or_null(verdict)}};
        print_json(object);
    } else {
        print("{}: step of the base velocity, {:.4g} m/s, under a column of {} blocks; arrival by {}\n", options.test.sample.material,
              lsdem::base_velocity(sample), options.layers, options.criterion);
        for (const TestedDirection& d : directions) print_direction(d, sample);
        if (verdict) print("  {}\n", *verdict);
        if (folder) print("Curves in {}\n", options.test.out);
    }
    return kDone;
}

}  // namespace

void add_stiffness_command(CLI::App& calibrate, Action& action) {
    auto options = std::make_shared<StiffnessOptions>();
    CLI::App* command = calibrate.add_subcommand("stiffness", "k_n and k_s from the wave speed in a column");
    options->test.add_to(*command, "wave_normal and wave_shear, as csv and svg");
    add_whole_option(*command, "--layers", options->layers, "Blocks in the column", {20, 10000})->capture_default_str();
    command->add_option("--criterion", options->criterion, "When a layer counts as reached")
        ->capture_default_str()
        ->check(one_of({"half_velocity", "displacement"}));
    command->add_flag("--raw", options->raw, "The target is the speed by the criterion, not the effective one without its bias");
    command->add_flag("--damped", options->damped, "Contacts with the material's restitution (default: springs only)");
    add_positive_option(*command, "--speed-normal", options->speed_normal, "Wanted speed of the normal wave [m/s]: k_n is searched");
    add_positive_option(*command, "--speed-shear", options->speed_shear, "Wanted speed of the shear wave [m/s]: k_s is searched");
    CLI::Option* youngs = add_positive_option(*command, "--youngs-modulus", options->youngs_modulus,
                                              "E [Pa]: the wanted normal speed is that of a bar, sqrt(E/density)");
    add_number_option(*command, "--poisson", options->poisson, "nu, with E: the wanted shear speed is sqrt(G/density), G = E/(2(1 + nu))")
        ->needs(youngs)
        ->check(between(-0.999, 0.5));
    command->footer(
        "Examples:\n"
        "  musim calibrate stiffness --material wood\n"
        "  musim calibrate stiffness --material wood --speed-normal 2110 --speed-shear 1965 -o out/wood\n"
        "  musim calibrate stiffness --material aluminium --youngs-modulus 69e9 --poisson 0.33 --density 2632 --json\n"
        "The base takes 0.8 block heights per second at once; blocks neither turn nor slip. The speed is the slope of height over arrival\n"
        "time between the layers 5 and 30 of 38. By half of the velocity an ideal chain shows 0.9885 of its c0, by the displacement "
        "1.0083;\n"
        "the effective speed is without that.");
    command->callback([&action, options] { action = [options] { return run_whole([&] { return run_stiffness(*options); }); }; });
}

}  // namespace musim::cli
