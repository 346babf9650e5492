#include <algorithm>
#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/progress_line.hpp"
#include "lsdem/scene/material_presets.hpp"
#include "lsdem/study/calibration_files.hpp"
#include "lsdem/study/detail/side_by_side.hpp"
#include "lsdem/study/rocking_impact.hpp"
#include "lsdem/study/tilt_test.hpp"
#include "lsdem/study/wave_speed.hpp"
#include "lsdem/study/write_results.hpp"

namespace musim::cli {
namespace {

namespace study = lsdem::study;
namespace scene = lsdem::scene;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kMega = 1e6;

/// Above this ratio of a simulated wave speed to the solid's own, or below its inverse, the stiffness does not fit the solid.
constexpr double kSpeedMisfit = 1.2;

/// The block under test: a preset, and what is said otherwise.
struct SampleOptions {
    std::string material;
    std::vector<Number> block;
    std::optional<Number> density, normal_stiffness, shear_stiffness, friction, ground_friction, restitution;

    void add_to(CLI::App& command) {
        command.add_option("--material", material, "Preset for block and contacts (`musim calibrate presets` lists them)")
            ->required()
            ->type_name("PRESET");
        command.add_option("--block", block, "Edge lengths b w H [m], instead of the preset's; its stiffnesses are fitted to them")
            ->expected(3)
            ->type_name("NUMBER");
        command.add_option("--density", density, "Density [kg/m^3], instead of the preset's")->type_name("NUMBER");
        command.add_option("--normal-stiffness", normal_stiffness, "k_n of a whole face [N/m], instead of the preset's")
            ->type_name("NUMBER");
        command.add_option("--shear-stiffness", shear_stiffness, "k_s of a whole face [N/m], instead of the preset's")->type_name("NUMBER");
        command.add_option("--friction", friction, "Friction coefficient, instead of the preset's")->type_name("NUMBER");
        command
            .add_option("--ground-friction", ground_friction, "Friction coefficient of block on ground (default: that of block on block)")
            ->type_name("NUMBER");
        command.add_option("--restitution", restitution, "Coefficient of restitution, instead of the preset's")->type_name("NUMBER");
    }

    study::BlockSample sample() const {
        scene::MaterialPreset preset = scene::find_material_preset(material);
        if (!block.empty()) {
            const scene::Triple<scaling::Length> size{block[0] * scaling::si::meter, block[1] * scaling::si::meter,
                                                      block[2] * scaling::si::meter};
            preset.material = scene::fit_to_block(preset, size);
            preset.reference_block = size;
        }
        study::BlockSample sample = study::make_sample(preset);
        if (density) sample.density = *density;
        if (normal_stiffness) sample.normal_stiffness = *normal_stiffness;
        if (shear_stiffness) sample.shear_stiffness = *shear_stiffness;
        if (friction) sample.friction = sample.ground_friction = *friction;
        if (ground_friction) sample.ground_friction = *ground_friction;
        if (restitution) sample.restitution = *restitution;
        study::make_model(sample);  // refuses what cannot be
        return sample;
    }
};

/// What every test has besides its own options.
struct TestOptions {
    SampleOptions sample;
    std::string out;
    int threads = 0;
    bool json = false;

    void add_to(CLI::App& command, const char* files) {
        sample.add_to(command);
        command.add_option("-o,--out", out, std::string("Directory for ") + files)->type_name("DIR");
        add_threads_option(command, threads);
        add_json_option(command, json);
    }

    std::optional<study::ResultFolder> make_folder() const {
        return out.empty() ? std::optional<study::ResultFolder>() : std::optional<study::ResultFolder>(std::in_place, out);
    }
};

nlohmann::json to_json(const study::BlockSample& sample) {
    return {{"block_m", {sample.size.x(), sample.size.y(), sample.size.z()}},
            {"mass_kg", sample.mass()},
            {"density_kg_m3", sample.density},
            {"normal_stiffness_n_m", sample.normal_stiffness},
            {"shear_stiffness_n_m", sample.shear_stiffness},
            {"friction", sample.friction},
            {"ground_friction", sample.ground_friction},
            {"restitution", sample.restitution}};
}

// ---- stiffness

struct StiffnessOptions {
    TestOptions test;
    int layers = 38;
    std::string criterion = "half_velocity";
    bool raw = false;
    bool damped = false;
    std::optional<Number> speed_normal, speed_shear, youngs_modulus, poisson;
};

/// One direction of the stiffness test.
struct Direction {
    study::WaveKind kind = study::WaveKind::normal;
    std::string name;
    std::optional<double> target;
    study::WaveSpeed measured;                     ///< with the sample's own stiffness
    std::optional<study::StiffnessSearch> search;  ///< when a speed is wanted
    study::WaveHistory history;
};

std::vector<Direction> make_directions(const StiffnessOptions& options, const study::BlockSample& sample) {
    Direction normal{.kind = study::WaveKind::normal, .name = "normal", .target = {}, .measured = {}, .search = {}, .history = {}};
    Direction shear{.kind = study::WaveKind::shear, .name = "shear", .target = {}, .measured = {}, .search = {}, .history = {}};
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

nlohmann::json to_json(const Direction& d, const study::BlockSample& sample) {
    const auto speed = [](const study::WaveSpeed& s) {
        return nlohmann::json{{"effective_speed_m_s", s.effective()},   {"criterion_speed_m_s", s.speed},
                              {"standard_error_m_s", s.standard_error}, {"front_factor", s.front_factor},
                              {"first_layer", s.first_layer},           {"last_layer", s.last_layer}};
    };
    nlohmann::json object{{"direction", d.name},
                          {"stiffness_n_m", d.kind == study::WaveKind::normal ? sample.normal_stiffness : sample.shear_stiffness},
                          {"closed_form_speed_m_s", study::closed_form_speed(sample, d.kind)},
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

void print_direction(const Direction& d, const study::BlockSample& sample) {
    const double stiffness = d.kind == study::WaveKind::normal ? sample.normal_stiffness : sample.shear_stiffness;
    const study::WaveSpeed& s = d.measured;
    print(
        "  {:<7} k = {:.6g} MN/m: {:.1f} m/s effective; {:.1f} +- {:.1f} m/s by the criterion, layers {} to {}, {:.4f} of an ideal chain's "
        "c0; "
        "closed form H sqrt(k/m) {:.1f} m/s\n",
        d.name, stiffness / kMega, s.effective(), s.speed, s.standard_error, s.first_layer, s.last_layer, s.front_factor,
        study::closed_form_speed(sample, d.kind));
    if (d.search) {
        print("          for {:.6g} m/s: k = {:.6g} MN/m found in {} runs (closed form m (c/H)^2: {:.6g} MN/m)\n", d.search->target,
              d.search->stiffness / kMega, d.search->runs, d.search->closed_form / kMega);
    }
}

/// What the simulated speed says about the preset, when the solid's own is known.
std::optional<std::string> judge_preset(const std::string& material, const Direction& normal) {
    const auto bar = scene::find_material_preset(material).bar_wave_speed;
    if (!bar) return std::nullopt;
    const double ratio = normal.measured.effective() / bar->value();
    const bool fits = ratio < kSpeedMisfit && ratio > 1.0 / kSpeedMisfit;
    return fmt::format("the solid's own bar wave speed is {:.0f} m/s: this stiffness gives {:.3f} of it and {} it", bar->value(), ratio,
                       fits ? "fits" : "does not fit");
}

int run_stiffness(const StiffnessOptions& options) {
    std::optional<study::ResultFolder> folder = options.test.make_folder();
    const study::BlockSample sample = options.test.sample.sample();
    const study::WaveSettings settings{
        .layers = options.layers,
        .criterion = options.criterion == "displacement" ? study::ArrivalCriterion::displacement : study::ArrivalCriterion::half_velocity,
        .damped = options.damped};
    std::vector<Direction> directions = make_directions(options, sample);
    std::vector<std::function<void()>> jobs;
    for (Direction& d : directions) {
        jobs.emplace_back([&] {
            d.measured = study::measure_wave_speed(sample, d.kind, settings);
            d.history = study::run_wave_test(sample, d.kind, settings);
            if (d.target) d.search = study::find_stiffness(sample, d.kind, *d.target, settings, options.raw);
        });
    }
    {
        ProgressLine progress("stiffness");
        study::detail::run_side_by_side(jobs, options.test.threads, [&](double fraction) { progress.update(fraction); });
    }

    const std::optional<std::string> verdict = judge_preset(options.test.sample.material, directions[0]);
    if (folder) {
        for (const Direction& d : directions) {
            folder->add_text("wave_" + d.name + ".csv", study::make_wave_csv(d.history));
            folder->add_text("wave_" + d.name + ".svg",
                             study::make_wave_svg(d.history, sample, options.test.sample.material + ", " + d.name + " wave", d.measured));
        }
        folder->commit();
    }
    if (options.test.json) {
        nlohmann::json list = nlohmann::json::array();
        for (const Direction& d : directions) list.push_back(to_json(d, sample));
        nlohmann::json object{{"material", options.test.sample.material},
                              {"sample", to_json(sample)},
                              {"layers", options.layers},
                              {"criterion", options.criterion},
                              {"directions", list},
                              {"bar_speed_verdict", verdict ? nlohmann::json(*verdict) : nlohmann::json()}};
        print_json(object);
    } else {
        print("{}: step of the base velocity, {:.4g} m/s, under a column of {} blocks; arrival by {}\n", options.test.sample.material,
              study::base_velocity(sample), options.layers, options.criterion);
        for (const Direction& d : directions) print_direction(d, sample);
        if (verdict) print("  {}\n", *verdict);
        if (folder) print("Curves in {}\n", options.test.out);
    }
    return kDone;
}

// ---- friction

struct FrictionOptions {
    TestOptions test;
    Number resolution{0.001};  ///< [degree]
};

int run_friction(const FrictionOptions& options) {
    std::optional<study::ResultFolder> folder = options.test.make_folder();
    const study::BlockSample sample = options.test.sample.sample();
    std::vector<study::TiltCase> cases;
    for (const auto pose : {study::TiltPose::lying, study::TiltPose::upright})
        for (const auto support : {study::TiltSupport::ground, study::TiltSupport::block})
            for (const auto side : {study::TiltSide::wide, study::TiltSide::other}) cases.push_back({support, pose, side});
    std::vector<study::TiltResult> results(cases.size());
    std::vector<std::function<void()>> jobs;
    for (std::size_t i = 0; i < cases.size(); ++i)
        jobs.emplace_back([&, i] { results[i] = study::run_tilt_test(sample, cases[i], options.resolution * kDegree); });
    {
        ProgressLine progress("friction");
        study::detail::run_side_by_side(jobs, options.test.threads, [&](double fraction) { progress.update(fraction); });
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
        print_json({{"material", options.test.sample.material}, {"sample", to_json(sample)}, {"tests", list}});
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

// ---- restitution

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
    for (const Number& number : numbers) values.push_back(number * factor);
    return values;
}

/// A search on one curve.
struct NamedSearch {
    const study::RockingCurve* curve = nullptr;
    study::RestitutionSearch search;
};

nlohmann::json to_json(const study::BlockSample& sample, const study::RockingCurve& curve) {
    nlohmann::json points = nlohmann::json::array();
    for (std::size_t i = 0; i < curve.restitution.size(); ++i) {
        const study::RockingResult& r = curve.result[i];
        points.push_back({{"restitution", curve.restitution[i]},
                          {"first", r.first},
                          {"mean", r.mean},
                          {"impacts", r.impacts},
                          {"slip_over_side", r.slip_over_side}});
    }
    const std::optional<double> paper = study::find_published_ratio(curve.start);
    return {{"support", to_string(curve.support)},
            {"side", to_string(curve.side)},
            {"start_deg", curve.start / kDegree},
            {"housner", study::housner_ratio(sample, curve.side)},
            {"published_wood", paper ? nlohmann::json(*paper) : nlohmann::json()},
            {"points", points}};
}

void print_curves(const study::BlockSample& sample, const std::vector<study::RockingCurve>& curves) {
    for (const study::RockingCurve& curve : curves) {
        print("\n  {} side on {}, let go at {:.4g} degrees; Housner {:.3f}", to_string(curve.side), to_string(curve.support),
              curve.start / kDegree, study::housner_ratio(sample, curve.side));
        if (const auto paper = study::find_published_ratio(curve.start)) print("; measured on wood by Harmon et al. about {}", *paper);
        print("\n    {:<22}", "C_res");
        for (const double e : curve.restitution) print(" {:>6.3g}", e);
        print("\n    {:<22}", "r, first impact");
        for (const study::RockingResult& r : curve.result) print(" {:>6.3f}", r.first);
        print("\n    {:<22}", "r, mean of up to five");
        for (const study::RockingResult& r : curve.result) print(" {:>6.3f}", r.mean);
        print("\n");
    }
}

int run_restitution(const RestitutionOptions& options) {
    std::optional<study::ResultFolder> folder = options.test.make_folder();
    const study::BlockSample sample = options.test.sample.sample();
    study::RockingSweep sweep{.restitutions = to_values(options.restitutions),
                              .angles = to_values(options.angles, kDegree),
                              .supports = {},
                              .safety = options.safety,
                              .threads = options.test.threads};
    if (sweep.restitutions.empty())
        for (int i = 1; i <= 9; ++i) sweep.restitutions.push_back(0.1 * i);
    std::sort(sweep.restitutions.begin(), sweep.restitutions.end());
    if (options.support != "two_blocks") sweep.supports.push_back(study::RockingSupport::ground);
    if (options.support != "ground") sweep.supports.push_back(study::RockingSupport::two_blocks);

    std::vector<study::RockingCurve> curves;
    std::vector<NamedSearch> searches;
    {
        ProgressLine progress("restitution");
        sweep.on_progress = [&](double fraction) { progress.update(fraction); };
        curves = study::sweep_rocking(sample, sweep);
    }
    if (curves.empty()) throw std::invalid_argument("rocking test: at every angle the block overturns; take smaller ones");
    if (options.target) {
        ProgressLine progress("search");
        for (const study::RockingCurve& curve : curves) searches.push_back({&curve, {}});
        std::vector<std::function<void()>> jobs;
        for (NamedSearch& s : searches)
            jobs.emplace_back([&] { s.search = study::find_restitution(sample, *s.curve, *options.target, options.safety); });
        study::detail::run_side_by_side(jobs, options.test.threads, [&](double fraction) { progress.update(fraction); });
    }
    if (folder) {
        folder->add_text("restitution.csv", study::make_rocking_csv(sample, curves));
        for (const study::RockingSupport support : sweep.supports)
            folder->add_text("restitution_" + to_string(support) + ".svg", study::make_rocking_svg(sample, curves, support));
        folder->commit();
    }

    if (options.test.json) {
        nlohmann::json list = nlohmann::json::array(), found = nlohmann::json::array();
        for (const study::RockingCurve& curve : curves) list.push_back(to_json(sample, curve));
        for (const NamedSearch& s : searches) {
            found.push_back({{"support", to_string(s.curve->support)},
                             {"side", to_string(s.curve->side)},
                             {"start_deg", s.curve->start / kDegree},
                             {"lowest", s.search.lowest},
                             {"highest", s.search.highest},
                             {"restitution", s.search.restitution ? nlohmann::json(*s.search.restitution) : nlohmann::json()},
                             {"reached", s.search.restitution ? nlohmann::json(s.search.reached) : nlohmann::json()}});
        }
        nlohmann::json object{{"material", options.test.sample.material}, {"sample", to_json(sample)}, {"curves", list}};
        if (options.target) object["target"] = {{"energy_ratio", options.target->value}, {"searches", found}};
        print_json(object);
        return kDone;
    }
    print("{}: rocking tests, energy ratio r after over before an impact\n", options.test.sample.material);
    print_curves(sample, curves);
    for (const NamedSearch& s : searches) {
        const std::string name =
            fmt::format("{} side on {}, {:.4g} degrees", to_string(s.curve->side), to_string(s.curve->support), s.curve->start / kDegree);
        if (s.search.restitution)
            print("  mean r = {:.4g}, {}: C_res = {:.4f} (gives {:.4f})\n", options.target->value, name, *s.search.restitution,
                  s.search.reached);
        else
            print("  mean r = {:.4g}, {}: not reached by any C_res of the curve, which gives {:.3f} to {:.3f}\n", options.target->value,
                  name, s.search.lowest, s.search.highest);
    }
    if (folder) print("Curves in {}\n", options.test.out);
    return kDone;
}

// ---- presets

nlohmann::json to_json(const scene::MaterialPreset& preset) {
    const study::BlockSample sample = study::make_sample(preset);
    nlohmann::json object = to_json(sample);
    object.erase("ground_friction");
    object["name"] = preset.name;
    object["length_scale"] = preset.length_scale;
    object["source"] = preset.source;
    object["normal_wave_speed_m_s"] = study::closed_form_speed(sample, study::WaveKind::normal);
    object["shear_wave_speed_m_s"] = study::closed_form_speed(sample, study::WaveKind::shear);
    object["camera_step_s"] = preset.camera_step.value();
    object["bar_wave_speed_m_s"] = preset.bar_wave_speed ? nlohmann::json(preset.bar_wave_speed->value()) : nlohmann::json();
    return object;
}

int run_presets(bool json) {
    nlohmann::json list = nlohmann::json::array();
    for (const std::string& name : scene::material_preset_names()) list.push_back(to_json(scene::find_material_preset(name)));
    if (json) {
        print_json({{"presets", list}});
        return kDone;
    }
    for (const std::string& name : scene::material_preset_names()) {
        const scene::MaterialPreset& preset = scene::find_material_preset(name);
        const study::BlockSample s = study::make_sample(preset);
        print("{} (1:{:.4g})\n  block {:.3f} x {:.3f} x {:.3f} mm, {:.5g} kg, {:.5g} kg/m^3\n", name, 1.0 / preset.length_scale,
              1e3 * s.size.x(), 1e3 * s.size.y(), 1e3 * s.size.z(), s.mass(), s.density);
        print("  k_n {:.5g} MN/m, k_s {:.5g} MN/m (wave speeds {:.1f} and {:.1f} m/s), friction {}, restitution {}\n",
              s.normal_stiffness / kMega, s.shear_stiffness / kMega, study::closed_form_speed(s, study::WaveKind::normal),
              study::closed_form_speed(s, study::WaveKind::shear), s.friction, s.restitution);
        if (preset.bar_wave_speed) print("  bar wave speed of the solid itself: {:.0f} m/s\n", preset.bar_wave_speed->value());
        print("  camera step {} = {:.6g} us\n  source: {}\n", preset.camera_step_fraction, 1e6 * preset.camera_step.value(), preset.source);
    }
    return kDone;
}

void add_stiffness_command(CLI::App& calibrate, Action& action) {
    auto options = std::make_shared<StiffnessOptions>();
    CLI::App* command = calibrate.add_subcommand("stiffness", "k_n and k_s from the wave speed in a column");
    options->test.add_to(*command, "wave_normal and wave_shear, as csv and svg");
    command->add_option("--layers", options->layers, "Blocks in the column")->capture_default_str()->check(CLI::Range(20, 10000));
    command->add_option("--criterion", options->criterion, "When a layer counts as reached")
        ->capture_default_str()
        ->check(CLI::IsMember({"half_velocity", "displacement"}));
    command->add_flag("--raw", options->raw, "The target is the speed by the criterion, not the effective one without its bias");
    command->add_flag("--damped", options->damped, "Contacts with the material's restitution (default: springs only)");
    command->add_option("--speed-normal", options->speed_normal, "Wanted speed of the normal wave [m/s]: k_n is searched")
        ->type_name("NUMBER");
    command->add_option("--speed-shear", options->speed_shear, "Wanted speed of the shear wave [m/s]: k_s is searched")
        ->type_name("NUMBER");
    CLI::Option* youngs =
        command
            ->add_option("--youngs-modulus", options->youngs_modulus, "E [Pa]: the wanted normal speed is that of a bar, sqrt(E/density)")
            ->type_name("NUMBER");
    command->add_option("--poisson", options->poisson, "nu, with E: the wanted shear speed is sqrt(G/density), G = E/(2(1 + nu))")
        ->type_name("NUMBER")
        ->needs(youngs)
        ->check(CLI::Range(-0.999, 0.5));
    command->footer(
        "Examples:\n"
        "  musim calibrate stiffness --material wood\n"
        "  musim calibrate stiffness --material wood --speed-normal 2110 --speed-shear 1965 -o out/wood\n"
        "  musim calibrate stiffness --material aluminium --youngs-modulus 69e9 --poisson 0.33 --density 2632 --json\n"
        "The base takes 0.8 block heights per second at once; blocks neither turn nor slip. The speed is the slope of height over arrival\n"
        "time between the layers 5 and 30 of 38. By half of the velocity an ideal chain shows 0.9885 of its c0, by the displacement "
        "1.0083;\n"
        "the effective speed is without that.");
    command->callback([&action, options] { action = [options] { return run_stiffness(*options); }; });
}

void add_friction_command(CLI::App& calibrate, Action& action) {
    auto options = std::make_shared<FrictionOptions>();
    CLI::App* command = calibrate.add_subcommand("friction", "Angle at which a block slips or topples");
    options->test.add_to(*command, "friction.csv");
    command->add_option("--resolution", options->resolution, "Interval in which the angle is enclosed [degrees]")
        ->default_str("0.001")
        ->type_name("NUMBER");
    command->footer(
        "Examples:\n"
        "  musim calibrate friction --material wood\n"
        "  musim calibrate friction --material concrete --ground-friction 0.5 --resolution 1/100 --json\n"
        "A block lying on its largest face slips at atan(mu); one that stands upright topples first when its base is narrower than mu "
        "times\n"
        "its height. Every angle is a run of its own.");
    command->callback([&action, options] { action = [options] { return run_friction(*options); }; });
}

void add_restitution_command(CLI::App& calibrate, Action& action) {
    auto options = std::make_shared<RestitutionOptions>();
    CLI::App* command = calibrate.add_subcommand("restitution", "Energy a rocking block keeps at an impact, against C_res");
    options->test.add_to(*command, "restitution.csv and a picture per support");
    command->add_option("--restitutions", options->restitutions, "C_res to test (default: 0.1, 0.2, ... 0.9)")->type_name("NUMBER");
    command->add_option("--angles", options->angles, "Tilts at which the block is let go [degrees] (default: 6 11 22)")
        ->type_name("NUMBER");
    command->add_option("--support", options->support, "What it rocks on")
        ->capture_default_str()
        ->check(CLI::IsMember({"ground", "two_blocks", "both"}));
    command->add_option("--target", options->target, "Wanted mean energy ratio: C_res is searched on every curve")->type_name("NUMBER");
    command->add_option("--safety", options->safety, "Time step over the critical one")->default_str("0.2")->type_name("NUMBER");
    command->footer(
        "Examples:\n"
        "  musim calibrate restitution --material wood -o out/rocking\n"
        "  musim calibrate restitution --material wood --support two_blocks --angles 22 --target 0.6\n"
        "Angles at which a side overturns are left out there. A rigid block without bounce keeps (1 - 1.5 sin^2 alpha)^2 (Housner).");
    command->callback([&action, options] { action = [options] { return run_restitution(*options); }; });
}

void add_presets_command(CLI::App& calibrate, Action& action) {
    auto json = std::make_shared<bool>(false);
    CLI::App* command = calibrate.add_subcommand("presets", "The measured materials: numbers, scale, source");
    add_json_option(*command, *json);
    command->footer("Examples:\n  musim calibrate presets\n  musim calibrate presets --json");
    command->callback([&action, json] { action = [json] { return run_presets(*json); }; });
}

}  // namespace

void add_calibrate_command(CLI::App& app, Action& action) {
    CLI::App* calibrate = app.add_subcommand("calibrate", "Contact parameters from tests on single blocks");
    calibrate->require_subcommand(1);
    add_stiffness_command(*calibrate, action);
    add_friction_command(*calibrate, action);
    add_restitution_command(*calibrate, action);
    add_presets_command(*calibrate, action);
}

}  // namespace musim::cli
